/* Which frequencies a table of exponentials has. Shared. */
#ifndef CS_KERNELS_FREQUENCIES_H
#define CS_KERNELS_FREQUENCIES_H

#include "clshear/device/dialect.h"

/* Column c is for frequency first[0] + step[0] * (c % wide) of coordinate number coordinate[0],
 * together with first[1] + step[1] * (c / wide % deep) of coordinate[1] and first[2] + step[2] * (c
 * / wide / deep) of coordinate[2]; steps of 0 leave one out. Two such tables reach a plane of two
 * coordinates, a block of four or five, or far out along one. */
typedef struct cs_frequencies {
    cs_u32 coordinate[3];
    cs_i32 first[3];
    cs_i32 step[3];
    cs_u32 wide; /* 1 or more */
    cs_u32 deep; /* 1 or more */
} cs_frequencies;
CS_SHARED_WORDS(cs_frequencies, 11);

#endif
