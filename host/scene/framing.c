#include "scene/framing.h"

#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "clshear/device/constants.h"

static const float degrees = CS_PI / 180.0f;
static const float default_fov_deg = 40.0f;
static const float margin = 1.08f; /* picture over what the scene fills of it */

/* A place of the room test: axes are across, up, and towards the front. */
typedef struct box_axes {
    int axis[3];
    float sign[3]; /* of the file's axis */
} box_axes;

static box_axes axes_of(int z_up)
{
    return z_up ? (box_axes){{0, 2, 1}, {1.0f, 1.0f, -1.0f}}
                : (box_axes){{0, 1, 2}, {1.0f, 1.0f, 1.0f}};
}

/* Adds the area of a triangle to the side of the bounding box in which it lies, up to 2 % of the
 * box's extent: sides[axis][0 low, 1 high]. */
static void add_to_side(const cs_scene *scene, const uint32_t *corners, float sides[3][2])
{
    const float(*positions)[3] = scene->positions.items;
    const float *a = positions[corners[0]], *b = positions[corners[1]], *c = positions[corners[2]];
    float ab[3], ac[3], normal[3];
    cs_vec_subtract(b, a, ab);
    cs_vec_subtract(c, a, ac);
    cs_vec_cross(ab, ac, normal);
    for (int axis = 0; axis < 3; axis++) {
        const float low = scene->bounds[0][axis], high = scene->bounds[1][axis];
        const float near = 0.02f * (high - low);
        const float least = fminf(a[axis], fminf(b[axis], c[axis]));
        const float most = fmaxf(a[axis], fmaxf(b[axis], c[axis]));
        if (most <= low + near) sides[axis][0] += 0.5f * fabsf(normal[axis]);
        if (least >= high - near) sides[axis][1] += 0.5f * fabsf(normal[axis]);
    }
}

/* Whether five sides of the bounding box are walls, and the front is open. */
static int is_open_room(const cs_scene *scene, const box_axes *axes)
{
    const uint32_t(*triangles)[3] = scene->indices.items;
    float sides[3][2] = {{0.0f}}, size[3];
    int walls = 0;
    for (size_t i = 0; i < scene->indices.count; i++)
        add_to_side(scene, triangles[i], sides);
    for (int axis = 0; axis < 3; axis++)
        size[axis] = scene->bounds[1][axis] - scene->bounds[0][axis];
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++)
            sides[axis][end] /= size[(axis + 1) % 3] * size[(axis + 2) % 3];
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++)
            walls += sides[axis][end] > 0.75f;
    return walls == 5 && sides[axes->axis[2]][axes->sign[2] > 0.0f] < 0.25f;
}

cs_framing cs_framing_default(const cs_scene *scene, int z_up)
{
    const box_axes axes = axes_of(z_up);
    cs_framing framing = {z_up, 35.0f, 20.0f, default_fov_deg, 0};
    float size[3];
    for (int i = 0; i < 3; i++)
        size[i] = scene->bounds[1][axes.axis[i]] - scene->bounds[0][axes.axis[i]];
    if (size[1] < 0.1f * fmaxf(size[0], size[2])) framing.elevation_deg = 40.0f;
    if (is_open_room(scene, &axes)) framing.azimuth_deg = framing.elevation_deg = 0.0f;
    return framing;
}

int cs_framing_stands_on_z(const cs_scene *scene)
{
    double low[3], size[3], most = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (double)scene->bounds[0][axis] + scene->origin[axis];
        size[axis] = (double)scene->bounds[1][axis] - (double)scene->bounds[0][axis];
        most = fmax(most, size[axis]);
    }
    return fabs(low[2]) <= 1e-4 * most && size[2] >= 0.25 * most && low[1] <= -0.01 * most;
}

/* Unit vectors of the picture in coordinates of the file: right, up, and towards the camera. */
static void picture_axes(const cs_framing *framing, float frame[3][3])
{
    const box_axes axes = axes_of(framing->z_up);
    const float sa = sinf(framing->azimuth_deg * degrees),
                ca = cosf(framing->azimuth_deg * degrees);
    const float se = sinf(framing->elevation_deg * degrees);
    const float ce = cosf(framing->elevation_deg * degrees);
    const float own[3][3] = {{ca, 0.0f, -sa}, {-se * sa, ce, -se * ca}, {ce * sa, se, ce * ca}};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            frame[k][axes.axis[i]] = axes.sign[i] * own[k][i];
}

/* The pyramid of sight touches the scene on both sides of a picture axis: with positions p along
 * that axis and t towards the camera, and the tangent of half the angle, all points have
 * |p - eye| <= tangent (distance - t). */
typedef struct touch {
    float low;  /* largest -p + tangent t */
    float high; /* largest p + tangent t */
} touch;

/* The touches along the first two axes of the frame, and the largest t, from `middle`. */
static float find_touches(const cs_scene *scene, float frame[3][3], const float *middle,
                          const float *tangent, touch *sides)
{
    const float(*positions)[3] = scene->positions.items;
    const uint32_t(*triangles)[3] = scene->indices.items;
    float nearest = -INFINITY;
    sides[0] = sides[1] = (touch){-INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * scene->indices.count; i++) {
        float from_middle[3];
        cs_vec_subtract(positions[triangles[i / 3][i % 3]], middle, from_middle);
        const float t = cs_vec_dot(from_middle, frame[2]);
        nearest = fmaxf(nearest, t);
        for (int axis = 0; axis < 2; axis++) {
            const float p = cs_vec_dot(from_middle, frame[axis]);
            sides[axis].low = fmaxf(sides[axis].low, -p + tangent[axis] * t);
            sides[axis].high = fmaxf(sides[axis].high, p + tangent[axis] * t);
        }
    }
    return nearest;
}

void cs_framing_upright(int z_up, const float *line, float *up)
{
    const box_axes axes = axes_of(z_up);
    const float rise = axes.sign[1] * line[axes.axis[1]];
    const float level = hypotf(line[axes.axis[0]], line[axes.axis[2]]);
    const int is_vertical = level <= 1e-3f * fabsf(rise);
    const int axis = is_vertical ? 2 : 1;
    up[0] = up[1] = up[2] = 0.0f;
    up[axes.axis[axis]] = axes.sign[axis] * (is_vertical && rise < 0.0f ? -1.0f : 1.0f);
}

static const float parallel[2] = {0.0f, 0.0f}; /* tangents of parallel lines of sight */

cs_view cs_framing_view(const cs_scene *scene, const cs_framing *framing, int width, int height)
{
    cs_view view = {.fov_deg = framing->fov_deg, .lens_radius = -1.0f};
    const float shorter = width < height ? (float)width : (float)height;
    const float half = tanf(0.5f * framing->fov_deg * degrees) / (margin * shorter);
    const float tangent[2] = {half * (float)width, half * (float)height};
    touch sides[2];
    float frame[3][3], middle[3], distance = -INFINITY;
    picture_axes(framing, frame);
    for (int i = 0; i < 3; i++)
        middle[i] = 0.5f * (scene->bounds[0][i] + scene->bounds[1][i]);
    const float nearest = find_touches(scene, frame, middle, tangent, sides);
    for (int axis = 0; axis < 2; axis++)
        distance = fmaxf(distance, (sides[axis].low + sides[axis].high) / (2.0f * tangent[axis]));
    distance = fmaxf(distance, nearest + 1e-3f * fabsf(distance));
    if (framing->orthographic) find_touches(scene, frame, middle, parallel, sides);
    for (int i = 0; i < 3; i++) {
        view.target[i] = middle[i];
        for (int axis = 0; axis < 2; axis++)
            view.target[i] += 0.5f * (sides[axis].high - sides[axis].low) * frame[axis][i];
        view.eye[i] = view.target[i] + distance * frame[2][i];
        view.up[i] = frame[1][i];
    }
    return view;
}

float cs_framing_width(const cs_scene *scene, const cs_view *view, int width, int height)
{
    const int size[2] = {width, height};
    const float shorter = width < height ? (float)width : (float)height;
    float frame[3][3], most = 0.0f;
    touch sides[2];
    cs_vec_subtract(view->eye, view->target, frame[2]);
    cs_vec_cross(view->up, frame[2], frame[0]);
    cs_vec_cross(frame[2], frame[0], frame[1]);
    for (int axis = 0; axis < 2; axis++) {
        const float length = sqrtf(cs_vec_dot(frame[axis], frame[axis]));
        for (int i = 0; i < 3; i++)
            frame[axis][i] /= length;
    }
    find_touches(scene, frame, view->eye, parallel, sides);
    for (int axis = 0; axis < 2; axis++)
        most = fmaxf(most,
                     2.0f * fmaxf(sides[axis].low, sides[axis].high) * shorter / (float)size[axis]);
    return margin * most;
}
