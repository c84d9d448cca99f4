/* Error handling: functions return a status and store the reason in a cs_error. */
#ifndef CS_BASE_STATUS_H
#define CS_BASE_STATUS_H

#include <stdarg.h>
#include <time.h>

#include "clshear/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cs_error {
    char message[1024];
} cs_error;

/* Stores a one-line reason in `error` and returns `status`. */
clshear_status cs_fail(cs_error *error, clshear_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with the arguments of a function that takes any number of them. */
clshear_status cs_fail_with(cs_error *error, clshear_status status, const char *format,
                            va_list arguments) __attribute__((format(printf, 3, 0)));

/* The error of the calling thread. Public functions pass it to the functions they call. */
cs_error *cs_thread_error(void);

/* Internal status that unwinds a cancelled render. It never leaves the library: a cancelled render
 * succeeds with an incomplete film. */
#define CS_CANCELLED ((clshear_status)1000)

/* Stores the result of `call` in the variable `status` and jumps to the label `done`, which
 * releases resources, unless it is CLSHEAR_OK. */
#define CS_TRY(call)                         \
    do {                                     \
        status = (call);                     \
        if (status != CLSHEAR_OK) goto done; \
    } while (0)

/* Unless `condition` holds, stores `failure` in the variable `status` and a message in the variable
 * `error`, and jumps to the label `done`. */
#define CS_REQUIRE(condition, failure, ...)                  \
    do {                                                     \
        if (!(condition)) {                                  \
            status = cs_fail(error, (failure), __VA_ARGS__); \
            goto done;                                       \
        }                                                    \
    } while (0)

/* The receiver of warnings; NULL `warn`: none. `alarm` receives those of what was asked for and is
 * lost; NULL: `warn` does. */
typedef struct cs_log {
    void (*warn)(void *user, const char *line);
    void *user;
    void (*alarm)(void *user, const char *line);
    void *alarm_user;
} cs_log;

void cs_warn(const cs_log *log, const char *format, ...) __attribute__((format(printf, 2, 3)));
void cs_alarm(const cs_log *log, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Time in seconds, from any moment on, by the clock `cs_clock`: CLOCK_MONOTONIC, unless a test that
 * must not depend on what else the machine does puts another there before it renders. */
extern clockid_t cs_clock;
double cs_now_s(void);

#ifdef __cplusplus
}
#endif

#endif
