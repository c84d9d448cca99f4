/* Power of point sets at frequencies of one, two or more coordinates. */
#ifndef CS_ANALYSIS_PERIODOGRAM_H
#define CS_ANALYSIS_PERIODOGRAM_H

#include "base/status.h"
#include "device/device.h"
#include "kernels/frequencies.h"
#include "points/points.h"

/* A grid of frequencies. The frequency of a cell is the sum of its column's and its row's. */
typedef struct cs_lattice {
    cs_frequencies sets[2];
    uint32_t counts[2]; /* number of columns and rows */
} cs_lattice;

/* Writes the mean over sets of |sum of exp(-2 pi i f.x)|^2 / N. Points have coordinates in [0, 1).
 * `power` has counts[1] rows of counts[0] values. */
clshear_status cs_periodogram(cs_device *device, const clshear_points *points,
                              const cs_lattice *lattice, float *power, cs_error *error);

#endif
