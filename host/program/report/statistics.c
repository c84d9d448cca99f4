#include "report/statistics.h"

#include <math.h>
#include <stdio.h>

void report_statistics(const clshear_context *context, const clshear_scene *scene,
                       const clshear_film *film)
{
    clshear_scene_info world = {.struct_size = sizeof world};
    clshear_film_info info = {.struct_size = sizeof info};
    const double variance = clshear_film_mean_variance(film);
    clshear_scene_describe(scene, &world);
    clshear_film_describe(film, &info);
    const double rays = (double)info.samples + (double)info.shadow_rays;
    printf("device       %s\n", clshear_device_name(context));
    printf("triangles    %zu (%zu without area dropped), %zu in leaves, %zu nodes\n",
           world.triangles, world.degenerate, world.references, world.nodes);
    printf("geometry     %.1f bytes per triangle on the device\n",
           (double)world.device_bytes / (double)world.triangles);
    printf("lights       %zu point or directional, %zu emissive triangles\n", world.lights,
           world.emitters);
    printf("load         %.3f s\n", world.load_s);
    printf("build        %.3f s\n", world.build_s);
    printf("prepass      %.3f s\n", info.prepass_s);
    printf("pilot        %.3f s, %.1f %% more samples\n", info.pilot_s,
           100.0 * (double)info.pilot_samples / (double)info.samples);
    printf("kernels      %.3f s\n", info.kernel_s);
    printf("render       %.3f s, prepass and kernels included\n", info.render_s);
    printf("samples      %.3f M, %.2f M/s\n", 1e-6 * (double)info.samples,
           1e-6 * (double)info.samples / info.kernel_s);
    printf("rays         %.3f M, %.2f M/s (camera and shadow)\n", 1e-6 * rays,
           1e-6 * rays / info.kernel_s);
    if (!isnan(variance))
        printf("variance     %.3e of the image, mean over pixels and colours\n", variance);
}
