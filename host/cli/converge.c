#include "cli/converge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/converge_image.h"
#include "cli/output.h"
#include "cli/render.h"
#include "cli/scene.h"

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

/* Means of all replicates of all sizes for one series, of an integrand. */
static clshear_status integrate(const cli_converge_job *job, cli_series *series, double *means)
{
    for (int k = 0; k < job->size_count; k++) {
        clshear_points points = {0};
        clshear_status status = clshear_points_draw(
            series->sampler, job->counts[k], job->replicates, job->render.options.seed, &points);
        if (status != CLSHEAR_OK) return status;
        series->counts[k] = (uint32_t)points.count;
        if (points.count != job->counts[k])
            fprintf(stderr, "clshear: sampler %s has no sets of %u points: %zu\n", series->sampler,
                    job->counts[k], points.count);
        clshear_points_integrate(&points, &job->integrand, 0, 0,
                                 means + (size_t)k * job->replicates);
        clshear_points_free(&points);
    }
    return CLSHEAR_OK;
}

/* The mean of R, G and B of a pixel's pattern. */
static double pattern_mean(const clshear_film *film, uint32_t replicate)
{
    double sum = 0.0;
    for (const char *colour = "RGB"; *colour != '\0'; colour++) {
        char name[32];
        snprintf(name, sizeof name, "Pattern%u.%c", replicate, *colour);
        sum += (double)*clshear_film_channel(film, name) / 3.0;
    }
    return sum;
}

/* The same of a pixel. */
static clshear_status render_pixel(const cli_converge_job *job, const cli_view *view,
                                   const int *pixel, clshear_shear shear, cli_series *series,
                                   double *means)
{
    const int crop[4] = {pixel[0], pixel[0] + 1, pixel[1], pixel[1] + 1};
    for (int k = 0; k < job->size_count; k++) {
        clshear_film *film = NULL;
        clshear_options options = cli_converge_options(job, series->sampler, shear, job->counts[k]);
        memcpy(options.crop, crop, sizeof crop);
        options.keep_patterns = 1;
        clshear_status status = clshear_render(view->scene, &view->camera, &options, &film);
        if (status != CLSHEAR_OK) return status;
        series->counts[k] =
            (uint32_t)(*clshear_film_channel(film, "Samples") / (float)job->replicates + 0.5f);
        for (uint32_t r = 0; r < job->replicates; r++)
            means[(size_t)k * job->replicates + r] = pattern_mean(film, r);
        clshear_film_free(film);
    }
    return CLSHEAR_OK;
}

static clshear_status finish(const cli_converge_job *job, cli_series *series, const double *means)
{
    const size_t sizes = (size_t)job->size_count;
    const double *last = means + (sizes - 1) * job->replicates;
    series->mean = 0.0;
    for (uint32_t r = 0; r < job->replicates; r++)
        series->mean += last[r] / job->replicates;
    return clshear_fit_slope(series->counts, sizes, means, job->replicates,
                             job->has_reference ? &job->reference : NULL, series->errors,
                             &series->fit);
}

/* One series for each sampler. */
static int study_integrand(const cli_converge_job *job, cli_study *study, double *means)
{
    for (int s = 0; s < job->sampler_count; s++) {
        cli_series *series = &study->series[study->series_count++];
        snprintf(series->target, sizeof series->target, "%s", job->integrand_name);
        series->sampler = job->samplers[s];
        series->shear = "none";
        if (integrate(job, series, means) != CLSHEAR_OK || finish(job, series, means) != CLSHEAR_OK)
            return fail(clshear_message(NULL));
    }
    return CLI_DONE;
}

static int study_pixels(const cli_converge_job *job, const cli_view *v, cli_study *study,
                        double *means)
{
    for (int p = 0; p < job->pixel_count; p++)
        for (int s = 0; s < job->sampler_count; s++)
            for (int h = 0; h < job->shear_count; h++) {
                cli_series *series = &study->series[study->series_count++];
                snprintf(series->target, sizeof series->target, "pixel %d:%d", job->pixels[p][0],
                         job->pixels[p][1]);
                series->sampler = job->samplers[s];
                series->shear = job->shear_names[h];
                if (render_pixel(job, v, job->pixels[p], job->shears[h], series, means) !=
                    CLSHEAR_OK)
                    return fail(clshear_message(v->context));
                if (finish(job, series, means) != CLSHEAR_OK) return fail(clshear_message(NULL));
            }
    return CLI_DONE;
}

/* Opens the scene and studies its pixels. */
static int study_scene(cli_converge_job *job, cli_study *study, double *means)
{
    cli_view v = {0};
    int code = cli_open_scene(&job->render, &v.context, &v.scene);
    if (code == CLI_DONE && cli_choose_camera(&job->render, v.scene, &v.camera) != CLSHEAR_OK)
        code = fail(clshear_message(v.context));
    if (code == CLI_DONE) cli_tell_choices(&job->render, v.scene, &v.camera);
    if (code == CLI_DONE)
        code = job->pixel_count > 0 ? study_pixels(job, &v, study, means)
                                    : cli_study_image(job, &v, study);
    cli_close_scene(&job->render, v.context, v.scene);
    return code;
}

static int write_output(const char *path, const cli_study *study)
{
    const char *dot = strrchr(path, '.');
    const int is_json = dot != NULL && strcmp(dot, ".json") == 0;
    return cli_write_file(path, is_json ? cli_study_write_json : cli_study_write_csv, study);
}

static int check(const cli_converge_job *job)
{
    const int rendered = job->integrand_name == NULL;
    const int targets = job->pixel_count > 0 ? job->pixel_count : 1;
    if (job->integrand_name != NULL && job->integrand.kind != CLSHEAR_INTEGRAND_STEP &&
        !(job->integrand.size > 0.0))
        fprintf(stderr, "clshear: --size %g: must be above 0\n", job->integrand.size);
    else if (rendered == (job->render.scene == NULL))
        fprintf(stderr, "clshear: give either an --integrand or a SCENE\n");
    else if (job->pixel_count > 0 && !rendered)
        fprintf(stderr, "clshear: --pixels are of a SCENE, not of an --integrand\n");
    else if (job->has_reference &&
             (rendered && job->pixel_count == 0) != (job->reference_image != NULL))
        fprintf(stderr, "clshear: --reference: a picture is of a whole image, a number of --pixels "
                        "or an --integrand\n");
    else if (job->sampler_count * (rendered ? targets * job->shear_count : 1) > CLI_MOST_SERIES)
        fprintf(stderr, "clshear: more than %d curves; give fewer pixels, samplers or shears\n",
                CLI_MOST_SERIES);
    else
        return CLI_DONE;
    return CLI_USAGE;
}

static int run(cli_converge_job *job)
{
    int code = check(job);
    for (int i = 0; i < job->pixel_count && code == CLI_DONE; i++)
        code = cli_check_pixel(&job->render, "pixels", job->pixels[i]);
    if (code == CLI_DONE) code = cli_check_places("out", job->outputs, job->output_count);
    if (code == CLI_DONE) code = cli_check_place("plot", job->plot.path);
    if (code != CLI_DONE) return code;
    cli_study *study = calloc(1, sizeof *study);
    double *means = calloc((size_t)job->size_count * job->replicates, sizeof *means);
    if (study == NULL || means == NULL) {
        code = fail("out of memory");
    } else {
        study->sizes = (size_t)job->size_count;
        study->replicates = job->replicates;
        study->has_reference = job->has_reference;
        code = job->integrand_name == NULL ? study_scene(job, study, means)
                                           : study_integrand(job, study, means);
        for (int i = 0; i < job->output_count && code == CLI_DONE; i++)
            code = write_output(job->outputs[i], study);
        if (code == CLI_DONE) code = cli_study_draw(study, &job->plot);
    }
    free(study);
    free(means);
    return code;
}

int cli_converge(int argc, char **argv)
{
    cli_flag flags[CLI_MOST_FLAGS];
    const cli_command command = cli_converge_command(flags);
    const cli_converge_job defaults = {.render = cli_job_defaults(),
                                       .samplers = {"mj", "sz"},
                                       .sampler_count = 2,
                                       .shears = {CLSHEAR_SHEAR_NONE, CLSHEAR_SHEAR_EQUAL_AREA},
                                       .shear_names = {"none", "equal-area"},
                                       .shear_count = 2,
                                       .counts = {16, 64, 256, 1024},
                                       .size_count = 4,
                                       .replicates = 0};
    cli_converge_job job;
    int code = cli_parse_scene(&command, &defaults, sizeof job, argc, argv, &job);
    if (code != CLI_DONE) return code;
    if (job.render.help) {
        cli_print_help(&cli_converge_help);
        return CLI_DONE;
    }
    if (job.size_given) job.integrand.size = job.size;
    if (job.replicates == 0)
        job.replicates = job.integrand_name == NULL && job.pixel_count == 0 ? 8 : 200;
    if (job.output_count == 0 && job.plot.path == NULL) job.outputs[job.output_count++] = "-";
    return run(&job);
}
