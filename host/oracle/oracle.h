/* The oracle: from what is known of a pixel's depths to the shear of its samples. A wrong answer
 * costs variance, never bias. */
#ifndef CS_ORACLE_ORACLE_H
#define CS_ORACLE_ORACLE_H

#include "base/depth.h"
#include "clshear/choices.h"
#include "clshear/device/camera.h"

/* Rules, in the order of the public enumeration; then what a pilot may choose besides. */
typedef enum cs_rule {
    CS_RULE_CENTRE,
    CS_RULE_MEDIAN,
    CS_RULE_NEAR,
    CS_RULE_FAR,
    CS_RULE_NONE, /* no shear */
    CS_RULE_COUNT
} cs_rule;

/* The rule of an oracle; the pilot begins with the centre. */
cs_rule cs_rule_of(clshear_oracle oracle);

/* The signed circle of confusion, in pixels, of the depth that the rule takes. Centres that see
 * nothing take the median of what the rest of the pixel and lens sees; 0 where that is nothing. */
cs_f32 cs_oracle_shear(const cs_camera *camera, const cs_depth *depth, cs_rule rule);

#endif
