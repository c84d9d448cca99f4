/* The oracle: converts the depths in a pixel to a shear. A wrong answer costs variance, never
 * bias. */
#ifndef CS_ORACLE_ORACLE_H
#define CS_ORACLE_ORACLE_H

#include "base/depth.h"
#include "clshear/choices.h"
#include "clshear/device/camera.h"
#include "clshear/device/camera_sample.h"

/* Rules of the oracle, in the order of the public enumeration, and then those that have no name
 * there: of the pilot, and of `edge`. The channel `Oracle` of a film holds these numbers. */
typedef enum cs_rule {
    CS_RULE_CENTRE,
    CS_RULE_MEDIAN,
    CS_RULE_NEAR,
    CS_RULE_FAR,
    CS_RULE_NONE,   /* no shear */
    CS_RULE_LENS,   /* of what moves: the centre's shear, as if it were at rest */
    CS_RULE_MOTION, /* of what moves: its velocity, as if it were in focus */
    CS_RULE_FRONT,  /* the mean shear of what stands in front where depths lie apart */
    CS_RULE_COUNT
} cs_rule;

/* The shear for a rule: the signed circle of confusion of the rule's depth, in pixels, at raster
 * position (x, y), which is the middle of the pixel. If the centre ray hits nothing, the centre
 * rule takes the median depth; where nothing stands in front, FRONT takes the centre's rule.
 * Returns 0 for an infinite depth. */
cs_f32 cs_oracle_shear(const cs_camera *camera, cs_f32 x, cs_f32 y, const cs_depth *depth,
                       cs_rule rule);

/* The rule of an oracle for a pixel with these depths. `edge` takes what stands in front where the
 * pixel sees depths that lie apart (`cs_front_shear`), and the centre elsewhere. The pilot starts
 * from the centre. */
cs_rule cs_oracle_rule(clshear_oracle oracle, const cs_depth *depth);

/* Whether the rule shears by the velocity, too, where there is motion. */
int cs_rule_has_velocity(cs_rule rule);

/* The velocity on the film, pixels while the shutter is open, of a point that the camera `open`
 * sees at `from` where the shutter opens and the camera `closed` sees at `to` where it closes. 0
 * for a point behind either camera. */
cs_velocity cs_oracle_velocity(const cs_camera *open, const cs_camera *closed, const float *from,
                               const float *to);

#endif
