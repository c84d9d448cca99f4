/* The test of a device: does it compute what the host does? */
#ifndef CS_CONTEXT_SELF_TEST_H
#define CS_CONTEXT_SELF_TEST_H

#include "context/context.h"

/* Draws known tuples and traces a known bundle of rays, once for each device, driver, packet width
 * and version of the kernels: that a device has passed is kept in the cache folder. Fails where it
 * has not, with the values that differ; warns instead if the context is forced. */
clshear_status cs_self_test(clshear_context *context, cs_error *error);

#endif
