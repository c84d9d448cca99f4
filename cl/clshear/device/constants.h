/* Constants of the order in which samples are drawn, and the limits of a pattern. */
#ifndef CLSHEAR_DEVICE_CONSTANTS_H
#define CLSHEAR_DEVICE_CONSTANTS_H

enum {
    CS_GROUP = 8,        /* consecutive samples that are neighbours in their first pair */
    CS_BLOCK = 16,       /* consecutive samples that no order of a pattern takes apart */
    CS_FLUSH_BLOCKS = 4, /* blocks between two updates of a pixel's state */
    CS_MAX_PATTERN =
        1 << 20,            /* samples in one pattern: strata must stay wider than a float's ulp */
    CS_FILTER_STEPS = 16,   /* floats of the lens table that describe the pixel filter */
    CS_MARGINAL_COLUMNS = 8 /* floats in a row of a tabulated marginal (marginal.h) */
};

#endif
