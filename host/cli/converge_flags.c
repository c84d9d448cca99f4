/* The flags of `clshear converge`. */
#include <stdlib.h>
#include <string.h>

#include "cli/converge.h"
#include "cli/scene.h"

/* Cuts a list at its separators. The words lie in one copy, words[0], which is the caller's;
 * free(). Returns how many, or 0 if there are more than `most` or empty ones. */
static int split(const char *text, char separator, char **words, int most)
{
    int count = 0;
    char *rest = strdup(text);
    words[0] = rest;
    while (rest != NULL) {
        char *end = strchr(rest, separator);
        if (end != NULL) *end++ = '\0';
        if (*rest == '\0' || count == most) return 0;
        words[count++] = rest;
        rest = end;
    }
    return count;
}

static const char *store_integrand(void *target, const char *value)
{
    cli_converge_job *job = target;
    const clshear_integrand before = job->integrand;
    job->integrand_name = value;
    if (clshear_integrand_find(value, &job->integrand) != CLSHEAR_OK)
        return "step, box, disk, gaussian, tent or plane-wave";
    job->integrand.angle_deg = before.angle_deg;
    return NULL;
}

static const char *store_angle(void *target, const char *value)
{
    cli_converge_job *job = target;
    return cli_read_numbers(value, 1, &job->integrand.angle_deg) ? NULL : "degrees";
}

static const char *store_size(void *target, const char *value)
{
    cli_converge_job *job = target;
    job->size_given = 1;
    return cli_read_numbers(value, 1, &job->size) ? NULL : "a number";
}

static const char *store_pixels(void *target, const char *value)
{
    cli_converge_job *job = target;
    char *words[CLI_MOST_PIXELS] = {0};
    const int count = split(value, ';', words, CLI_MOST_PIXELS);
    job->pixel_count = 0;
    for (int i = 0; i < count; i++)
        if (cli_read_ints(words[i], 2, 0, 65535, job->pixels[i])) job->pixel_count++;
    free(words[0]);
    return count > 0 && job->pixel_count == count ? NULL : "x,y;x,y;... of up to 16 pixels";
}

static const char *store_samplers(void *target, const char *value)
{
    cli_converge_job *job = target;
    job->sampler_count = split(value, ',', job->samplers, CLI_MOST_NAMES);
    for (int i = 0; i < job->sampler_count; i++)
        if (cli_check_sampler(job->samplers[i]) != NULL) return "names from --list-samplers";
    return job->sampler_count > 0 ? NULL : "up to 16 names from --list-samplers, with commas";
}

static const char *store_shears(void *target, const char *value)
{
    cli_converge_job *job = target;
    job->shear_count = split(value, ',', job->shear_names, 3);
    for (int i = 0; i < job->shear_count; i++)
        if (cli_read_shear(job->shear_names[i], &job->shears[i]) != NULL) job->shear_count = 0;
    return job->shear_count > 0 ? NULL : "some of equal-area, toroidal, none, with commas";
}

static const char *store_counts(void *target, const char *value)
{
    cli_converge_job *job = target;
    char *words[CLI_MOST_SIZES] = {0};
    job->size_count = split(value, ',', words, CLI_MOST_SIZES);
    for (int i = 0; i < job->size_count; i++)
        if (!cli_read_count(words[i], 1, &job->counts[i]) ||
            (i > 0 && job->counts[i] <= job->counts[i - 1]))
            job->size_count = 0;
    free(words[0]);
    return job->size_count >= 2 ? NULL : "2 to 32 rising whole numbers, with commas";
}

static const char *store_replicates(void *target, const char *value)
{
    cli_converge_job *job = target;
    return cli_read_count(value, 2, &job->replicates) ? NULL : "a whole number from 2";
}

static const char *store_reference(void *target, const char *value)
{
    cli_converge_job *job = target;
    const char *dot = strrchr(value, '.');
    job->has_reference = 1;
    if (dot != NULL && strcmp(dot, ".exr") == 0) {
        job->reference_image = value;
        return NULL;
    }
    return cli_read_numbers(value, 1, &job->reference) ? NULL : "a number, or an .exr of clshear";
}

static const char *store_out(void *target, const char *value)
{
    cli_converge_job *job = target;
    const char *dot = strrchr(value, '.');
    if (job->output_count == CLI_MAX_OUTPUTS) return "given at most 16 times";
    job->outputs[job->output_count++] = value;
    return strcmp(value, "-") == 0 ||
                   (dot != NULL && (strcmp(dot, ".csv") == 0 || strcmp(dot, ".json") == 0))
               ? NULL
               : "-, or a name that ends in .csv or .json";
}

static const char *store_plot(void *target, const char *value)
{
    cli_converge_job *job = target;
    return cli_read_plot_path(value, &job->plot.path);
}

static const char *store_keep(void *target, const char *value)
{
    cli_converge_job *job = target;
    (void)value;
    job->plot.keep = 1;
    return NULL;
}

static const cli_flag own_flags[] = {
    {"integrand", "NAME", "step, box, disk, gaussian, tent or plane-wave", store_integrand},
    {"angle", "DEG", "direction of the integrand (0)", store_angle},
    {"size", "S", "its size, or offset of a step", store_size},
    {"pixels", "X,Y;X,Y", "pixels of SCENE (the whole image)", store_pixels},
    {"nsamps n", "N,N,...", "samples in a pattern (16,64,256,1024)", store_counts},
    {"nreps replicates", "R", "independent patterns of each (200; image 8)", store_replicates},
    {"sampler", "A,B,...", "see clshear --list-samplers (mj,sz)", store_samplers},
    {"shear", "A,B,...", "equal-area, toroidal, none (none,equal-area)", store_shears},
    {"reference", "VALUE", "number or .exr: errors are squared differences", store_reference},
    {"out o", "FILE", ".csv or .json, - is standard output; repeatable (-)", store_out},
    {"plot", "FILE", "draw errors over N, .png or .svg, by gnuplot", store_plot},
    {"keep", NULL, "leave the plot's data and script beside it", store_keep},
};
enum {
    OWN_FLAGS = sizeof own_flags / sizeof *own_flags
};

cli_command cli_converge_command(cli_flag *flags)
{
    return cli_scene_command("converge", own_flags, OWN_FLAGS, flags);
}

const cli_command cli_converge_help = {
    .name = "converge",
    .summary = "usage: clshear converge [SCENE] [flags]\n"
               "Measure how variance falls with the number of samples, and fit its slope.\n\n"
               "  clshear converge --integrand disk --sampler random,mj --plot disk.png\n"
               "  clshear converge scenes/cornell.obj --pixels '302,130;146,330' --sampler mj\n",
    .notes = "With SCENE, flags of rendering say camera, lens, light. A pixel's value is the\n"
             "mean of R, G and B; without --pixels, errors are variances averaged over the\n"
             "image, or squared differences from a --reference, a finer render. Slopes are\n"
             "least squares in logarithms, with 95 % intervals by bootstrap over the\n"
             "replicates, or the image's tiles. --oracle pilot counts as centre.\n",
    .flags = own_flags,
    .flag_count = OWN_FLAGS,
};
