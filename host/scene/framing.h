/* The camera of a scene that has none: it shows all of it. */
#ifndef CS_SCENE_FRAMING_H
#define CS_SCENE_FRAMING_H

#include "scene/scene.h"

/* From where the scene is seen. Angles in degrees: azimuth 0 and elevation 0 are straight from the
 * front, 90 and 0 from the scene's +X side, elevation 90 from above. */
typedef struct cs_framing {
    int z_up; /* 1: +Z is up and -Y in front; 0: +Y is up and +Z in front */
    float azimuth_deg;
    float elevation_deg;
    float fov_deg;    /* along the shorter image axis */
    int orthographic; /* 1: parallel lines of sight. The eye stands where a camera of this field of
                         view would */
} cs_framing;

/* Three-quarter view from the front, slightly above; straight from the front for a room without a
 * front wall. */
cs_framing cs_framing_default(const cs_scene *scene, int z_up);

/* Whether a scene stands on z = 0 as one stands that has +Z up: it begins there, rises by a quarter
 * of its size or more, and goes on below y = 0. */
int cs_framing_stands_on_z(const cs_scene *scene);

/* The nearest camera in that direction whose picture, of this size, shows every triangle inside a
 * margin. Eye and target are relative to the scene's origin. The lens is not chosen. */
cs_view cs_framing_view(const cs_scene *scene, const cs_framing *framing, int width, int height);

/* What is up in the picture of a camera that looks along `line` (any length, in coordinates of the
 * file) and stands upright: the unit vector of the file's up, +Y or with z_up +Z. Straight down
 * (within a thousandth) the front is at the bottom of the picture, straight up at its top. */
void cs_framing_upright(int z_up, const float *line, float *up);

/* What the shorter image axis has to show of the scene (cs_view.orthographic) around the axis of a
 * camera, for a picture of this size. */
float cs_framing_width(const cs_scene *scene, const cs_view *view, int width, int height);

#endif
