/* Where in an image samples converge: slope and gain of each pixel, as a table, as data and as a
 * picture. */
#ifndef CS_PROGRAM_REPORT_MAP_FILES_H
#define CS_PROGRAM_REPORT_MAP_FILES_H

#include "report/series.h"

/* Writes the pixels of a study of an image. The slope is that of least squares in logarithms over
 * the numbers of samples with an error above 0; NaN where there is none. The gain of a curve is the
 * error of the first curve of its sampler over its own, at the largest number of samples.
 *
 * .csv has a row for each pixel and curve; .exr the channels SAMPLER.SHEAR.Slope and .Gain.
 * Pictures have a panel for each curve's slope, 0 (dark) to -2 (bright), and one for each gain
 * other than the first curve's: 1/10 blue, 1 grey, 1000 red. Returns EXIT_DONE, or EXIT_FAILED with
 * a line printed. */
int map_write(const error_study *study, const char *path);

#endif
