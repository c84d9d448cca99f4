/* The floating-point environment in which the library computes, whatever the caller has set. */
#ifndef CS_BASE_FLOATS_H
#define CS_BASE_FLOATS_H

#include <fenv.h>

static inline void cs_floats_plain(fenv_t *given)
{
    fegetenv(given);
    fesetenv(FE_DFL_ENV);
}

static inline void cs_floats_restore(const fenv_t *given)
{
    fesetenv(given);
}

/* From here to the end of the calling function, numbers are rounded to the nearest and nothing
 * traps, in threads that are started here, too. Embree ends the process under another rounding, and
 * drivers divide by 0. */
#define CS_PLAIN_FLOATS                                                 \
    fenv_t cs_given_floats __attribute__((cleanup(cs_floats_restore))); \
    cs_floats_plain(&cs_given_floats)

#endif
