/* What benchmarks share: flags, settings, medians, and results as lines of JSON. */
#ifndef CS_BENCH_MEASURE_H
#define CS_BENCH_MEASURE_H

#include <stddef.h>

#include "clshear/clshear.h"

enum {
    BENCH_MOST_ROUNDS = 64
};

/* A flag with a value: exactly one of the targets is not NULL. */
typedef struct bench_flag {
    const char *name; /* without dashes */
    const char **text;
    size_t *count;
    int *number;
    double *real;
} bench_flag;

/* Reads `--name value` pairs; prints a line and exits with 2 for others. */
void bench_read_flags(int argc, char **argv, const bench_flag *flags, size_t count);

/* Of 1 or more values; sorts them. A part of 0.5 is the median, 0.1 the tenth percentile. */
double bench_median(double *values, int count);
double bench_quantile(double *values, int count, double part);

/* Rounds to take, of those asked for: 1 to BENCH_MOST_ROUNDS. */
int bench_rounds(int wanted);

/* Prints the thread's message and exits with 1 unless the call succeeded. */
void bench_must(clshear_status status);

/* Settings from a file, or fallbacks for NULL; freed by the caller. */
clshear_settings *bench_settings(const char *path);

/* Set numbers of any kind, or a text where there is one; exit on failures. */
void bench_set(clshear_settings *settings, clshear_setting setting, double value);
void bench_set_vector(clshear_settings *settings, clshear_setting setting, const float *vector);
void bench_set_text(clshear_settings *settings, clshear_setting setting, const char *text);

/* Renders with these settings; exits on failures. */
clshear_film *bench_render(clshear_scene *scene, const clshear_settings *settings);

/* One JSON object, written as a line to the end of a file; path NULL: nowhere. */
typedef struct bench_record bench_record;
bench_record *bench_record_begin(const char *path, const char *benchmark);
void bench_record_text(bench_record *record, const char *name, const char *value);
void bench_record_number(bench_record *record, const char *name, double value);
void bench_record_end(bench_record *record);

#endif
