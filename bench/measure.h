/* What benchmarks share: flags, medians, and results as lines of JSON. */
#ifndef CS_BENCH_MEASURE_H
#define CS_BENCH_MEASURE_H

#include <stddef.h>

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

/* Of 1 to BENCH_MOST_ROUNDS values; sorts them. */
double bench_median(double *values, int count);

/* One JSON object, written as a line to the end of a file; path NULL: nowhere. */
typedef struct bench_record bench_record;
bench_record *bench_record_begin(const char *path, const char *benchmark);
void bench_record_text(bench_record *record, const char *name, const char *value);
void bench_record_number(bench_record *record, const char *name, double value);
void bench_record_end(bench_record *record);

#endif
