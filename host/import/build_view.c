/* Lights and cameras of a model. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "clshear/device/constants.h"
#include "import/build_parts.h"

static const float right_angle_deg = 90.0f;

/* Files may give a cone without a soft edge, which is the narrowest one here. */
static void make_cone(const cs_model_light *source, clshear_light *light)
{
    light->kind = CLSHEAR_LIGHT_SPOT;
    light->outer_deg = fminf(source->cone[1] / (CS_PI / 180.0f), right_angle_deg);
    light->inner_deg =
        fminf(source->cone[0] / (CS_PI / 180.0f), nextafterf(light->outer_deg, 0.0f));
    for (int i = 0; i < 3; i++)
        light->direction[i] = (float)source->axis[i];
}

/* What makes a light that fades in its own way, or not at all, as bright at the middle of the
 * scene, the mean of its bounds, as one that fades with the squared distance. */
static float fading(const cs_model_light *source, const double bounds[2][3])
{
    const double *fading = source->fading;
    double square = 0.0;
    if (!(fading[0] + fading[1] + fading[2] > 0.0)) return 1.0f;
    if (!(fading[0] + fading[1] > 0.0)) return (float)(1.0 / fading[2]);
    for (int i = 0; i < 3; i++) {
        const double step = source->position[i] - 0.5 * (bounds[0][i] + bounds[1][i]);
        square += step * step;
    }
    const double divisor = fading[0] + fading[1] * sqrt(square) + fading[2] * square;
    return divisor > 0.0 ? (float)(square / divisor) : 0.0f;
}

static clshear_status build_light(const cs_model *model, const cs_model_light *source,
                                  const double bounds[2][3], cs_scene *scene, cs_error *error)
{
    clshear_light light = {.struct_size = sizeof light, .kind = CLSHEAR_LIGHT_POINT};
    if (source->kind == CS_MODEL_DIRECTIONAL) light.kind = CLSHEAR_LIGHT_DIRECTIONAL;
    if (source->range > 0.0f && source->range < FLT_MAX) /* which some write for none */
        cs_warn(model->log, "%s: the range of light \"%s\" is not used: it shines on", model->path,
                source->name);
    for (int i = 0; i < 3; i++) {
        light.position[i] = (float)(source->position[i] - scene->origin[i]);
        light.direction[i] = (float)-source->axis[i];
        light.colour[i] = source->colour[i] * fading(source, bounds);
    }
    if (source->kind == CS_MODEL_SPOT) make_cone(source, &light);
    if (!cs_is_colour(light.colour)) {
        cs_warn(model->log,
                "%s: light \"%s\" has the colour %g %g %g, which must be 0 to 1e15; left out",
                model->path, source->name, (double)light.colour[0], (double)light.colour[1],
                (double)light.colour[2]);
        return CLSHEAR_OK;
    }
    cs_error reason;
    clshear_status status = cs_scene_add_light(scene, &light, &reason);
    if (status == CLSHEAR_OUT_OF_MEMORY) return cs_model_full(model, error);
    if (status != CLSHEAR_OK)
        cs_warn(model->log, "%s: light \"%s\" is left out: %s", model->path, source->name,
                reason.message);
    return CLSHEAR_OK;
}

clshear_status cs_build_lights(const cs_model *model, const double bounds[2][3], cs_scene *scene,
                               cs_error *error)
{
    const cs_model_light *lights = model->lights.items;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < model->lights.count && status == CLSHEAR_OK; i++)
        status = build_light(model, &lights[i], bounds, scene, error);
    return status;
}

/* 0 if the camera looks nowhere, or its numbers are no numbers. */
static int make_view(const cs_model_camera *source, const cs_scene *scene, cs_view *view)
{
    int good =
        source->height > 0.0 ? source->height <= 1e12 : source->fov > 1e-5 && source->fov < 3.14;
    double length = 0.0;
    for (int i = 0; i < 3; i++)
        length += source->forward[i] * source->forward[i];
    good &= length > 0.0 && isfinite(length);
    length = good ? sqrt(length) : 1.0;
    double reach = 1.0; /* so that eye and target differ as floats */
    for (int i = 0; i < 3; i++)
        if (fabs(source->eye[i] - scene->origin[i]) > 1e3 * reach)
            reach = fabs(source->eye[i] - scene->origin[i]);
    for (int i = 0; i < 3; i++) {
        const double eye = source->eye[i] - scene->origin[i];
        view->eye[i] = (float)eye;
        view->target[i] = (float)(eye + source->forward[i] * (reach / length));
        view->up[i] = (float)source->up[i];
        good &= fabs(eye) <= 1e12 && isfinite(source->up[i]);
    }
    view->fov_deg = (float)source->fov / (CS_PI / 180.0f);
    view->orthographic = (float)source->height;
    return good;
}

/* Names the cameras of which the first is taken. */
static void report_choice(const cs_model *model, const cs_scene *scene)
{
    char names[CS_CAMERA_LIST];
    if (scene->cameras.count < 2) return;
    cs_scene_list_cameras(scene, names);
    cs_warn(model->log, "%s: has %zu cameras, of which the first is used; --camera chooses: %s",
            model->path, scene->cameras.count, names);
}

clshear_status cs_build_cameras(const cs_model *model, cs_scene *scene, cs_error *error)
{
    const cs_model_camera *cameras = model->cameras.items;
    for (size_t i = 0; i < model->cameras.count; i++) {
        cs_scene_camera made = {0};
        snprintf(made.name, sizeof made.name, "%.*s", CS_CAMERA_NAME - 1, cameras[i].name);
        if (!make_view(&cameras[i], scene, &made.view)) {
            cs_warn(model->log, "%s: camera \"%s\" shows nothing; left out", model->path,
                    made.name);
            continue;
        }
        cs_scene_camera *added = cs_array_extend(&scene->cameras, 1);
        if (added == NULL) return cs_model_full(model, error);
        *added = made;
    }
    report_choice(model, scene);
    return CLSHEAR_OK;
}
