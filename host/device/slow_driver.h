/* Long work of a driver, of which its caller is told. */
#ifndef CS_DEVICE_SLOW_DRIVER_H
#define CS_DEVICE_SLOW_DRIVER_H

#include "base/status.h"

/* Calls `work` and returns its status. If that takes longer than a few seconds, one warning says
 * that the driver of `device` compiles; it comes from the calling thread. NULL log: none. */
clshear_status cs_run_patiently(clshear_status (*work)(void *user), void *user, const char *device,
                                const cs_log *log);

#endif
