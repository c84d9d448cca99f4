#include "report/failure.h"

#include <stdarg.h>
#include <stdio.h>

int complain(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("clshear: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return code;
}

int complain_of_library(void)
{
    return complain(EXIT_FAILED, "%s", clshear_message());
}

int exit_status_of(clshear_status status)
{
    return status == CLSHEAR_OK ? EXIT_DONE : complain_of_library();
}
