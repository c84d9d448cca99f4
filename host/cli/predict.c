#include "cli/predict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/flags.h"
#include "cli/output.h"
#include "cli/parse.h"
#include "cli/predict_pixel.h"
#include "cli/source.h"

typedef struct predict_job {
    cli_source source; /* first: the stores of points write there */
    clshear_integrand integrand;
    const char *integrand_name;
    int resolution;
    uint32_t measured_sets; /* 0: not measured */
    const char *out;
} predict_job;

static const char *store_integrand(void *target, const char *value)
{
    predict_job *job = target;
    clshear_integrand found;
    if (clshear_integrand_find(value, &found) != CLSHEAR_OK)
        return "step, box, disk, gaussian, tent or plane-wave";
    job->integrand_name = value;
    job->integrand.kind = found.kind;
    if (isnan(job->integrand.size)) job->integrand.size = found.size;
    return NULL;
}

static const char *store_angle(void *target, const char *value)
{
    predict_job *job = target;
    return cli_read_numbers(value, 1, &job->integrand.angle_deg) ? NULL : "degrees";
}

static const char *store_size(void *target, const char *value)
{
    predict_job *job = target;
    return cli_read_numbers(value, 1, &job->integrand.size) ? NULL : "a number";
}

static const char *store_resolution(void *target, const char *value)
{
    predict_job *job = target;
    return cli_read_ints(value, 1, 3, 1023, &job->resolution) ? NULL : "a whole number, 3 to 1023";
}

static const char *store_measure(void *target, const char *value)
{
    predict_job *job = target;
    return cli_read_count(value, 2, &job->measured_sets) ? NULL : "a whole number from 2";
}

static const char *store_out(void *target, const char *value)
{
    predict_job *job = target;
    job->out = value;
    return *value != '\0' ? NULL : "a file, or - for standard output";
}

/* Pixels are another parser's (cli_predict): this one only lists the flag. */
static const char *store_pixel(void *target, const char *value)
{
    (void)target;
    (void)value;
    return "given once, with a SCENE";
}

static const cli_flag flags[] = {
    {"integrand", "NAME", "step, box, disk, gaussian, tent or plane-wave", store_integrand},
    {"angle", "DEG", "its direction (0)", store_angle},
    {"size", "S", "its size, or offset of a step", store_size},
    {"pixel", "X,Y", "of SCENE, in four dimensions: has its own --help", store_pixel},
    {"measure", "M", "measure too, with M other sets", store_measure},
    CLI_SOURCE_FLAGS("1000"),
    {"projection dims", "LETTERS", "two coordinates out of xyuvpq (xy)",
     cli_store_source_projection},
    {"resolution", "R", "frequencies along a side, up to 1023 (255)", store_resolution},
    {"out o", "FILE", "table, - is standard output (-)", store_out},
    {"device", "NAME", "OpenCL device: number or part of its name", cli_store_source_device},
    {"help h", NULL, "print this and stop", cli_store_source_help},
};

static const cli_command command = {
    .name = "predict",
    .summary = "usage: clshear predict --integrand NAME [flags]\n"
               "       clshear predict SCENE --pixel X,Y [flags]\n"
               "Predict the variance of an integral from the spectra of samples and integrand.\n\n"
               "  clshear predict --integrand step --angle 30 --sampler mj --n 64 --measure 4000\n"
               "  clshear predict scenes/cornell.obj --pixel 302,130 --sampler mj --measure 1000\n",
    .notes = "The variance is that of sets shifted at random around the torus, for which the\n"
             "sum over frequencies is exact. Cones are eighths of a half turn from the x axis;\n"
             "the tail is what lies beyond the spectrum, at the level of random points.\n"
             "clshear predict SCENE --pixel X,Y --help tells of pixels.\n",
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
};

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

cli_measurement cli_measurement_of(const double *values, size_t count)
{
    const double n = (double)count;
    double mean = 0.0, second = 0.0, fourth = 0.0;
    for (size_t i = 0; i < count; i++)
        mean += values[i] / n;
    for (size_t i = 0; i < count; i++) {
        const double square = (values[i] - mean) * (values[i] - mean);
        second += square / (n - 1.0);
        fourth += square * square / n;
    }
    return (cli_measurement){second, sqrt(fmax(fourth - second * second, 0.0) / n)};
}

static int measure(const predict_job *job, cli_measurement *result)
{
    cli_source source = job->source;
    clshear_points points = {0};
    double *means = calloc(job->measured_sets, sizeof *means);
    int code = CLI_FAILED;
    source.sets = job->measured_sets;
    source.seed = job->source.seed + 1;
    if (means == NULL) {
        fail("out of memory");
    } else if (cli_source_make(&source, job->source.projection, &points) != CLSHEAR_OK) {
        fail(clshear_message(NULL));
    } else {
        clshear_points_integrate(&points, &job->integrand, 1, source.seed, means);
        *result = cli_measurement_of(means, points.sets);
        code = CLI_DONE;
    }
    clshear_points_free(&points);
    free(means);
    return code;
}

typedef struct result {
    clshear_prediction prediction;
    cli_measurement measured;
    int is_measured;
} result;

static void write_table(FILE *stream, const void *user)
{
    const result *r = user;
    const clshear_prediction *p = &r->prediction;
    fprintf(stream, "part,variance\n");
    for (int k = 0; k < CLSHEAR_CONES; k++)
        fprintf(stream, "cone %g-%g deg,%.5g\n", 180.0 * k / CLSHEAR_CONES,
                180.0 * (k + 1) / CLSHEAR_CONES, p->cones[k]);
    fprintf(stream, "tail,%.5g\npredicted,%.5g\npredicted as isotropic,%.5g\n", p->tail,
            p->variance, p->isotropic);
    if (r->is_measured)
        fprintf(stream, "measured,%.5g\nmeasured 95%% low,%.5g\nmeasured 95%% high,%.5g\n",
                r->measured.variance, r->measured.variance - 1.96 * r->measured.error,
                r->measured.variance + 1.96 * r->measured.error);
}

/* Spectrum, integrand, sum. */
static int predict(const predict_job *job, clshear_prediction *prediction)
{
    const size_t side = 16 * ((size_t)job->resolution / 2 + 1),
                 resolution = (size_t)job->resolution;
    clshear_context *context = NULL;
    clshear_points points = {0};
    clshear_spectrum spectrum = {0};
    float *cells = calloc(side * side, sizeof *cells);
    double mean_square = 0.0;
    int code = CLI_FAILED;
    if (cells == NULL) {
        fail("out of memory");
    } else if (cli_source_make(&job->source, job->source.projection, &points) != CLSHEAR_OK ||
               clshear_context_create(&job->source.context, &context) != CLSHEAR_OK) {
        fail(clshear_message(NULL));
    } else if (clshear_spectrum_measure(context, &points, resolution, resolution, &spectrum) !=
               CLSHEAR_OK) {
        fail(clshear_message(context));
    } else {
        clshear_status status =
            clshear_integrand_tabulate(&job->integrand, side, cells, &mean_square);
        if (status == CLSHEAR_OK)
            status = clshear_predict_variance(&spectrum, cells, side, mean_square, prediction);
        code = status == CLSHEAR_OK ? CLI_DONE : fail(clshear_message(NULL));
    }
    free(cells);
    clshear_spectrum_free(&spectrum);
    clshear_points_free(&points);
    clshear_context_free(context);
    return code;
}

/* Whether a word is the flag that makes this a prediction for a pixel of a scene. */
static int is_pixel(const char *word)
{
    if (word[0] != '-') return 0;
    word += word[1] == '-' ? 2 : 1;
    return strcmp(word, "pixel") == 0 || strncmp(word, "pixel=", 6) == 0;
}

int cli_predict(int argc, char **argv)
{
    predict_job job = {.source = {.count = 1024, .sets = 1000, .shear = CLSHEAR_SHEAR_EQUAL_AREA},
                       .integrand = {.size = NAN},
                       .resolution = 255,
                       .out = "-"};
    result found = {0};
    for (int i = 1; i < argc; i++)
        if (is_pixel(argv[i])) return cli_predict_pixel(argc, argv);
    int code = cli_parse_words(&command, &job, argc, argv, NULL);
    if (code != CLI_DONE) return code;
    if (job.source.help) {
        cli_print_help(&command);
        return CLI_DONE;
    }
    code = cli_source_check(&job.source);
    if (code != CLI_DONE) return code;
    if (job.integrand_name == NULL || (job.source.in != NULL && job.measured_sets > 0)) {
        fprintf(stderr, "clshear: %s\n",
                job.integrand_name == NULL ? "give an --integrand; see clshear predict --help"
                                           : "--measure needs a sampler to draw other sets from");
        return CLI_USAGE;
    }
    if (job.integrand.kind != CLSHEAR_INTEGRAND_STEP && !(job.integrand.size > 0.0)) {
        fprintf(stderr, "clshear: --size %g: must be above 0\n", job.integrand.size);
        return CLI_USAGE;
    }
    if (job.source.projection == NULL && job.source.in == NULL) job.source.projection = "xy";
    code = cli_check_place("out", job.out);
    if (code == CLI_DONE) code = predict(&job, &found.prediction);
    found.is_measured = job.measured_sets > 0;
    if (code == CLI_DONE && found.is_measured) code = measure(&job, &found.measured);
    return code == CLI_DONE ? cli_write_file(job.out, write_table, &found) : code;
}
