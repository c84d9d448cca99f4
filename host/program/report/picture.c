#include "report/picture.h"

#include <math.h>
#include <stdio.h>

/* Pixels and what is known of them. */
typedef struct part {
    size_t pixels;
    size_t lit;     /* pixels above 0 */
    size_t clipped; /* pixels whose three channels are above white */
    double log_sum; /* of the binary logarithms of the lit pixels' largest channels */
} part;

/* What the remarks are made from. */
typedef struct survey {
    part all;
    part scene;     /* pixels that see it */
    size_t visible; /* pixels that are not nearly black */
    float blur_px;  /* the widest circle of confusion */
} survey;

/* What files of 8 and 16 bits show as white, by the settings of the exposure; infinite if they
 * adapt to the picture. */
static float white_of(const clshear_settings *settings)
{
    double exposure = 0.0;
    int64_t is_auto = 0;
    clshear_settings_get_number(settings, CLSHEAR_EXPOSURE, &exposure);
    clshear_settings_get_integer(settings, CLSHEAR_AUTO_EXPOSURE, &is_auto);
    return is_auto ? INFINITY : (float)exp2(-exposure);
}

/* Of white: the sRGB curve makes a twentieth of it. */
#define FAINT 0.004f

static void count(part *part, const float colour[3], float white)
{
    const float most = fmaxf(colour[0], fmaxf(colour[1], colour[2]));
    part->pixels++;
    part->lit += most > 0.0f;
    part->clipped += colour[0] > white && colour[1] > white && colour[2] > white;
    if (most > 0.0f) part->log_sum += log2((double)most);
}

static survey look_at(const clshear_film *film, size_t pixels, float white)
{
    const float *red = clshear_film_channel(film, "R"), *green = clshear_film_channel(film, "G");
    const float *blue = clshear_film_channel(film, "B"), *depth = clshear_film_channel(film, "Z");
    const float *blur = clshear_film_channel(film, "CoC");
    survey found = {0};
    if (red == NULL || green == NULL || blue == NULL || depth == NULL || blur == NULL) return found;
    for (size_t i = 0; i < pixels; i++) {
        const float colour[3] = {red[i], green[i], blue[i]};
        count(&found.all, colour, white);
        if (isfinite(depth[i])) count(&found.scene, colour, white);
        found.visible += fmaxf(colour[0], fmaxf(colour[1], colour[2])) > FAINT * white;
        if (isfinite(depth[i])) found.blur_px = fmaxf(found.blur_px, blur[i]);
    }
    return found;
}

/* The exposure, in whole stops, that makes the log-average middle grey. */
static int fitting_exposure(const part *part)
{
    return (int)floor(log2(0.18) - part->log_sum / (double)part->lit);
}

/* Says where the camera sees nothing of the scene, or next to nothing: it is too far away, or looks
 * elsewhere. Returns whether it has said so of a picture that is all black. A crop may have been
 * meant to show what is around the scene. */
static int remark_on_view(const survey *found, const clshear_film_info *info)
{
    static const char help[] = "--orbit 0,0 frames it from its front, --eye and --target aim the "
                               "camera, --fov narrows its view";
    const int is_whole = info->width == info->full_width && info->height == info->full_height;
    const int is_dark = 2 * found->all.lit < found->all.pixels;
    if (found->scene.pixels == 0 && found->all.lit == 0)
        fprintf(stderr, "clshear: the picture is black: the camera does not see the scene; %s\n",
                help);
    else if (is_whole && found->scene.pixels == 0 && !is_dark)
        fprintf(stderr, "clshear: the camera does not see the scene, only what is around it; %s\n",
                help);
    else if (is_whole && 1000 * found->scene.pixels < found->all.pixels)
        fprintf(stderr, "clshear: the scene fills less than a thousandth of the picture%s; %s\n",
                is_dark ? ", the rest is black" : "", help);
    return found->scene.pixels == 0 && found->all.lit == 0;
}

/* Says where most of the picture is white, or of the scene before a dark background. Returns
 * whether it has. */
static int remark_on_white(const survey *found)
{
    const int is_all = 2 * found->all.clipped > found->all.pixels;
    const part *bright = is_all ? &found->all : &found->scene;
    if (2 * bright->clipped <= bright->pixels) return 0;
    fprintf(stderr,
            "clshear: %.0f %% of the %s is brighter than white in all but .exr; --exposure %d "
            "or --auto-exposure darkens it, weaker light (an environment by "
            "--environment-strength) the .exr too\n",
            100.0 * (double)bright->clipped / (double)bright->pixels, is_all ? "picture" : "scene",
            fitting_exposure(bright));
    return 1;
}

/* Says where hardly a pixel is visible. A small bright one, such as a lamp, needs no brightening.
 */
static void remark_on_dark(const survey *found, float white)
{
    const part *all = &found->all;
    if (all->lit == 0 || 1000 * found->scene.pixels < all->pixels) return;
    if (1000 * found->visible >= all->pixels || isinf(white)) return;
    const int exposure = fitting_exposure(all);
    if ((double)exposure > -log2((double)white))
        fprintf(stderr,
                "clshear: the picture is nearly black in all but .exr; --exposure %d or "
                "--auto-exposure brightens it, stronger light the .exr too\n",
                exposure);
}

void remark_on_picture(const clshear_film *film, const clshear_settings *settings, int has_lens)
{
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    const float white = white_of(settings);
    const survey found = look_at(film, (size_t)info.width * (size_t)info.height, white);
    if (found.all.pixels == 0) return;
    if (!remark_on_view(&found, &info) && found.all.lit == 0)
        fprintf(stderr, "clshear: the picture is black: no light reaches what it shows; "
                        "--environment 1,1,1 adds light from all around\n");
    if (!remark_on_white(&found)) remark_on_dark(&found, white);
    if (has_lens && found.scene.pixels > 0 && found.blur_px < 1.0f)
        fprintf(stderr,
                "clshear: everything is in focus, blurred by %.2g px at most; a larger "
                "--lens-radius blurs more (with --fstop: check --unit)\n",
                (double)found.blur_px);
}

/* ", noise 1.2 % (1 % promised)" where that was promised. */
static void print_promise(const clshear_settings *settings, clshear_setting setting,
                          const char *name, double reached)
{
    double promised = 0.0;
    if (!clshear_settings_is_set(settings, setting) ||
        clshear_settings_get_number(settings, setting, &promised) != CLSHEAR_OK)
        return;
    fprintf(stderr, "; %s %.3g %%, %.3g %% promised", name, 100.0 * reached, 100.0 * promised);
}

void remark_on_end(const clshear_film *film, const clshear_settings *settings)
{
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    if (info.stopped_by == NULL) return;
    const double pixels = (double)info.width * (double)info.height;
    fprintf(stderr, "clshear: ended by --%s at %.0f samples per pixel", info.stopped_by,
            (double)info.samples / pixels);
    print_promise(settings, CLSHEAR_NOISE, "noise", info.noise);
    print_promise(settings, CLSHEAR_NOISE_PIXEL, "noise of pixels", info.noise_pixel);
    if (info.spp_expected > 0.0)
        fprintf(stderr, "; that would take about %.2g samples per pixel", info.spp_expected);
    fputc('\n', stderr);
}
