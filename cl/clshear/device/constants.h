/* Constants of the order in which samples are drawn, and limits of patterns and tables. */
#ifndef CLSHEAR_DEVICE_CONSTANTS_H
#define CLSHEAR_DEVICE_CONSTANTS_H

enum {
    CS_GROUP = 8,             /* consecutive samples that are neighbours on the film */
    CS_BLOCK = 16,            /* consecutive samples that every order of a pattern keeps together */
    CS_FLUSH_BLOCKS = 4,      /* blocks between two updates of a pixel's state in the renderer */
    CS_MAX_PATTERN = 1 << 20, /* samples in one pattern: strata stay wider than a float's ulp */
    CS_FILTER_STEPS = 16,     /* floats at the start of a lens table: heights of the pixel filter */
    CS_MARGINAL_COLUMNS = 8   /* floats in a row of a tabulated marginal (marginal.h) */
};

#endif
