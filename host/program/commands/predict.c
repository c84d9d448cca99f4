/* clshear predict: the variance that spectra let expect, of an integrand of the unit square. */
#include "commands/predict.h"

#include <stdio.h>
#include <stdlib.h>

#include "commands/commands.h"
#include "report/failure.h"
#include "report/output.h"

#define AT(member) offsetof(predict_job, member)
#define INTEGRAND_NAME(identifier, number, name, extent, meaning) name " "
static const program_flag flags[] = {
    TEXT_FLAG("integrand", "NAME", "step, box, disk, gaussian, tent or plane-wave", "",
              AT(integrand), CLSHEAR_INTEGRAND_LIST(INTEGRAND_NAME)),
    NUMBER_FLAG("angle", "DEG", "direction of the integrand", "0", AT(angle), 1, 1, -1e6, 1e6),
    NUMBER_FLAG("size", "S", "its size, or offset of a step", "", AT(size), 1, 1, -1e6, 1e6),
    WHOLE_FLAG("pixel", "X,Y", "of SCENE, in four dimensions, moving: five", "", AT(pixel), 2, 1, 0,
               65535),
    WHOLE_FLAG("measure", "M", "measure too, with M other sets", "", AT(measure), 1, 1, 2,
               MOST_POINTS),
    POINT_SOURCE_FLAGS("independent sets (1000; of a pixel: 500)"),
    TEXT_FLAG("projection dims", "LETTERS", "two coordinates out of xyuvpqt (xy)", "",
              offsetof(point_source, letters), ""),
    WHOLE_FLAG("resolution", "R", "frequencies along a side", "255", AT(resolution), 1, 1, 3, 4095),
    WHOLE_FLAG("block", "B", "of a pixel: reach of the block (8; moving: 4)", "", AT(block), 1, 1,
               1, 15),
    TEXT_FLAG("out o", "FILE", "table, - is standard output", "-", AT(out), ""),
    FILES_FLAG("map", "of all pixels of SCENE: .csv .exr .png .tif; repeatable", "", AT(map),
               ".csv .exr .png .jpg .tif"),
    TEXT_FLAG("plot", "FILE", "measured over predicted, .png or .svg, by gnuplot", "", AT(plot),
              ".png .svg"),
    SWITCH_FLAG("keep", "leave the plot's data and script beside it", AT(keep)),
};

static int run(void *job);

const program_command predict_command = {
    .name = "predict",
    .usage = "clshear predict --integrand NAME [flags]\n"
             "       clshear predict SCENE --pixel X,Y [flags]\n"
             "       clshear predict SCENE --map FILE --measure M [flags]\n"
             "Predict the variance of an integral from the spectra of samples and integrand.\n\n"
             "  clshear predict --integrand step --angle 30 --sampler mj --n 64 --measure 4000\n"
             "  clshear predict scenes/cornell.obj --pixel 302,130 --sampler mj --measure 1000\n",
    .notes = "The variance is that of sets shifted at random around the torus, for which the\n"
             "sum over frequencies is exact. Parts of an integrand are cones of an eighth of a\n"
             "half turn, named by where they begin, and the tail: what lies beyond the\n"
             "spectrum, at the level of random points.\n\n"
             "Parts of a pixel are frequencies of one coordinate, of two, of three or more\n"
             "(the block), and the tail. The shear, of the oracle or --shear-px, is part of\n"
             "its integrand: x, y, u, v, and t where the scene moves, are what the sampler\n"
             "draws. Values are means of R, G and B; an area light is one point.\n"
             "--measure has the variance of sets that are shifted, and of sets as they are.\n\n"
             "--map and --plot take all pixels of a small image, with fewer samples of each:\n"
             "predicted beside measured variance. Give few --sets and a low --resolution.\n",
    COMMAND_FLAGS(flags),
    .takes_scene = 1,
    .job_size = sizeof(predict_job),
    .run = run,
};

enum {
    CONE_LEVELS = 9 /* up to 256 cones */
};

typedef struct result {
    clshear_prediction *prediction;
    measurement measured;
    int is_measured;
} result;

static void write_table(FILE *stream, const void *user)
{
    const result *r = user;
    const clshear_prediction *p = r->prediction;
    fprintf(stream, "part,variance\n");
    for (size_t k = 0; k < clshear_prediction_parts(p); k++)
        fprintf(stream, "%s,%.5g\n", clshear_prediction_part_name(p, k),
                clshear_prediction_part_variance(p, k));
    fprintf(stream, "predicted,%.5g\npredicted as isotropic,%.5g\n", clshear_prediction_variance(p),
            clshear_prediction_isotropic(p));
    for (size_t level = 1; level < CONE_LEVELS; level++)
        fprintf(stream, "predicted in %d cones,%.5g\n", 1 << level,
                clshear_prediction_in_cones(p, level));
    if (r->is_measured)
        fprintf(stream, "measured,%.5g\nmeasured 95%% low,%.5g\nmeasured 95%% high,%.5g\n",
                r->measured.variance, r->measured.variance - 1.96 * r->measured.error,
                r->measured.variance + 1.96 * r->measured.error);
}

static int measure(const predict_job *job, const clshear_integrand *integrand, measurement *result)
{
    const size_t sets = (size_t)job->measure.items[0];
    const uint32_t seed = seed_of(&job->source.options) + 1;
    clshear_points *points = NULL;
    double *means = calloc(sets, sizeof *means);
    if (means == NULL) return complain(EXIT_FAILED, "out of memory");
    clshear_status status = point_source_make(&job->source, sets, seed, "xy", &points);
    if (status == CLSHEAR_OK) {
        clshear_points_integrate(points, integrand, 1, seed, means);
        status = clshear_variance_of(means, clshear_points_sets(points), &result->variance,
                                     &result->error);
    }
    clshear_points_free(points);
    free(means);
    return exit_status_of(status);
}

/* Spectrum, integrand, sum. */
static int predict(const predict_job *job, const clshear_integrand *integrand,
                   clshear_prediction **prediction)
{
    const size_t resolution = (size_t)job->resolution.items[0], side = 16 * (resolution / 2 + 1);
    const size_t sets = (size_t)number_or(&job->source.sets, 1000.0);
    clshear_context *context = NULL;
    clshear_points *points = NULL;
    clshear_spectrum *spectrum = NULL;
    double mean_square = 0.0;
    float *cells = calloc(side * side, sizeof *cells);
    if (cells == NULL) return complain(EXIT_FAILED, "out of memory");
    clshear_status status =
        point_source_make(&job->source, sets, seed_of(&job->source.options), "xy", &points);
    if (status == CLSHEAR_OK)
        status = clshear_context_create(job->source.options.settings, &context);
    if (status == CLSHEAR_OK)
        status = clshear_spectrum_measure(context, points, resolution, resolution, &spectrum);
    if (status == CLSHEAR_OK)
        status = clshear_integrand_tabulate(integrand, side, cells, &mean_square);
    if (status == CLSHEAR_OK)
        status = clshear_predict_variance(spectrum, cells, side, mean_square, prediction);
    free(cells);
    clshear_spectrum_free(spectrum);
    clshear_points_free(points);
    clshear_context_free(context);
    return exit_status_of(status);
}

static int check(const predict_job *job, clshear_integrand *integrand)
{
    if (job->integrand.count == 0)
        return complain(EXIT_USAGE, "give an --integrand, or a SCENE and a --pixel; see "
                                    "clshear predict --help");
    if (job->source.options.scene != NULL)
        return complain(EXIT_USAGE, "an --integrand needs no SCENE: %s", job->source.options.scene);
    if (job->source.in.count > 0 && job->measure.count > 0)
        return complain(EXIT_USAGE, "--measure needs a sampler to draw other sets from");
    if (job->resolution.items[0] > 1023.0)
        return complain(EXIT_USAGE, "--resolution %g: must be a whole number, 3 to 1023",
                        job->resolution.items[0]);
    const clshear_status status = clshear_integrand_find(job->integrand.items[0], integrand);
    if (status != CLSHEAR_OK) return exit_status_of(status);
    integrand->angle_deg = job->angle.items[0];
    integrand->extent = number_or(&job->size, integrand->extent);
    if (integrand->kind != CLSHEAR_INTEGRAND_STEP && !(integrand->extent > 0.0))
        return complain(EXIT_USAGE, "--size %g: must be above 0", integrand->extent);
    output_files outputs = {0};
    outputs_add(&outputs, "out", job->out.items, 1);
    const int code = point_source_check(&job->source, "projection", 2);
    return code == EXIT_DONE ? point_source_check_outputs(&job->source, &outputs) : code;
}

static int run(void *user)
{
    predict_job *job = user;
    clshear_integrand integrand = {.struct_size = sizeof integrand};
    result r = {.is_measured = job->measure.count > 0};
    if (job->map.count > 0 || job->plot.count > 0) return predict_image(job);
    if (job->pixel.count > 0) return predict_pixel(job);
    int code = check(job, &integrand);
    if (code == EXIT_DONE) code = predict(job, &integrand, &r.prediction);
    if (code == EXIT_DONE && r.is_measured) code = measure(job, &integrand, &r.measured);
    if (code == EXIT_DONE) code = write_file(job->out.items[0], write_table, &r);
    clshear_prediction_free(r.prediction);
    return code;
}
