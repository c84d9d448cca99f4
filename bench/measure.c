#include "measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static int store(const bench_flag *flag, const char *value)
{
    char *end = NULL;
    const double number = strtod(value, &end);
    if (flag->text != NULL) {
        *flag->text = value;
        return 1;
    }
    if (end == value || *end != '\0' || !(number >= 0.0)) return 0;
    if (flag->count != NULL) *flag->count = (size_t)number;
    if (flag->number != NULL) *flag->number = (int)number;
    if (flag->real != NULL) *flag->real = number;
    return 1;
}

void bench_read_flags(int argc, char **argv, const bench_flag *flags, size_t count)
{
    for (int i = 1; i < argc; i += 2) {
        size_t f = 0;
        while (f < count &&
               (strncmp(argv[i], "--", 2) != 0 || strcmp(argv[i] + 2, flags[f].name) != 0))
            f++;
        if (f < count && i + 1 < argc && store(&flags[f], argv[i + 1])) continue;
        fprintf(stderr, "%s: %s: flags, each with a value, are", argv[0], argv[i]);
        for (size_t k = 0; k < count; k++)
            fprintf(stderr, " --%s", flags[k].name);
        fprintf(stderr, "\n");
        exit(2);
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *values, int count)
{
    return bench_quantile(values, count, 0.5);
}

double bench_quantile(double *values, int count, double part)
{
    qsort(values, (size_t)count, sizeof *values, ascending);
    return values[(int)(part * count)];
}

double bench_cpu_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int bench_rounds(int wanted)
{
    if (wanted < 1) return 1;
    return wanted < BENCH_MOST_ROUNDS ? wanted : BENCH_MOST_ROUNDS;
}

void bench_must(clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "%s: %s\n", clshear_status_name(status), clshear_message());
    exit(1);
}

clshear_settings *bench_settings(const char *path)
{
    clshear_settings *settings = NULL;
    bench_must(clshear_settings_create(&settings));
    bench_set(settings, CLSHEAR_BOUNCES, 0.0);
    bench_set(settings, CLSHEAR_ADAPTIVE, 0.0);
    if (path != NULL) bench_must(clshear_settings_read(settings, path, NULL, NULL));
    return settings;
}

void bench_set(clshear_settings *settings, clshear_setting setting, double value)
{
    bench_must(clshear_settings_set_numbers(settings, setting, &value, 1));
}

void bench_set_vector(clshear_settings *settings, clshear_setting setting, const float *vector)
{
    const double numbers[3] = {(double)vector[0], (double)vector[1], (double)vector[2]};
    bench_must(clshear_settings_set_numbers(settings, setting, numbers, 3));
}

void bench_set_text(clshear_settings *settings, clshear_setting setting, const char *text)
{
    if (text != NULL) bench_must(clshear_settings_set_text(settings, setting, text));
}

clshear_film *bench_render(clshear_scene *scene, const clshear_settings *settings)
{
    clshear_film *film = NULL;
    bench_must(clshear_render(scene, settings, &film));
    return film;
}

struct bench_record {
    FILE *file;
};

bench_record *bench_record_begin(const char *path, const char *benchmark)
{
    if (path == NULL) return NULL;
    bench_record *record = malloc(sizeof *record);
    if (record == NULL) abort();
    record->file = fopen(path, "a");
    if (record->file == NULL) {
        perror(path);
        exit(1);
    }
    fprintf(record->file, "{\"benchmark\": \"%s\"", benchmark);
    return record;
}

void bench_record_text(bench_record *record, const char *name, const char *value)
{
    if (record != NULL) fprintf(record->file, ", \"%s\": \"%s\"", name, value);
}

void bench_record_number(bench_record *record, const char *name, double value)
{
    if (record == NULL) return;
    if (isfinite(value))
        fprintf(record->file, ", \"%s\": %.6g", name, value);
    else
        fprintf(record->file, ", \"%s\": null", name);
}

void bench_record_end(bench_record *record)
{
    if (record == NULL) return;
    fprintf(record->file, "}\n");
    if (fclose(record->file) != 0) exit(1);
    free(record);
}
