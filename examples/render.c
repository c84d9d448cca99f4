/* The library in one page: a scene file in, a picture and a number out. */
#include <clshear/clshear.h>
#include <stdio.h>

static int show_progress(void *user, const clshear_progress *progress)
{
    (void)user;
    printf("%3d %%\r", (int)(100.0 * progress->fraction));
    return 0; /* anything else stops the render */
}

static int fail(const clshear_context *context)
{
    fprintf(stderr, "%s\n", clshear_message(context));
    return 1;
}

int main(int argc, char **argv)
{
    clshear_context *context = NULL;
    clshear_scene *scene = NULL;
    clshear_film *film = NULL;
    clshear_camera camera;
    if (argc != 3) return fprintf(stderr, "usage: %s SCENE OUT.exr\n", argv[0]), 2;
    if (clshear_context_create(NULL, &context) != CLSHEAR_OK) return fail(NULL);
    if (clshear_scene_load(context, argv[1], &scene) != CLSHEAR_OK) return fail(context);

    clshear_options options = clshear_options_defaults();
    options.width = options.height = 128;
    options.spp = 64;
    options.progress = show_progress;
    if (clshear_scene_camera(scene, options.width, options.height, &camera) != CLSHEAR_OK ||
        clshear_camera_complete(scene, options.width, options.height, &camera) != CLSHEAR_OK ||
        clshear_render(scene, &camera, &options, &film) != CLSHEAR_OK)
        return fail(context);

    const float *variance = clshear_film_channel(film, "Variance.G");
    double sum = 0.0;
    for (int i = 0; i < options.width * options.height; i++)
        sum += (double)variance[i];
    printf("mean variance of a pixel: %.3g\n", sum / (options.width * options.height));

    if (clshear_film_write(film, argv[2]) != CLSHEAR_OK) return fail(context);
    clshear_film_free(film);
    clshear_scene_free(scene);
    clshear_context_free(context);
    return 0;
}
