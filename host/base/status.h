/* How the library fails: a status is returned, the reason is kept in a cs_error. */
#ifndef CS_BASE_STATUS_H
#define CS_BASE_STATUS_H

#include "clshear/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cs_error {
    char message[1024];
} cs_error;

/* Records the reason, in one line, and returns `status`. */
clshear_status cs_fail(cs_error *error, clshear_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The reason of the calling thread's last failure: what public functions pass down. */
cs_error *cs_thread_error(void);

/* How a render that the progress callback stopped unwinds. It never leaves the library: the render
 * succeeds with an incomplete film. */
#define CS_CANCELLED ((clshear_status)1000)

/* Both jump to the label `done`, where what was acquired is released; `status` is the function's.
 */
#define CS_TRY(call)                         \
    do {                                     \
        status = (call);                     \
        if (status != CLSHEAR_OK) goto done; \
    } while (0)
#define CS_REQUIRE(condition, failure, ...)                  \
    do {                                                     \
        if (!(condition)) {                                  \
            status = cs_fail(error, (failure), __VA_ARGS__); \
            goto done;                                       \
        }                                                    \
    } while (0)

/* Where warnings go. */
typedef struct cs_log {
    void (*warn)(void *user, const char *line);
    void *user;
} cs_log;

void cs_warn(const cs_log *log, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Seconds since some fixed moment. */
double cs_now_s(void);

#ifdef __cplusplus
}
#endif

#endif
