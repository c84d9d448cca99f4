/* The flags of rendering. */
#include "cli/render.h"

#include <string.h>

#include "cli/camera_flags.h"

static const char *store_out(void *target, const char *value)
{
    cli_job *job = target;
    if (job->output_count == CLI_MAX_OUTPUTS) return "given at most 16 times";
    job->outputs[job->output_count++] = value;
    return NULL;
}

static const char *store_spp(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_count(value, 1, &job->options.spp) ? NULL : "a whole number from 1";
}

static const char *store_replicates(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_count(value, 1, &job->options.replicates) ? NULL : "a whole number from 1";
}

static const char *store_seed(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_count(value, 0, &job->options.seed) ? NULL
                                                        : "a whole number from 0 to 4294967295";
}

static const char *store_shear(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_shear(value, &job->options.shear);
}

static const char *store_sampler(void *target, const char *value)
{
    cli_job *job = target;
    job->options.sampler = value;
    return cli_check_sampler(value);
}

static const char *store_oracle(void *target, const char *value)
{
    static const char *const names[] = {"centre", "median", "near", "far", "pilot"};
    cli_job *job = target;
    for (int i = 0; i < 5; i++)
        if (strcmp(value, names[i]) == 0) {
            job->options.oracle = (clshear_oracle)i;
            return NULL;
        }
    return "pilot, centre, median, near or far";
}

static const char *store_filter(void *target, const char *value)
{
    static const char *const names[] = {"box", "tent", "gaussian", "blackman-harris"};
    cli_job *job = target;
    for (int i = 0; i < 4; i++)
        if (strcmp(value, names[i]) == 0) {
            job->options.filter = (clshear_filter)i;
            return NULL;
        }
    return "box, tent, gaussian or blackman-harris";
}

static const char *store_filter_width(void *target, const char *value)
{
    cli_job *job = target;
    float *width = &job->options.filter_width_px;
    return cli_read_floats(value, 1, width) && *width >= 0.01f && *width <= 64.0f
               ? NULL
               : "pixels, 0.01 to 64";
}

static const char *store_adaptive(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->options.adaptive = 1;
    return NULL;
}

static const char *store_gain(void *target, const char *value)
{
    cli_job *job = target;
    job->gain = value;
    job->options.gain = 1;
    return NULL;
}

static const char *store_lens_rays(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_ints(value, 1, 0, 256, &job->options.lens_rays) ? NULL
                                                                    : "a whole number, 0 to 256";
}

static const char *store_extendable(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->options.extendable = 1;
    return NULL;
}

static const char *store_extend(void *target, const char *value)
{
    cli_job *job = target;
    job->extend = value;
    return NULL;
}

static const char *store_width(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_ints(value, 1, 1, 65536, &job->options.width) ? NULL
                                                                  : "a whole number, 1 to 65536";
}

static const char *store_height(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_ints(value, 1, 1, 65536, &job->options.height) ? NULL
                                                                   : "a whole number, 1 to 65536";
}

static const char *store_crop(void *target, const char *value)
{
    cli_job *job = target;
    int *crop = job->options.crop;
    return cli_read_ints(value, 4, 0, 65536, crop) && crop[0] < crop[1] && crop[2] < crop[3]
               ? NULL
               : "x0,x1,y0,y1 in pixels, x0 < x1 and y0 < y1";
}

static const char *store_light(void *target, const char *value)
{
    cli_job *job = target;
    float numbers[6];
    if (!cli_read_floats(value, 6, numbers)) return "six numbers, x,y,z,r,g,b";
    if (job->light_count == CLI_MAX_LIGHTS) return "given at most 64 times";
    clshear_light *light = &job->lights[job->light_count++];
    light->kind = CLSHEAR_LIGHT_POINT;
    memcpy(light->vector, numbers, sizeof light->vector);
    memcpy(light->colour, numbers + 3, sizeof light->colour);
    return NULL;
}

static const char *store_settings(void *target, const char *value)
{
    cli_job *job = target;
    job->settings = value;
    return NULL;
}

static const char *store_device(void *target, const char *value)
{
    cli_job *job = target;
    job->context.device = value;
    return NULL;
}

static const char *store_threads(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_ints(value, 1, 0, 4096, &job->context.threads) ? NULL
                                                                   : "a whole number, 0 for all";
}

static const char *store_packet(void *target, const char *value)
{
    cli_job *job = target;
    int good = cli_read_ints(value, 1, 1, 16, &job->context.packet);
    int width = job->context.packet;
    return good && (width == 1 || width == 4 || width == 8 || width == 16) ? NULL : "1, 4, 8 or 16";
}

static const char *store_quiet(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->quiet = 1;
    return NULL;
}

static const char *store_stats(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->stats = 1;
    return NULL;
}

static const char *store_help(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->help = 1;
    return NULL;
}

static const char *store_version(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->version = 1;
    return NULL;
}

static const char *store_list_samplers(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->list_samplers = 1;
    return NULL;
}

static const char *store_list_devices(void *target, const char *value)
{
    cli_job *job = target;
    (void)value;
    job->list_devices = 1;
    return NULL;
}

static const cli_flag flags[] = {
    {"out o output outfile", "FILE", "write .exr, .png, .jpg or .tif; repeatable", store_out},
    {"spp samples", "N", "samples per pixel (256)", store_spp},
    {"replicates", "R", "independent patterns of spp/R samples (2)", store_replicates},
    {"seed", "N", "another seed, another noise (0)", store_seed},
    {"sampler", "NAME", "point set; --list-samplers has them (sz)", store_sampler},
    {"list-samplers", NULL, "list the samplers and stop", store_list_samplers},
    {"shear", "KIND", "equal-area, toroidal or none (equal-area)", store_shear},
    {"oracle", "RULE", "pilot, centre, median, near or far (pilot)", store_oracle},
    {"adaptive", NULL, "more samples where they are needed; --spp is the mean", store_adaptive},
    {"gain", "FILE", "write what the shear gains, in false colours", store_gain},
    {"lens-rays", "N", "rays for the depths of a pixel (16)", store_lens_rays},
    {"extendable", NULL, "keep in the EXR what --extend needs", store_extendable},
    {"extend", "FILE", "go on from FILE up to --spp; other flags the same", store_extend},
    {"width", "PX", "image width (512)", store_width},
    {"height", "PX", "image height (512)", store_height},
    {"crop", "X0,X1,Y0,Y1", "render these pixels only", store_crop},
    {"eye", "X,Y,Z", "camera position", cli_store_eye},
    {"target", "X,Y,Z", "what the camera looks at", cli_store_target},
    {"up", "X,Y,Z", "which way is up", cli_store_up},
    {"fov", "DEG", "field of view along the shorter image axis", cli_store_fov},
    {"lens-radius aperture-radius", "R", "lens radius in scene units; 0: pinhole",
     cli_store_lens_radius},
    {"focal-distance focus-distance", "D", "depth of the plane in focus", cli_store_focal_distance},
    {"fstop", "N", "lens radius as f-number of a full-frame camera", cli_store_f_stop},
    {"unit", "METRES", "length of a scene unit, for --fstop (1)", cli_store_unit},
    {"focus-pixel", "X,Y", "focus on what this pixel sees", cli_store_focus_pixel},
    {"aperture", "SHAPE", "disk, square, polygon or an image file (disk)", cli_store_aperture},
    {"blades", "N", "a polygon with N corners (6)", cli_store_blades},
    {"blade-rotation", "DEG", "turn the polygon (0: a corner on the right)",
     cli_store_blade_rotation},
    {"anamorphic", "RATIO", "aperture narrower by this (1)", cli_store_anamorphic},
    {"filter", "KIND", "box, tent, gaussian or blackman-harris (box)", store_filter},
    {"filter-width", "PX", "all of it (box 1, tent 2, others 3)", store_filter_width},
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

const cli_command cli_render_command = {
    .summary = "usage: clshear SCENE [flags]\n"
               "       clshear points [flags]     point sets; see clshear points --help\n"
               "       clshear spectrum [flags]   their power spectra\n"
               "       clshear slice SCENE [flags] the integrand of a pixel\n"
               "       clshear predict [flags]    variance expected from spectra\n"
               "       clshear converge [flags]   variance against samples\n\n"
               "Render SCENE (OBJ, glTF, PLY, STL) with depth of field.\n\n"
               "  clshear scenes/cornell.obj --spp 1024 --out img.exr\n",
    .notes = "Without --out, writes the scene's name with .exr in the current folder.\n"
             "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted (what was\n"
             "rendered so far is written).\n",
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .most_operands = 1,
};

cli_job cli_job_defaults(void)
{
    cli_job job = {.context = clshear_context_defaults(), .options = clshear_options_defaults()};
    job.unit_m.value = 1.0f;
    job.blades = 6;
    job.anamorphic = 1.0f;
    return job;
}
