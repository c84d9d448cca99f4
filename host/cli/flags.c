#include "cli/flags.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Reads `count` numbers separated by commas; 0 if there are more, fewer or other things. */
static int read_numbers(const char *text, int count, double *values)
{
    for (int i = 0; i < count; i++) {
        char *end;
        values[i] = strtod(text, &end);
        if (end == text || !isfinite(values[i])) return 0;
        if (*end != (i + 1 < count ? ',' : '\0')) return 0;
        text = end + 1;
    }
    return 1;
}

static int read_floats(const char *text, int count, float *values)
{
    double numbers[8];
    if (!read_numbers(text, count, numbers)) return 0;
    for (int i = 0; i < count; i++)
        values[i] = (float)numbers[i];
    return 1;
}

static int read_ints(const char *text, int count, double low, double high, int *values)
{
    double numbers[8];
    if (!read_numbers(text, count, numbers)) return 0;
    for (int i = 0; i < count; i++) {
        if (numbers[i] < low || numbers[i] > high || numbers[i] != floor(numbers[i])) return 0;
        values[i] = (int)numbers[i];
    }
    return 1;
}

static int read_count(const char *text, double low, uint32_t *value)
{
    double number;
    if (!isdigit((unsigned char)*text) || !read_numbers(text, 1, &number)) return 0;
    if (number < low || number > 4294967295.0 || number != floor(number)) return 0;
    *value = (uint32_t)number;
    return 1;
}

static const char *vector(cli_vector *target, const char *value)
{
    target->given = 1;
    return read_floats(value, 3, target->value) ? NULL : "three numbers, x,y,z";
}

static const char *positive(cli_number *target, const char *value)
{
    target->given = 1;
    return read_floats(value, 1, &target->value) && target->value > 0.0f ? NULL
                                                                         : "a number above 0";
}

static const char *store_out(cli_job *job, const char *value)
{
    if (job->output_count == CLI_MAX_OUTPUTS) return "given at most 16 times";
    job->outputs[job->output_count++] = value;
    return NULL;
}

static const char *store_spp(cli_job *job, const char *value)
{
    return read_count(value, 1, &job->options.spp) ? NULL : "a whole number from 1";
}

static const char *store_replicates(cli_job *job, const char *value)
{
    return read_count(value, 1, &job->options.replicates) ? NULL : "a whole number from 1";
}

static const char *store_seed(cli_job *job, const char *value)
{
    return read_count(value, 0, &job->options.seed) ? NULL : "a whole number from 0 to 4294967295";
}

static const char *store_shear(cli_job *job, const char *value)
{
    if (strcmp(value, "equal-area") == 0)
        job->options.shear = CLSHEAR_SHEAR_EQUAL_AREA;
    else if (strcmp(value, "toroidal") == 0)
        job->options.shear = CLSHEAR_SHEAR_TOROIDAL;
    else if (strcmp(value, "none") == 0)
        job->options.shear = CLSHEAR_SHEAR_NONE;
    else
        return "equal-area, toroidal or none";
    return NULL;
}

static const char *store_sampler(cli_job *job, const char *value)
{
    clshear_sampler_info info;
    job->options.sampler = value;
    for (size_t i = 0; clshear_sampler_describe(i, &info); i++)
        if (strcmp(value, info.name) == 0) return NULL;
    return "a name from --list-samplers";
}

static const char *store_width(cli_job *job, const char *value)
{
    return read_ints(value, 1, 1, 65536, &job->options.width) ? NULL : "a whole number, 1 to 65536";
}

static const char *store_height(cli_job *job, const char *value)
{
    return read_ints(value, 1, 1, 65536, &job->options.height) ? NULL
                                                               : "a whole number, 1 to 65536";
}

static const char *store_crop(cli_job *job, const char *value)
{
    int *crop = job->options.crop;
    return read_ints(value, 4, 0, 65536, crop) && crop[0] < crop[1] && crop[2] < crop[3]
               ? NULL
               : "x0,x1,y0,y1 in pixels, x0 < x1 and y0 < y1";
}

static const char *store_eye(cli_job *job, const char *value)
{
    return vector(&job->eye, value);
}

static const char *store_target(cli_job *job, const char *value)
{
    return vector(&job->target, value);
}

static const char *store_up(cli_job *job, const char *value)
{
    return vector(&job->up, value);
}

static const char *store_fov(cli_job *job, const char *value)
{
    const char *wanted = positive(&job->fov, value);
    return wanted == NULL && job->fov.value < 180.0f ? NULL : "degrees above 0 and below 180";
}

static const char *store_lens_radius(cli_job *job, const char *value)
{
    job->lens_radius.given = 1;
    job->f_stop.given = 0; /* the last word on a thing counts */
    return read_floats(value, 1, &job->lens_radius.value) && job->lens_radius.value >= 0.0f
               ? NULL
               : "a number, 0 or more";
}

static const char *store_focal_distance(cli_job *job, const char *value)
{
    job->focus_pixel_given = 0;
    return positive(&job->focal_distance, value);
}

static const char *store_f_stop(cli_job *job, const char *value)
{
    job->lens_radius.given = 0;
    return positive(&job->f_stop, value);
}

static const char *store_unit(cli_job *job, const char *value)
{
    return positive(&job->unit_m, value);
}

static const char *store_focus_pixel(cli_job *job, const char *value)
{
    job->focus_pixel_given = 1;
    job->focal_distance.given = 0;
    return read_ints(value, 2, 0, 65535, job->focus_pixel) ? NULL : "x,y in pixels";
}

static const char *store_aperture(cli_job *job, const char *value)
{
    if (strcmp(value, "disk") == 0)
        job->aperture = CLSHEAR_APERTURE_DISK;
    else if (strcmp(value, "square") == 0)
        job->aperture = CLSHEAR_APERTURE_SQUARE;
    else
        return "square or disk";
    return NULL;
}

static const char *store_light(cli_job *job, const char *value)
{
    float numbers[6];
    if (!read_floats(value, 6, numbers)) return "six numbers, x,y,z,r,g,b";
    if (job->light_count == CLI_MAX_LIGHTS) return "given at most 64 times";
    clshear_light *light = &job->lights[job->light_count++];
    light->kind = CLSHEAR_LIGHT_POINT;
    memcpy(light->vector, numbers, sizeof light->vector);
    memcpy(light->colour, numbers + 3, sizeof light->colour);
    return NULL;
}

static const char *store_settings(cli_job *job, const char *value)
{
    job->settings = value;
    return NULL;
}

static const char *store_device(cli_job *job, const char *value)
{
    job->context.device = value;
    return NULL;
}

static const char *store_threads(cli_job *job, const char *value)
{
    return read_ints(value, 1, 0, 4096, &job->context.threads) ? NULL : "a whole number, 0 for all";
}

static const char *store_packet(cli_job *job, const char *value)
{
    int good = read_ints(value, 1, 1, 16, &job->context.packet);
    int width = job->context.packet;
    return good && (width == 1 || width == 4 || width == 8 || width == 16) ? NULL : "1, 4, 8 or 16";
}

static const char *store_quiet(cli_job *job, const char *value)
{
    (void)value;
    job->quiet = 1;
    return NULL;
}

static const char *store_stats(cli_job *job, const char *value)
{
    (void)value;
    job->stats = 1;
    return NULL;
}

static const char *store_help(cli_job *job, const char *value)
{
    (void)value;
    job->help = 1;
    return NULL;
}

static const char *store_version(cli_job *job, const char *value)
{
    (void)value;
    job->version = 1;
    return NULL;
}

static const char *store_list_samplers(cli_job *job, const char *value)
{
    (void)value;
    job->list_samplers = 1;
    return NULL;
}

static const char *store_list_devices(cli_job *job, const char *value)
{
    (void)value;
    job->list_devices = 1;
    return NULL;
}

const cli_flag cli_flags[] = {
    {"out o output outfile", "FILE", "write .exr, .png, .jpg or .tif; repeatable", store_out},
    {"spp samples", "N", "samples per pixel (256)", store_spp},
    {"replicates", "R", "independent patterns of spp/R samples (2)", store_replicates},
    {"seed", "N", "another seed, another noise (0)", store_seed},
    {"sampler", "NAME", "point set; --list-samplers has them (sz)", store_sampler},
    {"list-samplers", NULL, "list the samplers and stop", store_list_samplers},
    {"shear", "KIND", "equal-area, toroidal or none (equal-area)", store_shear},
    {"width", "PX", "image width (512)", store_width},
    {"height", "PX", "image height (512)", store_height},
    {"crop", "X0,X1,Y0,Y1", "render these pixels only", store_crop},
    {"eye", "X,Y,Z", "camera position", store_eye},
    {"target", "X,Y,Z", "what the camera looks at", store_target},
    {"up", "X,Y,Z", "which way is up", store_up},
    {"fov", "DEG", "field of view along the shorter image axis", store_fov},
    {"lens-radius aperture-radius", "R", "lens radius in scene units; 0: pinhole",
     store_lens_radius},
    {"focal-distance focus-distance", "D", "depth of the plane in focus", store_focal_distance},
    {"fstop", "N", "lens radius as f-number of a full-frame camera", store_f_stop},
    {"unit", "METRES", "length of a scene unit, for --fstop (1)", store_unit},
    {"focus-pixel", "X,Y", "focus on what this pixel sees", store_focus_pixel},
    {"aperture", "SHAPE", "square or disk (disk)", store_aperture},
    {"light", "X,Y,Z,R,G,B", "add a point light; repeatable", store_light},
    {"settings", "FILE", "read flags from FILE (SCENE.flags if it exists)", store_settings},
    {"device", "NAME", "OpenCL device: number or part of its name", store_device},
    {"list-devices", NULL, "list the OpenCL devices and stop", store_list_devices},
    {"threads t nthreads", "N", "CPU threads; 0: all (0)", store_threads},
    {"packet", "W", "samples traced together: 1, 4, 8 or 16", store_packet},
    {"quiet q", NULL, "no progress and no remarks, only errors", store_quiet},
    {"stats", NULL, "print sizes, times and rays per second", store_stats},
    {"help h", NULL, "print this and stop", store_help},
    {"version", NULL, "print the version and stop", store_version},
};

const size_t cli_flag_count = sizeof cli_flags / sizeof *cli_flags;

const cli_flag *cli_find_flag(const char *name, size_t length)
{
    for (size_t i = 0; i < cli_flag_count; i++) {
        const char *known = cli_flags[i].names;
        while (*known != '\0') {
            size_t size = strcspn(known, " ");
            if (size == length && strncmp(known, name, size) == 0) return &cli_flags[i];
            known += size;
            known += strspn(known, " ");
        }
    }
    return NULL;
}

cli_job cli_job_defaults(void)
{
    cli_job job = {.context = clshear_context_defaults(), .options = clshear_options_defaults()};
    job.unit_m.value = 1.0f;
    return job;
}

void cli_print_help(FILE *stream)
{
    fputs("usage: clshear SCENE [flags]\n"
          "Render SCENE (OBJ, glTF, PLY, STL) with depth of field.\n\n"
          "  clshear scenes/cornell.obj --spp 1024 --out img.exr\n\n",
          stream);
    for (size_t i = 0; i < cli_flag_count; i++) {
        char left[40];
        const cli_flag *flag = &cli_flags[i];
        snprintf(left, sizeof left, "--%.*s %s", (int)strcspn(flag->names, " "), flag->names,
                 flag->argument != NULL ? flag->argument : "");
        fprintf(stream, "  %-24s %s\n", left, flag->help);
    }
    fputs("\nWithout --out, writes the scene's name with .exr in the current folder.\n"
          "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted (what was\n"
          "rendered so far is written).\n",
          stream);
}
