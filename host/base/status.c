#include "base/status.h"

#include <locale.h>
#include <stdio.h>

/* Replaces control characters by '?': those of ASCII, and U+0080 to U+009F, which UTF-8 writes as
 * c2 and one byte more. Messages hold names out of files, and terminals obey such characters. */
static void make_printable(char *line)
{
    for (unsigned char *at = (unsigned char *)line; *at != '\0'; at++) {
        if (*at < ' ' || *at == 0x7f) *at = '?';
        if (*at == 0xc2 && at[1] >= 0x80 && at[1] < 0xa0) at[0] = at[1] = '?';
    }
}

/* Prints a line with decimal points, whatever the locale of the process says: users copy numbers
 * from messages into flags. */
static void print_line(char *line, size_t size, const char *format, va_list arguments)
{
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t own = plain != (locale_t)0 ? uselocale(plain) : (locale_t)0;
    vsnprintf(line, size, format, arguments);
    make_printable(line);
    if (plain == (locale_t)0) return;
    uselocale(own);
    freelocale(plain);
}

clshear_status cs_fail_with(cs_error *error, clshear_status status, const char *format,
                            va_list arguments)
{
    print_line(error->message, sizeof error->message, format, arguments);
    return status;
}

clshear_status cs_fail(cs_error *error, clshear_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    cs_fail_with(error, status, format, arguments);
    va_end(arguments);
    return status;
}

void cs_warn(const cs_log *log, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    if (log->warn == NULL) return;
    va_start(arguments, format);
    print_line(line, sizeof line, format, arguments);
    va_end(arguments);
    log->warn(log->user, line);
}

void cs_alarm(const cs_log *log, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    if (log->alarm == NULL && log->warn == NULL) return;
    va_start(arguments, format);
    print_line(line, sizeof line, format, arguments);
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
