/* The library in one page: a scene file in, a picture and a number out. */
#include <clshear/clshear.h>
#include <stdio.h>

static int show_progress(void *user, const clshear_progress *state)
{
    (void)user;
    printf("%3d %%\r", (int)(100.0 * state->fraction));
    return 0; /* anything else stops the render */
}

/* Renders a scene file with a small image and writes it; prints how noisy it is. */
static clshear_status render(const char *path, const char *target, clshear_context *context,
                             clshear_settings *settings)
{
    clshear_scene *scene = NULL;
    clshear_film *film = NULL;
    clshear_settings_set_progress(settings, show_progress, NULL);
    clshear_status status = clshear_settings_set_integer(settings, CLSHEAR_WIDTH, 128);
    if (status == CLSHEAR_OK) status = clshear_settings_set_integer(settings, CLSHEAR_HEIGHT, 128);
    if (status == CLSHEAR_OK) status = clshear_settings_set_integer(settings, CLSHEAR_SPP, 64);
    if (status == CLSHEAR_OK) status = clshear_scene_load(context, path, settings, &scene);
    if (status == CLSHEAR_OK) status = clshear_render(scene, settings, &film);
    if (status == CLSHEAR_OK) status = clshear_film_write(film, target);
    if (status == CLSHEAR_OK)
        printf("mean variance of a pixel: %.3g\n", clshear_film_mean_variance(film));
    clshear_film_free(film);
    clshear_scene_free(scene);
    return status;
}

int main(int argc, char **argv)
{
    clshear_settings *settings = NULL;
    clshear_context *context = NULL;
    if (argc != 3) {
        fprintf(stderr, "usage: %s SCENE OUT.exr\n", argv[0]);
        return 2;
    }
    clshear_status status = clshear_settings_create(&settings);
    if (status == CLSHEAR_OK) status = clshear_context_create(settings, &context);
    if (status == CLSHEAR_OK) status = render(argv[1], argv[2], context, settings);
    if (status != CLSHEAR_OK) fprintf(stderr, "%s\n", clshear_message());
    clshear_context_free(context);
    clshear_settings_free(settings);
    return status == CLSHEAR_OK ? 0 : 1;
}
