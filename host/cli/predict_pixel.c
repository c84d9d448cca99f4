#include "cli/predict_pixel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/output.h"
#include "cli/predict.h"
#include "cli/render.h"
#include "cli/scene.h"

enum {
    CHUNK = 1 << 16 /* samples whose radiance is on its way at once */
};

/* Begins with a cli_job: the flags of rendering write there. */
typedef struct pixel_job {
    cli_job render;
    int pixel[2];
    uint32_t count, sets;
    uint32_t measured_sets; /* 0: not measured */
    int resolution, block;
    cli_number shear_px;
    const char *out;
} pixel_job;

static const char *store_pixel(void *target, const char *value)
{
    pixel_job *job = target;
    return cli_read_ints(value, 2, 0, 65535, job->pixel) ? NULL : "x,y";
}

static const char *store_count(void *target, const char *value)
{
    pixel_job *job = target;
    return cli_read_count(value, 1, &job->count) ? NULL : "a whole number from 1";
}

static const char *store_sets(void *target, const char *value)
{
    pixel_job *job = target;
    return cli_read_count(value, 1, &job->sets) ? NULL : "a whole number from 1";
}

static const char *store_measure(void *target, const char *value)
{
    pixel_job *job = target;
    return cli_read_count(value, 2, &job->measured_sets) ? NULL : "a whole number from 2";
}

static const char *store_resolution(void *target, const char *value)
{
    pixel_job *job = target;
    return cli_read_ints(value, 1, 3, 4095, &job->resolution) ? NULL : "a whole number, 3 to 4095";
}

static const char *store_block(void *target, const char *value)
{
    pixel_job *job = target;
    return cli_read_ints(value, 1, 1, 15, &job->block) ? NULL : "a whole number, 1 to 15";
}

static const char *store_shear_px(void *target, const char *value)
{
    pixel_job *job = target;
    job->shear_px.given = 1;
    return cli_read_floats(value, 1, &job->shear_px.value) ? NULL : "a number of pixels";
}

static const char *store_out(void *target, const char *value)
{
    pixel_job *job = target;
    job->out = value;
    return *value != '\0' ? NULL : "a file, or - for standard output";
}

static const cli_flag own_flags[] = {
    {"pixel", "X,Y", "the pixel", store_pixel},
    {"n count npoints", "N", "samples in a set (1024)", store_count},
    {"sets m nsets", "M", "independent sets (500)", store_sets},
    {"measure", "M", "measure too, with M other sets", store_measure},
    {"resolution", "R", "frequencies along a side of planes, up to 4095 (255)", store_resolution},
    {"block", "B", "highest frequency of the block, up to 15 (8)", store_block},
    {"shear-px", "S", "shear by S pixels (the oracle's)", store_shear_px},
    {"out o", "FILE", "table, - is standard output (-)", store_out},
};
enum {
    OWN_FLAGS = sizeof own_flags / sizeof *own_flags
};

static const cli_command help = {
    .name = "predict",
    .summary = "usage: clshear predict SCENE --pixel X,Y [flags]\n"
               "Predict the variance of a pixel from the spectra of samples and integrand.\n\n"
               "  clshear predict scenes/cornell.obj --pixel 302,130 --sampler mj --measure 1000\n",
    .notes = "The shear is part of the integrand: x, y, u and v are what the sampler draws.\n"
             "Parts are frequencies of one coordinate, of two, of three or four (the\n"
             "block), and the rest, for which samples count as random. Values are means of R,\n"
             "G and B; an area light is one point. The variance is that of sets shifted around\n"
             "the torus; --measure has that and the variance of sets as they are. Flags of\n"
             "rendering: --sampler, --shear, --oracle, --filter, camera, lens, lights.\n",
    .flags = own_flags,
    .flag_count = OWN_FLAGS,
};

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

typedef struct pixel_view {
    const pixel_job *job;
    clshear_context *context;
    clshear_scene *scene;
    clshear_camera camera;
    float shear_px;
    float *rgb; /* 3 * CHUNK */
} pixel_view;

/* The pixel as a function of what a sampler draws: the mean of R, G and B. */
static clshear_status evaluate(void *user, const float *points, size_t count, float *values)
{
    const pixel_view *v = user;
    for (size_t first = 0; first < count; first += CHUNK) {
        const size_t part = count - first < CHUNK ? count - first : CHUNK;
        const clshear_status status = clshear_radiance_of_samples(
            v->scene, &v->camera, &v->job->render.options, v->job->pixel[0], v->job->pixel[1],
            v->shear_px, points + 4 * first, part, v->rgb);
        if (status != CLSHEAR_OK) return status;
        for (size_t i = 0; i < part; i++)
            values[first + i] = (v->rgb[3 * i] + v->rgb[3 * i + 1] + v->rgb[3 * i + 2]) / 3.0f;
    }
    return CLSHEAR_OK;
}

typedef struct result {
    clshear_prediction_4d prediction;
    float shear_px;
    size_t count;
    int is_measured;
    cli_measurement shifted;  /* as predicted */
    cli_measurement rendered; /* as samples come */
} result;

static clshear_status draw(const pixel_job *job, uint32_t sets, uint32_t seed,
                           clshear_points *points)
{
    clshear_status status =
        clshear_points_draw(job->render.options.sampler, job->count, sets, seed, points);
    return status == CLSHEAR_OK ? clshear_points_select(points, "xyuv") : status;
}

static int measure(pixel_view *v, result *r)
{
    const pixel_job *job = v->job;
    const uint32_t seed = job->render.options.seed + 1;
    clshear_points points = {0};
    double *means = malloc(job->measured_sets * sizeof *means);
    int code = CLI_DONE;
    if (means == NULL) code = fail("out of memory");
    if (code == CLI_DONE && draw(job, job->measured_sets, seed, &points) != CLSHEAR_OK)
        code = fail(clshear_message(NULL));
    for (int homogenise = 0; homogenise < 2 && code == CLI_DONE; homogenise++) {
        if (clshear_points_integrate_4d(&points, evaluate, v, homogenise, seed, means) !=
            CLSHEAR_OK)
            code = fail(clshear_message(v->context));
        else if (homogenise)
            r->shifted = cli_measurement_of(means, points.sets);
        else
            r->rendered = cli_measurement_of(means, points.sets);
    }
    clshear_points_free(&points);
    free(means);
    return code;
}

static void write_measurement(FILE *stream, const char *name, cli_measurement m)
{
    fprintf(stream, "%s,%.5g,\n%s 95%% low,%.5g,\n%s 95%% high,%.5g,\n", name, m.variance, name,
            m.variance - 1.96 * m.error, name, m.variance + 1.96 * m.error);
}

static void write_table(FILE *stream, const void *user)
{
    const result *r = user;
    const clshear_prediction_4d *p = &r->prediction;
    fprintf(stream, "part,variance,energy\n");
    for (int i = 0; i < CLSHEAR_PARTS; i++)
        fprintf(stream, "%s,%.5g,%.5g\n", clshear_prediction_part(i), p->parts[i], p->energies[i]);
    fprintf(stream, "predicted,%.5g,%.5g\nrandom points,%.5g,\n", p->variance, p->energy,
            p->energy / (double)r->count);
    if (!r->is_measured) return;
    write_measurement(stream, "measured", r->shifted);
    write_measurement(stream, "measured unshifted", r->rendered);
}

static int predict(pixel_view *v, result *r)
{
    const pixel_job *job = v->job;
    clshear_points points = {0};
    int code = CLI_DONE;
    if (draw(job, job->sets, job->render.options.seed, &points) != CLSHEAR_OK)
        return fail(clshear_message(NULL));
    r->count = points.count;
    const uint32_t wanted = points.count < 16384 ? 4 * (uint32_t)points.count : 65536;
    const clshear_reach reach = {wanted < 1024 ? 1024 : wanted, (uint32_t)job->resolution / 2,
                                 (uint32_t)job->block};
    if (clshear_predict_variance_4d(v->context, &points, evaluate, v, &reach, &r->prediction) !=
        CLSHEAR_OK)
        code = fail(clshear_message(v->context));
    clshear_points_free(&points);
    return code;
}

static int run(pixel_job *job)
{
    pixel_view v = {.job = job, .rgb = malloc((size_t)3 * CHUNK * sizeof(float))};
    result r = {.is_measured = job->measured_sets > 0};
    int code = v.rgb != NULL ? CLI_DONE : fail("out of memory");
    if (code == CLI_DONE) code = cli_open_scene(&job->render, &v.context, &v.scene);
    if (code == CLI_DONE &&
        (cli_choose_camera(&job->render, v.scene, &v.camera) != CLSHEAR_OK ||
         cli_find_shear(&job->render, v.scene, &v.camera, job->pixel, &v.shear_px) != CLSHEAR_OK))
        code = fail(clshear_message(v.context));
    if (code == CLI_DONE) {
        cli_tell_choices(&job->render, v.scene, &v.camera);
        if (job->shear_px.given) v.shear_px = job->shear_px.value;
        code = predict(&v, &r);
    }
    if (code == CLI_DONE && r.is_measured) code = measure(&v, &r);
    if (code == CLI_DONE) code = cli_write_file(job->out, write_table, &r);
    cli_close_scene(&job->render, v.context, v.scene);
    free(v.rgb);
    return code;
}

int cli_predict_pixel(int argc, char **argv)
{
    cli_flag flags[CLI_MOST_FLAGS];
    const cli_command command = cli_scene_command("predict", own_flags, OWN_FLAGS, flags);
    const pixel_job defaults = {.render = cli_job_defaults(),
                                .count = 1024,
                                .sets = 500,
                                .resolution = 255,
                                .block = 8,
                                .out = "-"};
    pixel_job job;
    const int code = cli_parse_scene(&command, &defaults, sizeof job, argc, argv, &job);
    if (code != CLI_DONE) return code;
    if (job.render.help) {
        cli_print_help(&help);
        return CLI_DONE;
    }
    if (job.render.scene == NULL) {
        fail("--pixel is of a SCENE; see clshear predict --help");
        return CLI_USAGE;
    }
    if (cli_check_pixel(&job.render, "pixel", job.pixel) != CLI_DONE) return CLI_USAGE;
    return cli_check_place("out", job.out) == CLI_DONE ? run(&job) : CLI_FAILED;
}
