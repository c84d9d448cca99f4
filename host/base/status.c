#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

clshear_status cs_fail(cs_error *error, clshear_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    return status;
}

void cs_warn(const cs_log *log, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    if (log->warn == NULL) return;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    log->warn(log->user, line);
}

void cs_alarm(const cs_log *log, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    if (log->alarm == NULL && log->warn == NULL) return;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (log->alarm != NULL)
        log->alarm(log->alarm_user, line);
    else
        log->warn(log->user, line);
}

clockid_t cs_clock = CLOCK_MONOTONIC;

double cs_now_s(void)
{
    struct timespec now;
    clock_gettime(cs_clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

cs_error *cs_thread_error(void)
{
    static _Thread_local cs_error error;
    return &error;
}
