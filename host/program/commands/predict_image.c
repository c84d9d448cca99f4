/* clshear predict SCENE --map FILE: predicted beside measured variance of all pixels of an image.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/predict.h"
#include "report/failure.h"
#include "report/output.h"
#include "report/plot.h"
#include "report/words.h"

enum {
    GRID_POINTS =
        1 << 13 /* samples of a pixel for each part and grid: a 64th of a single pixel's */
};

/* Planes of an image, one value per pixel. */
enum {
    PREDICTED,
    MEASURED, /* with sets that are shifted, as predicted */
    LOW,      /* 95 % interval of it */
    HIGH,
    UNSHIFTED, /* with sets as they are */
    PLANES
};

static const char *const names[PLANES] = {"Predicted", "Measured", "Measured.low", "Measured.high",
                                          "Unshifted"};

typedef struct variance_image {
    int window[4]; /* x0, x1, y0, y1 in the full image, px */
    int width;
    size_t pixels;
    float *planes[PLANES];
} variance_image;

/* The pixels of the settings' crop, or all. */
static int allocate(const clshear_settings *settings, variance_image *image)
{
    int64_t width = 0, height = 0;
    size_t count = 0;
    clshear_settings_get_integer(settings, CLSHEAR_WIDTH, &width);
    clshear_settings_get_integer(settings, CLSHEAR_HEIGHT, &height);
    double crop[4] = {0.0, (double)width, 0.0, (double)height};
    if (clshear_settings_is_set(settings, CLSHEAR_CROP))
        clshear_settings_get_numbers(settings, CLSHEAR_CROP, crop, 4, &count);
    for (int i = 0; i < 4; i++)
        image->window[i] = (int)crop[i];
    image->width = image->window[1] - image->window[0];
    if (image->width < 1 || image->window[3] <= image->window[2] || crop[1] > (double)width ||
        crop[3] > (double)height)
        return complain(EXIT_USAGE, "--crop %d,%d,%d,%d: is not within the image, %d x %d",
                        image->window[0], image->window[1], image->window[2], image->window[3],
                        (int)width, (int)height);
    image->pixels = (size_t)image->width * (size_t)(image->window[3] - image->window[2]);
    image->planes[0] = calloc(PLANES * image->pixels, sizeof(float));
    if (image->planes[0] == NULL) return complain(EXIT_FAILED, "out of memory");
    for (int p = 1; p < PLANES; p++)
        image->planes[p] = image->planes[p - 1] + image->pixels;
    return EXIT_DONE;
}

static void store(const pixel_result *r, const variance_image *image, size_t pixel)
{
    const double values[PLANES] = {clshear_prediction_variance(r->prediction), r->shifted.variance,
                                   fmax(r->shifted.variance - 1.96 * r->shifted.error, 0.0),
                                   r->shifted.variance + 1.96 * r->shifted.error,
                                   r->rendered.variance};
    for (int p = 0; p < PLANES; p++)
        image->planes[p][pixel] = (float)values[p];
}

/* Says how far it is, at each tenth of the pixels: a large image takes hours. */
static void tell(const predict_job *job, size_t done, size_t pixels)
{
    if (!job->source.options.quiet && done * 10 / pixels != (done - 1) * 10 / pixels)
        fprintf(stderr, "clshear: %zu of %zu pixels\n", done, pixels);
}

static int predict_all(const predict_job *job, pixel_view *view, const variance_image *image)
{
    int code = EXIT_DONE;
    if (!job->source.options.quiet && image->pixels > 10000)
        fprintf(stderr,
                "clshear: %zu pixels take long; --width and --height, or --crop, take fewer\n",
                image->pixels);
    for (size_t i = 0; i < image->pixels && code == EXIT_DONE; i++) {
        pixel_result result = {0};
        view->x = image->window[0] + (int)(i % (size_t)image->width);
        view->y = image->window[2] + (int)(i / (size_t)image->width);
        code = pixel_view_predict(job, view, GRID_POINTS, &result);
        if (code == EXIT_DONE) store(&result, image, i);
        clshear_prediction_free(result.prediction);
        if (code == EXIT_DONE) tell(job, i + 1, image->pixels);
    }
    return code;
}

static void write_rows(FILE *stream, const void *user)
{
    const variance_image *image = user;
    fprintf(stream, "x,y,predicted,measured,measured_low,measured_high,unshifted\n");
    for (size_t i = 0; i < image->pixels; i++) {
        fprintf(stream, "%d,%d", image->window[0] + (int)(i % (size_t)image->width),
                image->window[2] + (int)(i / (size_t)image->width));
        for (int p = 0; p < PLANES; p++)
            fprintf(stream, ",%.5g", (double)image->planes[p][i]);
        fprintf(stream, "\n");
    }
}

/* Predicted on the left, measured on the right: grey is the logarithm of the variance, over six
 * decades below the highest. */
static int write_picture(const variance_image *image, const char *path)
{
    static const char *const channels[] = {"R", "G", "B"};
    const size_t width = (size_t)image->width;
    float *grey = calloc(2 * image->pixels + 1, sizeof *grey), most = 1e-30f;
    if (grey == NULL) return complain(EXIT_FAILED, "out of memory");
    for (size_t i = 0; i < image->pixels; i++)
        most = image->planes[MEASURED][i] > most ? image->planes[MEASURED][i] : most;
    for (size_t i = 0; i < 2 * image->pixels; i++) {
        const size_t column = i % (2 * width), row = i / (2 * width);
        const float *plane = image->planes[column < width ? PREDICTED : MEASURED];
        const double value = (double)plane[row * width + column % width];
        const double level = 1.0 + log10(fmax(value / (double)most, 1e-30)) / 6.0;
        grey[i] = (float)pow(fmin(fmax(level, 0.0), 1.0), 2.2);
    }
    const float *const planes[] = {grey, grey, grey};
    const int code = exit_status_of(clshear_image_write(
        path, 2 * image->width, (int)(image->pixels / width), 3, channels, planes));
    free(grey);
    return code;
}

static int write_map(const variance_image *image, const char *path)
{
    const float *const planes[PLANES] = {image->planes[0], image->planes[1], image->planes[2],
                                         image->planes[3], image->planes[4]};
    if (has_ending(".csv", path)) return write_file(path, write_rows, image);
    if (!has_ending(".exr", path)) return write_picture(image, path);
    return exit_status_of(clshear_image_write(
        path, image->width, image->window[3] - image->window[2], PLANES, names, planes));
}

/* Pixels without variance have no place in logarithms. */
static void write_data(FILE *stream, const void *user)
{
    const variance_image *image = user;
    for (size_t i = 0; i < image->pixels; i++)
        if (image->planes[PREDICTED][i] > 0.0f && image->planes[MEASURED][i] > 0.0f)
            fprintf(stream, "%.5g %.5g\n", (double)image->planes[PREDICTED][i],
                    (double)image->planes[MEASURED][i]);
}

static void write_script(FILE *stream, const void *user)
{
    (void)user;
    fprintf(stream,
            "set logscale xy\nset format '10^{%%T}'\nset xlabel 'predicted variance'\n"
            "set ylabel 'measured variance'\nset key bottom right\n"
            "plot data with points pt 7 ps 0.4 lc rgb '%s' title 'pixels', \\\n"
            "  x with lines lc rgb '#000000' title 'equal'\n",
            plot_colour(0));
}

static int check(const predict_job *job)
{
    if (job->source.options.scene == NULL || job->pixel.count > 0 || job->integrand.count > 0)
        return complain(EXIT_USAGE, "--map and --plot are of a whole SCENE: leave out --pixel and "
                                    "--integrand");
    if (job->measure.count == 0)
        return complain(EXIT_USAGE, "--map and --plot compare: give the sets to --measure with");
    if (strcmp(job->out.items[0], "-") != 0)
        return complain(EXIT_USAGE,
                        "--out %s: is of a --pixel or an --integrand; --map FILE.csv has "
                        "the table of all pixels",
                        job->out.items[0]);
    output_files outputs = {0};
    outputs_add(&outputs, "map", job->map.items, job->map.count);
    outputs_add(&outputs, "plot", job->plot.items, job->plot.count);
    return point_source_check_outputs(&job->source, &outputs);
}

int predict_image(predict_job *job)
{
    const plot_files plot = {job->plot.count > 0 ? job->plot.items[0] : NULL, job->keep};
    variance_image image = {0};
    pixel_view view = {0};
    int code = check(job);
    if (code != EXIT_DONE) return code;
    code = pixel_view_open(job, &view);
    if (code == EXIT_DONE) code = allocate(view.settings, &image);
    if (code == EXIT_DONE) code = predict_all(job, &view, &image);
    for (size_t i = 0; i < job->map.count && code == EXIT_DONE; i++)
        code = write_map(&image, job->map.items[i]);
    if (code == EXIT_DONE) code = plot_draw(&plot, write_data, write_script, &image);
    free(image.planes[0]);
    pixel_view_close(&view);
    return code;
}
