#include "report/map_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "report/failure.h"
#include "report/output.h"
#include "report/words.h"

enum {
    NAME_SIZE = 96
};

/* The planes of a study: a slope and a gain for each curve. */
typedef struct error_map {
    const error_study *study;
    int window[4]; /* x0, x1, y0, y1 in the full image, px */
    int width;
    int height;
    size_t pixels;
    float *slope; /* [curve * pixels + pixel] */
    float *gain;  /* NaN without a curve of shear none, or without variance */
} error_map;

static double error_at(const error_series *series, size_t size, size_t pixel)
{
    int window[4];
    return (double)clshear_convergence_map(series->result, size, window)[pixel];
}

/* Least squares of log error over log N. */
static float slope_at(const error_series *series, size_t pixel)
{
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (size_t k = 0; k < clshear_convergence_sizes(series->result); k++) {
        const double error = error_at(series, k, pixel);
        if (!(error > 0.0)) continue;
        const double n = log((double)clshear_convergence_count(series->result, k));
        count += 1.0, x += n, y += log(error), xx += n * n, xy += n * log(error);
    }
    return count < 2.0 ? NAN : (float)((count * xy - x * y) / (count * xx - x * x));
}

/* The curve of the same sampler without a shear; NULL if there is none. */
static const error_series *base_of(const error_study *study, const error_series *series)
{
    for (size_t s = 0; s < study->count; s++) {
        const error_series *base = &study->series[s];
        if (strcmp(base->sampler, series->sampler) == 0 && strcmp(base->shear, "none") == 0)
            return base;
    }
    return NULL;
}

/* Whether a curve has a gain to draw: it is not the one that gains are over. */
static int has_gain(const error_study *study, size_t number)
{
    const error_series *series = &study->series[number], *base = base_of(study, series);
    return base != NULL && base != series;
}

static int fill(error_map *map)
{
    const error_study *study = map->study;
    map->slope = malloc(2 * study->count * map->pixels * sizeof *map->slope);
    if (map->slope == NULL) return 0;
    map->gain = map->slope + study->count * map->pixels;
    for (size_t s = 0; s < study->count; s++) {
        const error_series *series = &study->series[s], *base = base_of(study, series);
        const size_t last = clshear_convergence_sizes(series->result) - 1;
        for (size_t i = 0; i < map->pixels; i++) {
            const double own = error_at(series, last, i);
            const double other = base != NULL ? error_at(base, last, i) : NAN;
            map->slope[s * map->pixels + i] = slope_at(series, i);
            map->gain[s * map->pixels + i] = own > 0.0 ? (float)(other / own) : NAN;
        }
    }
    return 1;
}

static void write_rows(FILE *stream, const void *user)
{
    const error_map *map = user;
    fprintf(stream, "x,y,sampler,shear,slope,gain\n");
    for (size_t i = 0; i < map->pixels; i++)
        for (size_t s = 0; s < map->study->count; s++)
            fprintf(stream, "%d,%d,%s,%s,%.4g,%.4g\n",
                    map->window[0] + (int)(i % (size_t)map->width),
                    map->window[2] + (int)(i / (size_t)map->width), map->study->series[s].sampler,
                    map->study->series[s].shear, (double)map->slope[s * map->pixels + i],
                    (double)map->gain[s * map->pixels + i]);
}

static int write_channels(const error_map *map, const char *path)
{
    static char texts[2 * MOST_SERIES][NAME_SIZE];
    const char *names[2 * MOST_SERIES];
    const float *planes[2 * MOST_SERIES];
    for (size_t s = 0; s < map->study->count; s++)
        for (size_t part = 0; part < 2; part++) {
            const size_t at = 2 * s + part;
            snprintf(texts[at], NAME_SIZE, "%s.%s.%s", map->study->series[s].sampler,
                     map->study->series[s].shear, part == 0 ? "Slope" : "Gain");
            names[at] = texts[at];
            planes[at] = (part == 0 ? map->slope : map->gain) + s * map->pixels;
        }
    return exit_status_of(
        clshear_image_write(path, map->width, map->height, 2 * map->study->count, names, planes));
}

/* Mixes three colours: at 0, at 1/2 and at 1. */
static void mix(double at, const double (*colours)[3], float *rgb)
{
    at = fmin(fmax(at, 0.0), 1.0);
    const int upper = at >= 0.5;
    const double part = 2.0 * at - upper;
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)((1.0 - part) * colours[upper][c] + part * colours[upper + 1][c]);
}

static void colour_of_slope(double slope, float *rgb)
{
    static const double colours[3][3] = {{0.02, 0.0, 0.1}, {0.35, 0.08, 0.3}, {1.0, 0.85, 0.4}};
    mix(isnan(slope) ? 0.0 : -0.5 * slope, colours, rgb);
}

/* Grey at 1; logarithms to 1/10 on one side and to 1000 on the other. */
static void colour_of_gain(double gain, float *rgb)
{
    static const double colours[3][3] = {{0.0, 0.1, 0.8}, {0.5, 0.5, 0.5}, {0.9, 0.05, 0.0}};
    const double decades = isnan(gain) ? 0.0 : log10(fmax(gain, 1e-30));
    mix(0.5 + decades / (decades < 0.0 ? 2.0 : 6.0), colours, rgb);
}

/* Panel number `panel` of a picture of `panels`. */
static void draw_panel(const error_map *map, const float *values,
                       void (*colour)(double value, float *rgb), size_t panel, size_t panels,
                       float *picture)
{
    const size_t width = (size_t)map->width, all = panels * map->pixels;
    for (size_t i = 0; i < map->pixels; i++) {
        float rgb[3];
        colour((double)values[i], rgb);
        for (size_t c = 0; c < 3; c++)
            picture[c * all + i / width * panels * width + panel * width + i % width] = rgb[c];
    }
}

static int write_picture(const error_map *map, const char *path)
{
    static const char *const names[] = {"R", "G", "B"};
    const error_study *study = map->study;
    size_t panels = study->count;
    for (size_t s = 0; s < study->count; s++)
        panels += (size_t)has_gain(study, s);
    float *picture = calloc(3 * panels * map->pixels + 1, sizeof *picture);
    if (picture == NULL) return complain(EXIT_FAILED, "out of memory");
    size_t panel = 0;
    for (size_t s = 0; s < study->count; s++)
        draw_panel(map, map->slope + s * map->pixels, colour_of_slope, panel++, panels, picture);
    for (size_t s = 0; s < study->count; s++)
        if (has_gain(study, s))
            draw_panel(map, map->gain + s * map->pixels, colour_of_gain, panel++, panels, picture);
    const float *const planes[] = {picture, picture + panels * map->pixels,
                                   picture + 2 * panels * map->pixels};
    const int code = exit_status_of(
        clshear_image_write(path, (int)panels * map->width, map->height, 3, names, planes));
    free(picture);
    return code;
}

int map_write(const error_study *study, const char *path)
{
    error_map map = {.study = study};
    clshear_convergence_map(study->series[0].result, 0, map.window);
    map.width = map.window[1] - map.window[0];
    map.height = map.window[3] - map.window[2];
    map.pixels = (size_t)map.width * (size_t)map.height;
    int code = fill(&map) ? EXIT_DONE : complain(EXIT_FAILED, "out of memory");
    if (code == EXIT_DONE && has_ending(".csv", path))
        code = write_file(path, write_rows, &map);
    else if (code == EXIT_DONE && has_ending(".exr", path))
        code = write_channels(&map, path);
    else if (code == EXIT_DONE)
        code = write_picture(&map, path);
    free(map.slope);
    return code;
}
