/* What every kind of light answers for a packet of surface points. Device only. */
#ifndef CS_LIGHT_SAMPLE_H
#define CS_LIGHT_SAMPLE_H

#include "kernels/light/list.h"
#include "kernels/scene_buffers.h"
#include "kernels/surface.h"
#include "kernels/vector.h"

typedef struct cs_light_sample {
    cs_vfloat towards[3]; /* from the surface point to the light; of any length above 0 */
    cs_f32 reach;         /* of the shadow ray, in lengths of `towards`; INFINITY: no end */
    cs_vfloat weight;  /* unshadowed irradiance per unit of `colour`, divided by the density of the
                        * sample; 0 or less where the surface faces away */
    cs_vfloat density; /* per steradian; 0 for lights that no direction finds by chance */
    cs_vfloat colour[3]; /* linear Rec.709 */
} cs_light_sample;

#endif
