/* clshear converge: variance against the number of samples. */
#include <clshear/analysis.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "commands/commands.h"
#include "commands/outputs.h"
#include "commands/point_source.h"
#include "commands/scene_view.h"
#include "report/failure.h"
#include "report/map_files.h"
#include "report/output.h"
#include "report/series.h"
#include "report/words.h"

typedef struct converge_job {
    program_options options;
    text_list integrand; /* none: a scene */
    number_list angle;
    number_list size;
    number_list pixels; /* none: the whole image */
    number_list counts;
    number_list replicates;
    text_list samplers;
    text_list shears;
    text_list reference; /* a number or an image */
    text_list out;
    text_list plot;
    text_list map;
    int keep;
    int local_slopes;
    double reference_value; /* of a number */
    clshear_integrand measured;
} converge_job;

#define AT(member) offsetof(converge_job, member)
#define INTEGRAND_NAME(identifier, number, name, extent, meaning) name " "
#define NAMES_FLAG(names, help, fallback, target)                                       \
    {                                                                                   \
        names, "A,B,...", help, fallback, FLAG_TEXT, target, 0, 1, MOST_TEXTS, 0, 0, "" \
    }
static const program_flag flags[] = {
    TEXT_FLAG("integrand", "NAME", "step, box, disk, gaussian, tent or plane-wave", "",
              AT(integrand), CLSHEAR_INTEGRAND_LIST(INTEGRAND_NAME)),
    NUMBER_FLAG("angle", "DEG", "direction of the integrand", "0", AT(angle), 1, 1, -1e6, 1e6),
    NUMBER_FLAG("size", "S", "its size, or offset of a step", "", AT(size), 1, 1, -1e6, 1e6),
    WHOLE_FLAG("pixels", "X,Y;X,Y", "pixels of SCENE (the whole image)", "", AT(pixels), 2, 16, 0,
               65535),
    WHOLE_FLAG("nsamps n", "N,N,...", "samples in a pattern", "16,64,256,1024", AT(counts), 1,
               MOST_NUMBERS, 1, MOST_POINTS),
    WHOLE_FLAG("nreps replicates", "R", "independent patterns of each (200; image 8)", "",
               AT(replicates), 1, 1, 2, MOST_POINTS),
    NAMES_FLAG("sampler", "see clshear --list-samplers", "mj,sz", AT(samplers)),
    NAMES_FLAG("shear", "equal-area, toroidal, none", "none,equal-area", AT(shears)),
    TEXT_FLAG("reference", "VALUE", "number or .exr: errors are squared differences", "",
              AT(reference), ""),
    FILES_FLAG("out o", ".csv or .json, - is standard output; repeatable", "", AT(out),
               "- .csv .json"),
    TEXT_FLAG("plot", "FILE", "draw errors over N, .png or .svg, by gnuplot", "", AT(plot),
              ".png .svg"),
    FILES_FLAG("map", ".exr .csv .png .tif: slope and gain of each pixel; repeatable", "", AT(map),
               ".exr .csv .png .jpg .tif"),
    SWITCH_FLAG("local-slopes", "slopes between neighbouring N, each with its interval",
                AT(local_slopes)),
    SWITCH_FLAG("keep", "leave the plot's data and script beside it", AT(keep)),
};

static int run(void *job);

const program_command converge_command = {
    .name = "converge",
    .usage = "clshear converge [SCENE] [flags]\n"
             "Measure how variance falls with the number of samples, and fit its slope.\n\n"
             "  clshear converge --integrand disk --sampler random,mj --plot disk.png\n"
             "  clshear converge scenes/cornell.obj --pixels '302,130;146,330' --sampler mj\n",
    .notes = "A pixel's value is the mean of R, G and B. Without --pixels, errors are means\n"
             "over the image: of variances, or of squared differences from a --reference, a\n"
             "finer render; --map shows where. Slopes are least squares in logarithms, with\n"
             "95 % intervals by bootstrap over the replicates, or the image's tiles. --oracle\n"
             "pilot counts as centre.\n",
    COMMAND_FLAGS(flags),
    .takes_scene = 1,
    .job_size = sizeof(converge_job),
    .run = run,
};

/* What a study is made of, in the library's types. */
typedef struct converge_plan {
    uint32_t counts[MOST_NUMBERS];
    size_t sizes;
    uint32_t replicates;
    const double *reference;
} converge_plan;

static converge_plan plan_of(const converge_job *job)
{
    const int is_image = job->integrand.count == 0 && job->pixels.count == 0;
    converge_plan plan = {.sizes = job->counts.count,
                          .replicates =
                              (uint32_t)number_or(&job->replicates, is_image ? 8.0 : 200.0),
                          .reference = job->reference.count > 0 ? &job->reference_value : NULL};
    for (size_t k = 0; k < plan.sizes; k++)
        plan.counts[k] = (uint32_t)job->counts.items[k];
    return plan;
}

static void tell_counts(const converge_job *job, const converge_plan *plan,
                        const error_series *series)
{
    for (size_t k = 0; k < plan->sizes && !job->options.quiet; k++) {
        const uint32_t count = clshear_convergence_count(series->result, k);
        if (count != plan->counts[k])
            fprintf(stderr, "clshear: sampler %s has no sets of %u points: %u\n", series->sampler,
                    plan->counts[k], count);
    }
}

/* One series for each sampler. */
static int study_integrand(const converge_job *job, error_study *study)
{
    const converge_plan plan = plan_of(job);
    for (size_t s = 0; s < job->samplers.count; s++) {
        error_series *series = &study->series[s];
        snprintf(series->target, sizeof series->target, "%s", job->integrand.items[0]);
        series->sampler = job->samplers.items[s];
        series->shear = "none";
        const clshear_status status = clshear_converge_integrand(
            &job->measured, series->sampler, seed_of(&job->options), plan.counts, plan.sizes,
            plan.replicates, plan.reference, &series->result);
        if (status != CLSHEAR_OK) return exit_status_of(status);
        study->count++;
        tell_counts(job, &plan, series);
    }
    return EXIT_DONE;
}

/* One curve of a scene: of a pixel, or of the image where `pixel` is NULL. */
static clshear_status measure(const converge_job *job, clshear_scene *scene, const double *pixel,
                              const clshear_film *reference, error_series *series)
{
    clshear_settings *settings = job->options.settings;
    const converge_plan plan = plan_of(job);
    clshear_status status = clshear_settings_set_text(settings, CLSHEAR_SAMPLER, series->sampler);
    if (status == CLSHEAR_OK)
        status = clshear_settings_set_text(settings, CLSHEAR_SHEAR, series->shear);
    if (status != CLSHEAR_OK) return status;
    if (pixel == NULL)
        return clshear_converge_image(scene, settings, plan.counts, plan.sizes, plan.replicates,
                                      reference, &series->result);
    return clshear_converge_pixel(scene, settings, (int)pixel[0], (int)pixel[1], plan.counts,
                                  plan.sizes, plan.replicates, plan.reference, &series->result);
}

/* All curves of a scene. */
static int study_targets(const converge_job *job, clshear_scene *scene,
                         const clshear_film *reference, error_study *study)
{
    const size_t targets = job->pixels.count > 0 ? job->pixels.count / 2 : 1;
    const size_t pairs = job->samplers.count * job->shears.count;
    for (size_t i = 0; i < targets * pairs; i++) {
        error_series *series = &study->series[i];
        const double *pixel = job->pixels.count > 0 ? job->pixels.items + 2 * (i / pairs) : NULL;
        snprintf(series->target, sizeof series->target, "image");
        if (pixel != NULL)
            snprintf(series->target, sizeof series->target, "pixel %g:%g", pixel[0], pixel[1]);
        series->sampler = job->samplers.items[i % pairs / job->shears.count];
        series->shear = job->shears.items[i % job->shears.count];
        const clshear_status status = measure(job, scene, pixel, reference, series);
        if (status != CLSHEAR_OK) return exit_status_of(status);
        study->count++;
    }
    return EXIT_DONE;
}

static int study_scene(converge_job *job, error_study *study)
{
    scene_view view = {0};
    clshear_film *reference = NULL;
    const int is_film = job->pixels.count == 0 && job->reference.count > 0;
    int code = scene_view_open(&job->options, &view);
    if (code == EXIT_DONE && is_film)
        code = exit_status_of(clshear_film_read(job->reference.items[0], &reference));
    if (code == EXIT_DONE) code = study_targets(job, view.scene, reference, study);
    clshear_film_free(reference);
    scene_view_close(&view);
    return code;
}

/* The reference is a number for pixels and integrands, and a picture for images. */
static int check_reference(converge_job *job)
{
    if (job->reference.count == 0) return EXIT_DONE;
    const char *text = job->reference.items[0];
    const int is_image = job->integrand.count == 0 && job->pixels.count == 0;
    char *end;
    job->reference_value = strtod(text, &end);
    const int is_number = end != text && *end == '\0' && isfinite(job->reference_value);
    if (!is_number && !has_ending(".exr", text))
        return complain(EXIT_USAGE, "--reference %s: must be a number, or an .exr of clshear",
                        text);
    if (is_image != is_number) return EXIT_DONE;
    return complain(EXIT_USAGE, "--reference: a picture is of a whole image, a number of --pixels "
                                "or an --integrand");
}

/* Whether samplers and shears are known, and the numbers of samples rise. */
static int check_lists(converge_job *job)
{
    clshear_settings *settings = job->options.settings;
    const size_t targets = job->pixels.count > 0 ? job->pixels.count / 2 : 1;
    const size_t shears = job->integrand.count > 0 ? 1 : job->shears.count;
    int is_rising = job->counts.count >= 2;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < job->samplers.count && status == CLSHEAR_OK; i++)
        status = clshear_settings_set_text(settings, CLSHEAR_SAMPLER, job->samplers.items[i]);
    for (size_t i = 0; i < job->shears.count && status == CLSHEAR_OK; i++)
        status = clshear_settings_set_text(settings, CLSHEAR_SHEAR, job->shears.items[i]);
    if (status != CLSHEAR_OK) return complain(EXIT_USAGE, "--%s", clshear_message());
    for (size_t i = 1; i < job->counts.count; i++)
        is_rising &= job->counts.items[i] > job->counts.items[i - 1];
    if (!is_rising)
        return complain(EXIT_USAGE, "--nsamps: must be 2 to 32 rising whole numbers, with commas");
    if (targets * job->samplers.count * shears > MOST_SERIES)
        return complain(EXIT_USAGE, "more than %d curves; give fewer pixels, samplers or shears",
                        MOST_SERIES);
    return EXIT_DONE;
}

static int check_integrand(converge_job *job)
{
    const char *name = job->integrand.count > 0 ? job->integrand.items[0] : NULL;
    if ((name == NULL) == (job->options.scene == NULL))
        return complain(EXIT_USAGE, "give either an --integrand or a SCENE");
    if (name == NULL) return EXIT_DONE;
    if (job->pixels.count > 0)
        return complain(EXIT_USAGE, "--pixels are of a SCENE, not of an --integrand");
    if (clshear_settings_is_set(job->options.settings, CLSHEAR_FRESH_SETS))
        return complain(EXIT_USAGE, "--fresh-sets is of a SCENE, not of an --integrand");
    job->measured.struct_size = sizeof job->measured;
    const clshear_status status = clshear_integrand_find(name, &job->measured);
    if (status != CLSHEAR_OK) return exit_status_of(status);
    job->measured.angle_deg = job->angle.items[0];
    job->measured.extent = number_or(&job->size, job->measured.extent);
    if (job->measured.kind == CLSHEAR_INTEGRAND_STEP || job->measured.extent > 0.0)
        return EXIT_DONE;
    return complain(EXIT_USAGE, "--size %g: must be above 0", job->measured.extent);
}

static int check(converge_job *job)
{
    output_files outputs = {0};
    int code = check_integrand(job);
    if (code == EXIT_DONE) code = check_reference(job);
    if (code == EXIT_DONE) code = check_lists(job);
    for (size_t i = 0; i < job->pixels.count && code == EXIT_DONE; i += 2)
        code = check_pixel(&job->options, "pixels", job->pixels.items + i);
    if (code == EXIT_DONE && job->map.count > 0 &&
        (job->integrand.count > 0 || job->pixels.count > 0))
        code = complain(EXIT_USAGE, "--map is of a whole image: leave out --%s",
                        job->pixels.count > 0 ? "pixels" : "integrand");
    if (job->out.count == 0 && job->plot.count == 0 && job->map.count == 0)
        job->out.items[job->out.count++] = "-";
    outputs_add(&outputs, "out", job->out.items, job->out.count);
    outputs_add(&outputs, "plot", job->plot.items, job->plot.count);
    outputs_add(&outputs, "map", job->map.items, job->map.count);
    if (code == EXIT_DONE) code = check_outputs(&job->options, &outputs);
    return code == EXIT_DONE
               ? outputs_spare(&outputs, "--reference", job->reference.items, job->reference.count)
               : code;
}

static int write_study(const converge_job *job, const error_study *study)
{
    const plot_files plot = {job->plot.count > 0 ? job->plot.items[0] : NULL, job->keep};
    int code = EXIT_DONE;
    for (size_t i = 0; i < job->out.count && code == EXIT_DONE; i++) {
        const char *path = job->out.items[i];
        code =
            write_file(path, has_ending(".json", path) ? study_write_json : study_write_csv, study);
    }
    for (size_t i = 0; i < job->map.count && code == EXIT_DONE; i++)
        code = map_write(study, job->map.items[i]);
    return code == EXIT_DONE ? study_draw(study, &plot) : code;
}

static int run(void *user)
{
    converge_job *job = user;
    int code = check(job);
    if (code != EXIT_DONE) return code;
    error_study *study = calloc(1, sizeof *study);
    if (study == NULL) return complain(EXIT_FAILED, "out of memory");
    study->replicates = plan_of(job).replicates;
    study->has_local_slopes = job->local_slopes;
    study->has_reference = job->reference.count > 0;
    code = job->integrand.count > 0 ? study_integrand(job, study) : study_scene(job, study);
    if (code == EXIT_DONE) code = write_study(job, study);
    study_free(study);
    free(study);
    return code;
}
