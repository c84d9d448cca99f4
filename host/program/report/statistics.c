#include "report/statistics.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include <clshear/analysis.h>

static const double pi = 3.14159265358979323846; /* the program sees public headers only */
static const double half_sensor_m = 0.012;       /* half the short side of a full-frame sensor */

static void report_scene(const clshear_scene *scene)
{
    clshear_scene_info world = {.struct_size = sizeof world};
    double size[3], square = 0.0;
    clshear_scene_describe(scene, &world);
    for (int axis = 0; axis < 3; axis++) {
        size[axis] = world.high[axis] - world.low[axis];
        square += size[axis] * size[axis];
    }
    printf("bounds       %.6g,%.6g,%.6g to %.6g,%.6g,%.6g\n", world.low[0], world.low[1],
           world.low[2], world.high[0], world.high[1], world.high[2]);
    printf("size         %.4g x %.4g x %.4g, diagonal %.4g\n", size[0], size[1], size[2],
           sqrt(square));
    printf("triangles    %zu (%zu without area dropped), %zu in leaves, %zu nodes\n",
           world.triangles, world.degenerate, world.references, world.nodes);
    printf("geometry     %.1f bytes per triangle on the device\n",
           (double)world.device_bytes / (double)world.triangles);
    printf("lights       %zu of the file, %zu emissive triangles\n", world.lights, world.emitters);
    printf("load         %.3f s\n", world.load_s);
    printf("build        %.3f s\n", world.build_s);
}

static double number_of(const clshear_settings *settings, clshear_setting setting)
{
    double value = 0.0;
    if (clshear_settings_is_set(settings, setting))
        clshear_settings_get_number(settings, setting, &value);
    return value;
}

/* The lens, and its f-number on a full-frame camera with a unit of a metre, or as --unit says. */
static void report_lens(const clshear_settings *settings)
{
    const double radius = number_of(settings, CLSHEAR_LENS_RADIUS);
    const double focus = number_of(settings, CLSHEAR_FOCAL_DISTANCE);
    const double width = number_of(settings, CLSHEAR_ORTHOGRAPHIC);
    const double tangent = tan(0.5 * number_of(settings, CLSHEAR_FOV) * pi / 180.0);
    double unit_m = 1.0, tilt[2] = {0.0, 0.0};
    size_t count = 0;
    clshear_settings_get_number(settings, CLSHEAR_UNIT, &unit_m);
    clshear_settings_get_numbers(settings, CLSHEAR_TILT, tilt, 2, &count);
    printf("focus        at depth %.6g", focus);
    if (tilt[0] != 0.0 || tilt[1] != 0.0)
        printf(", on a plane that faces %g,%g degrees", tilt[0], tilt[1]);
    if (radius <= 0.0)
        printf("\nlens         a pinhole\n");
    else
        printf("\nlens         radius %.4g, f/%.3g on full frame if a unit is %g m\n", radius,
               (width > 0.0 ? half_sensor_m * focus / width : 0.5 * half_sensor_m / tangent) /
                   (radius * unit_m),
               unit_m);
}

/* Widths that round lenses blur points to, of what the pixels' centres see nearest and farthest,
 * and at infinity. */
static void report_blur(const clshear_settings *settings, const clshear_film *film, size_t pixels)
{
    const float *depth = clshear_film_channel(film, "Z"), *blur = clshear_film_channel(film, "CoC");
    const double extent = (double)clshear_lens_extent(settings);
    const double tangent = tan(0.5 * number_of(settings, CLSHEAR_FOV) * pi / 180.0);
    int64_t width = 0, height = 0;
    size_t near = pixels, far = pixels;
    if (depth == NULL || blur == NULL) return;
    for (size_t i = 0; i < pixels; i++) {
        if (!isfinite(depth[i])) continue;
        if (near == pixels || depth[i] < depth[near]) near = i;
        if (far == pixels || depth[i] > depth[far]) far = i;
    }
    if (near == pixels) return;
    clshear_settings_get_integer(settings, CLSHEAR_WIDTH, &width);
    clshear_settings_get_integer(settings, CLSHEAR_HEIGHT, &height);
    printf("blur         %.3g px nearest (depth %.4g), %.3g px farthest (depth %.4g)",
           extent * (double)blur[near], (double)depth[near], extent * (double)blur[far],
           (double)depth[far]);
    if (clshear_settings_is_set(settings, CLSHEAR_FOV))
        printf(", %.3g px at infinity",
               number_of(settings, CLSHEAR_LENS_RADIUS) *
                   (double)(width < height ? width : height) /
                   (number_of(settings, CLSHEAR_FOCAL_DISTANCE) * tangent));
    printf("\n");
}

void report_statistics(const clshear_context *context, const clshear_scene *scene,
                       const clshear_settings *settings, const clshear_film *film)
{
    clshear_film_info info = {.struct_size = sizeof info};
    const double variance = clshear_film_mean_variance(film);
    clshear_film_describe(film, &info);
    const double rays = (double)info.samples + (double)info.shadow_rays;
    printf("device       %s\n", clshear_device_name(context));
    report_scene(scene);
    report_lens(settings);
    report_blur(settings, film, (size_t)info.width * (size_t)info.height);
    printf("prepass      %.3f s%s\n", info.prepass_s,
           info.prepass_s > info.kernel_s ? ", longer than the kernels; fewer --lens-rays take less"
                                          : "");
    printf("pilot        %.3f s, %.1f %% more samples\n", info.pilot_s,
           100.0 * (double)info.pilot_samples / (double)info.samples);
    printf("kernels      %.3f s\n", info.kernel_s);
    printf("render       %.3f s, prepass and kernels included\n", info.render_s);
    printf("memory       %.1f MB, and %.1f MB on the device, without the scene\n",
           1e-6 * (double)info.host_bytes, 1e-6 * (double)info.device_bytes);
    printf("samples      %.3f M, %.2f M/s\n", 1e-6 * (double)info.samples,
           1e-6 * (double)info.samples / info.kernel_s);
    printf("rays         %.3f M, %.2f M/s (camera and shadow)\n", 1e-6 * rays,
           1e-6 * rays / info.kernel_s);
    if (!isnan(variance))
        printf("variance     %.3e of the image, mean over pixels and colours\n", variance);
}
