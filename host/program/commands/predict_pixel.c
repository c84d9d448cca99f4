/* clshear predict SCENE --pixel X,Y: the variance that spectra let expect, of a pixel. */
#include <stdio.h>
#include <stdlib.h>

#include "commands/outputs.h"
#include "commands/predict.h"
#include "report/failure.h"
#include "report/output.h"

enum {
    CHUNK = 1 << 16 /* samples whose radiance is on its way at once */
};

/* The pixel as a function of what a sampler draws: the mean of R, G and B. */
static clshear_status evaluate(void *user, const float *points, size_t count, float *values)
{
    const pixel_view *v = user;
    for (size_t first = 0; first < count; first += CHUNK) {
        const size_t part = count - first < CHUNK ? count - first : CHUNK;
        const clshear_status status =
            v->moves ? clshear_moving_radiance_of_samples(v->view.scene, v->settings, v->x, v->y,
                                                          v->shear_px, v->velocity_px,
                                                          points + 5 * first, part, v->rgb)
                     : clshear_radiance_of_samples(v->view.scene, v->settings, v->x, v->y,
                                                   v->shear_px, points + 4 * first, part, v->rgb);
        if (status != CLSHEAR_OK) return status;
        for (size_t i = 0; i < part; i++)
            values[first + i] = (v->rgb[3 * i] + v->rgb[3 * i + 1] + v->rgb[3 * i + 2]) / 3.0f;
    }
    return CLSHEAR_OK;
}

/* Points without the shear, which is part of the integrand. */
static clshear_status draw(const predict_job *job, const pixel_view *v, size_t sets, uint32_t seed,
                           clshear_points **points)
{
    point_source source = job->source;
    source.shear_px.count = source.velocity_px.count = 0;
    source.letters.count = 0;
    return point_source_make(&source, sets, seed, v->moves ? "xyuvt" : "xyuv", points);
}

static int measure(const predict_job *job, pixel_view *v, pixel_result *r)
{
    const size_t sets = (size_t)job->measure.items[0];
    const uint32_t seed = seed_of(&job->source.options) + 1;
    clshear_points *points = NULL;
    double *means = malloc(sets * sizeof *means);
    if (means == NULL) return complain(EXIT_FAILED, "out of memory");
    clshear_status status = draw(job, v, sets, seed, &points);
    for (int homogenise = 0; homogenise < 2 && status == CLSHEAR_OK; homogenise++) {
        measurement *m = homogenise ? &r->shifted : &r->rendered;
        status = clshear_points_integrate_4d(points, evaluate, v, homogenise, seed, means);
        if (status == CLSHEAR_OK)
            status =
                clshear_variance_of(means, clshear_points_sets(points), &m->variance, &m->error);
    }
    clshear_points_free(points);
    free(means);
    return exit_status_of(status);
}

static void write_measurement(FILE *stream, const char *name, const measurement *m)
{
    fprintf(stream, "%s,%.5g,\n%s 95%% low,%.5g,\n%s 95%% high,%.5g,\n", name, m->variance, name,
            m->variance - 1.96 * m->error, name, m->variance + 1.96 * m->error);
}

static void write_table(FILE *stream, const void *user)
{
    const pixel_result *r = user;
    const clshear_prediction *p = r->prediction;
    const double energy = clshear_prediction_energy(p);
    fprintf(stream, "part,variance,energy\n");
    for (size_t i = 0; i < clshear_prediction_parts(p); i++)
        fprintf(stream, "%s,%.5g,%.5g\n", clshear_prediction_part_name(p, i),
                clshear_prediction_part_variance(p, i), clshear_prediction_part_energy(p, i));
    fprintf(stream, "predicted,%.5g,%.5g\nrandom points,%.5g,\n", clshear_prediction_variance(p),
            energy, energy / (double)r->count);
    if (!r->is_measured) return;
    write_measurement(stream, "measured", &r->shifted);
    write_measurement(stream, "measured unshifted", &r->rendered);
}

static int predict(const predict_job *job, pixel_view *v, size_t reach_points, pixel_result *r)
{
    const size_t sets = (size_t)number_or(&job->source.sets, 500.0);
    clshear_points *points = NULL;
    clshear_status status = draw(job, v, sets, seed_of(&job->source.options), &points);
    if (status != CLSHEAR_OK) return exit_status_of(status);
    r->count = clshear_points_count(points);
    const uint32_t wanted = r->count < 16384 ? 4 * (uint32_t)r->count : 65536;
    const clshear_reach reach = {.struct_size = sizeof reach,
                                 .axis = wanted < 1024 ? 1024 : wanted,
                                 .plane = (uint32_t)job->resolution.items[0] / 2,
                                 .block = (uint32_t)number_or(&job->block, v->moves ? 4.0 : 8.0),
                                 .points = reach_points};
    status =
        clshear_predict_variance_4d(v->view.context, points, evaluate, v, &reach, &r->prediction);
    clshear_points_free(points);
    return exit_status_of(status);
}

static int check(const predict_job *job)
{
    const program_options *options = &job->source.options;
    if (options->scene == NULL)
        return complain(EXIT_USAGE, "--pixel is of a SCENE; see clshear predict --help");
    if (job->integrand.count > 0)
        return complain(EXIT_USAGE, "give either an --integrand or a --pixel");
    if (job->source.in.count > 0)
        return complain(EXIT_USAGE, "--in %s: a --pixel needs a sampler", job->source.in.items[0]);
    output_files outputs = {0};
    outputs_add(&outputs, "out", job->out.items, 1);
    const int code = check_pixel(options, "pixel", job->pixel.items);
    return code == EXIT_DONE ? check_outputs(options, &outputs) : code;
}

/* The shear that is given, or the oracle's; and the velocity. */
static clshear_status find_shear(const predict_job *job, pixel_view *v)
{
    const clshear_status status =
        clshear_pixel_motion(v->view.scene, v->settings, v->x, v->y, &v->moves, v->velocity_px);
    if (status != CLSHEAR_OK) return status;
    for (size_t i = 0; i < job->source.velocity_px.count; i++)
        v->velocity_px[i] = (float)job->source.velocity_px.items[i];
    if (job->source.shear_px.count == 0)
        return clshear_pixel_shear(v->view.scene, v->settings, v->x, v->y, &v->shear_px);
    v->shear_px = (float)job->source.shear_px.items[0];
    return CLSHEAR_OK;
}

int pixel_view_open(predict_job *job, pixel_view *view)
{
    view->settings = job->source.options.settings;
    view->rgb = malloc((size_t)3 * CHUNK * sizeof *view->rgb);
    if (view->rgb == NULL) return complain(EXIT_FAILED, "out of memory");
    return scene_view_open(&job->source.options, &view->view);
}

void pixel_view_close(pixel_view *view)
{
    scene_view_close(&view->view);
    free(view->rgb);
}

int pixel_view_predict(const predict_job *job, pixel_view *view, size_t points,
                       pixel_result *result)
{
    result->is_measured = job->measure.count > 0;
    int code = exit_status_of(find_shear(job, view));
    if (code == EXIT_DONE) code = predict(job, view, points, result);
    if (code == EXIT_DONE && result->is_measured) code = measure(job, view, result);
    return code;
}

int predict_pixel(predict_job *job)
{
    int code = check(job);
    if (code != EXIT_DONE) return code;
    pixel_view v = {.x = (int)job->pixel.items[0], .y = (int)job->pixel.items[1]};
    pixel_result r = {0};
    code = pixel_view_open(job, &v);
    if (code == EXIT_DONE) code = pixel_view_predict(job, &v, 0, &r);
    if (code == EXIT_DONE) code = write_file(job->out.items[0], write_table, &r);
    clshear_prediction_free(r.prediction);
    pixel_view_close(&v);
    return code;
}
