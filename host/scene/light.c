/* Lights that are added to a scene or given by settings. */
#include <math.h>
#include <string.h>

#include "base/pi.h"
#include "base/vec.h"
#include "scene/scene.h"

int cs_is_colour(const float *colour)
{
    int good = 1;
    for (int c = 0; c < 3; c++)
        good &= colour[c] >= 0.0f && colour[c] <= 1e15f;
    return good;
}

static const float degree = 0.0174532925f;

static int is_directed(const clshear_light *light)
{
    return light->kind == CLSHEAR_LIGHT_DIRECTIONAL || light->kind == CLSHEAR_LIGHT_SPOT;
}

static double area_of(const clshear_light *light)
{
    double e1[3], e2[3], normal[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = (double)light->edge1[i];
        e2[i] = (double)light->edge2[i];
    }
    cs_vec_cross_double(e1, e2, normal);
    return sqrt(cs_vec_dot_double(normal, normal));
}

/* The same for what only shapes have. */
static clshear_status check_shape(const clshear_light *light, const char *name, cs_error *error)
{
    const double area = area_of(light);
    if (light->kind == CLSHEAR_LIGHT_SPHERE && !(light->radius > 1e-15f && light->radius < 1e15f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: radius %g: must be above 0, up to 1e15",
                       name, (double)light->radius);
    if (light->kind == CLSHEAR_LIGHT_QUAD && !(area > 1e-30 && area < 1e30))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s: the two edges of a quad span an area of %g: must be above 0", name,
                       area);
    return CLSHEAR_OK;
}

/* Whether what the kind reads can be used. */
static clshear_status check_light(const clshear_light *light, const char *name, cs_error *error)
{
    const int has_place = light->kind != CLSHEAR_LIGHT_DIRECTIONAL;
    const int has_direction = is_directed(light);
    const float *place = light->position, *direction = light->direction;
    if (light->kind < CLSHEAR_LIGHT_POINT || light->kind > CLSHEAR_LIGHT_QUAD)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: kind %d is not known", name,
                       (int)light->kind);
    for (int i = 0; i < 3; i++)
        if ((has_place && !isfinite(place[i])) || (has_direction && !isfinite(direction[i])))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: its position must be finite", name);
    if (!cs_is_colour(light->colour))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: colour %g,%g,%g: must be 0 to 1e15", name,
                       (double)light->colour[0], (double)light->colour[1],
                       (double)light->colour[2]);
    if (has_direction && !(cs_vec_dot(direction, direction) > 0.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: its direction has no length", name);
    if (!has_place && !(light->diameter_deg >= 0.0f && light->diameter_deg <= 180.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: diameter %g: must be 0 to 180 degrees",
                       name, (double)light->diameter_deg);
    if (light->kind == CLSHEAR_LIGHT_SPOT &&
        !(light->inner_deg >= 0.0f && light->outer_deg > light->inner_deg &&
          light->outer_deg <= 90.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s: cone %g to %g: must be 0 <= inner < outer <= 90 degrees", name,
                       (double)light->inner_deg, (double)light->outer_deg);
    return check_shape(light, name, error);
}

/* Scale and offset as cs_sample_light_spot takes them, from cos b - cos a = 2 sin((a + b) / 2)
 * sin((a - b) / 2), which keeps its digits where the cone is narrow or its edge sharp. A scale
 * above 1e30 is a step. */
static void make_spot(const clshear_light *light, cs_light *made)
{
    const double outer = (double)light->outer_deg * (double)degree;
    const double inner = (double)light->inner_deg * (double)degree;
    const double half = sin(0.5 * outer);
    const double across = sin(0.5 * (outer + inner)) * sin(0.5 * (outer - inner));
    const double scale = fmin(0.25 / fmax(across, 1e-300), 1e30);
    made->kind = CS_LIGHT_SPOT;
    made->parameters[0] = (float)scale;
    made->parameters[1] = (float)(4.0 * half * half * scale);
    for (int i = 0; i < 3; i++)
        made->axis[i] = -made->axis[i];
}

/* A cone of half angle a, of even radiance L, lights a surface that faces it with pi L sin^2 a. */
static void make_sun(const clshear_light *light, cs_light *made)
{
    const double half = 0.5 * (double)light->diameter_deg * (double)degree;
    const double sine = sin(half), half_sine = sin(0.5 * half);
    made->kind = CS_LIGHT_SUN;
    made->parameters[0] = (float)(2.0 * half_sine * half_sine); /* 1 - cos a */
    for (int c = 0; c < 3; c++)
        made->colour[c] = (float)((double)made->colour[c] / (CS_PI_DOUBLE * sine * sine));
}

static void make_quad(const clshear_light *light, cs_light *made)
{
    made->kind = CS_LIGHT_QUAD;
    made->parameters[3] = (float)area_of(light);
    for (int i = 0; i < 3; i++) {
        made->axis[i] = light->edge1[i];
        made->parameters[i] = light->edge2[i];
    }
}

clshear_status cs_light_make(const clshear_light *light, const char *name, cs_light *made,
                             cs_error *error)
{
    clshear_status status = check_light(light, name, error);
    if (status != CLSHEAR_OK) return status;
    const int has_direction = is_directed(light);
    const float length = sqrtf(cs_vec_dot(light->direction, light->direction));
    memset(made, 0, sizeof *made);
    made->kind = has_direction ? CS_LIGHT_DIRECTIONAL : CS_LIGHT_POINT;
    for (int i = 0; i < 3; i++) {
        if (has_direction) made->axis[i] = light->direction[i] / length;
        if (light->kind != CLSHEAR_LIGHT_DIRECTIONAL) made->position[i] = light->position[i];
        made->colour[i] = light->colour[i];
    }
    if (light->kind == CLSHEAR_LIGHT_SPOT) make_spot(light, made);
    if (light->kind == CLSHEAR_LIGHT_QUAD) make_quad(light, made);
    if (light->kind == CLSHEAR_LIGHT_SPHERE) {
        made->kind = CS_LIGHT_SPHERE;
        made->parameters[0] = light->radius;
    }
    /* Smaller ones are as sharp, and their radiance leaves no room for a colour in a float. */
    if (light->kind == CLSHEAR_LIGHT_DIRECTIONAL && light->diameter_deg > 1e-3f)
        make_sun(light, made);
    return CLSHEAR_OK;
}

clshear_status cs_scene_add_light(cs_scene *scene, const clshear_light *light, cs_error *error)
{
    cs_light made;
    clshear_status status = cs_light_make(light, "light", &made, error);
    if (status != CLSHEAR_OK) return status;
    cs_light *added = cs_array_extend(&scene->lights, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *added = made;
    return CLSHEAR_OK;
}
