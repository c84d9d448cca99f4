/* Where a command's points come from: a sampler or a file. */
#ifndef CS_PROGRAM_COMMANDS_POINT_SOURCE_H
#define CS_PROGRAM_COMMANDS_POINT_SOURCE_H

#include <clshear/analysis.h>
#include <stddef.h>

#include "options/options.h"
#include "report/output.h"

/* The first member of the structs of commands that take points. */
typedef struct point_source {
    program_options options;
    number_list count;
    number_list sets;
    number_list shear_px;
    number_list velocity_px;
    text_list in;
    text_list letters; /* coordinates that are kept */
} point_source;

#define MOST_POINTS 4294967295.0

/* Rows of a table of flags; `sets` is the help of how many sets there are. */
#define POINT_SOURCE_FLAGS(sets_help)                                                         \
    WHOLE_FLAG("n count npoints", "N", "points in a set (1024)", "",                          \
               offsetof(point_source, count), 1, 1, 1, MOST_POINTS),                          \
        WHOLE_FLAG("sets m nsets", "M", sets_help, "", offsetof(point_source, sets), 1, 1, 1, \
                   MOST_POINTS),                                                              \
        NUMBER_FLAG("shear-px", "S", "shear by S pixels per (square) aperture", "",           \
                    offsetof(point_source, shear_px), 1, 1, -1e9, 1e9),                       \
        NUMBER_FLAG("velocity-px", "VX,VY", "shear time too, by pixels an open shutter", "",  \
                    offsetof(point_source, velocity_px), 2, 1, -1e9, 1e9),                    \
        TEXT_FLAG("in points", "FILE", "read these points instead; - is standard input", "",  \
                  offsetof(point_source, in), "")

/* Settings that say which points are drawn, for the settings of a command. */
#define POINT_SOURCE_SETTINGS CLSHEAR_SAMPLER, CLSHEAR_SHEAR, CLSHEAR_SEED, CLSHEAR_FRESH_SETS

/* The letters of coordinates: film x y, lens u v, light p q, time t. A tuple of the sampler has
 * either the light's or the time. */
#define POINT_LETTERS "xyuvpqt"

/* Whether the flags fit together: EXIT_DONE, or EXIT_USAGE with a line printed. Letters are those
 * of `flag`, and `exact` many unless it is 0. */
int point_source_check(const point_source *source, const char *flag, size_t exact);

/* As check_outputs; the file of the points is spared, too. */
int point_source_check_outputs(const point_source *source, const output_files *files);

/* Draws or reads `sets` sets, shears, and keeps the letters, which are `letters` where none are
 * given for drawn points. Those that are drawn have a time if a letter or a velocity needs one. */
clshear_status point_source_make(const point_source *source, size_t sets, uint32_t seed,
                                 const char *letters, clshear_points **points);

/* The number that was given, or `fallback`. */
double number_or(const number_list *list, double fallback);

/* The seed of the settings. */
uint32_t seed_of(const program_options *options);

#endif
