/* Shared code of the benchmarks: flags, settings, medians, and results as lines of JSON. */
#ifndef CS_BENCH_MEASURE_H
#define CS_BENCH_MEASURE_H

#include <stddef.h>

#include "clshear/clshear.h"

enum {
    BENCH_MOST_ROUNDS = 64
};

/* A flag with a value. Exactly one of the targets is not NULL. */
typedef struct bench_flag {
    const char *name; /* without dashes */
    const char **text;
    size_t *count;
    int *number;
    double *real;
} bench_flag;

/* Reads `--name value` pairs. For other arguments, prints a line and exits with 2. */
void bench_read_flags(int argc, char **argv, const bench_flag *flags, size_t count);

/* Sorts `count` values (1 or more) and returns a percentile. `part` is 0.5 for the median, 0.1 for
 * the tenth percentile. */
double bench_median(double *values, int count);
double bench_quantile(double *values, int count, double part);

/* CPU seconds of the process so far, of all its threads: on a busy machine it tells more than the
 * clock on the wall. */
double bench_cpu_s(void);

/* Clamps a number of rounds to 1 ... BENCH_MOST_ROUNDS. */
int bench_rounds(int wanted);

/* Unless `status` is CLSHEAR_OK, prints the thread's message and exits with 1. */
void bench_must(clshear_status status);

/* Reads settings from a file; NULL: fallbacks. The caller frees them. */
clshear_settings *bench_settings(const char *path);

/* Set a number of any kind, or a text. They exit on failure. */
void bench_set(clshear_settings *settings, clshear_setting setting, double value);
void bench_set_vector(clshear_settings *settings, clshear_setting setting, const float *vector);
void bench_set_text(clshear_settings *settings, clshear_setting setting, const char *text);

/* Renders with these settings. Exits on failure. */
clshear_film *bench_render(clshear_scene *scene, const clshear_settings *settings);

/* A JSON object, appended to a file as a line. Path NULL: not written. */
typedef struct bench_record bench_record;
bench_record *bench_record_begin(const char *path, const char *benchmark);
void bench_record_text(bench_record *record, const char *name, const char *value);
void bench_record_number(bench_record *record, const char *name, double value);
void bench_record_end(bench_record *record);

#endif
