/* The shear for the nearer surfaces of a pixel that sees an edge. */
#ifndef CS_ACCEL_FRONT_H
#define CS_ACCEL_FRONT_H

#include "clshear/device/camera.h"

/* The mean shear, in pixels, of those of `count` depths that lie before the first gap; infinite
 * without a gap. A gap is where shears of neighbours differ by more than 0.05 pixels and by more
 * than a quarter of the shear before it. `depths`: along rays of the pixel around raster position
 * (x, y), world units, ascending, above 0, infinite for rays that hit nothing. */
cs_f32 cs_front_shear(const cs_camera *camera, cs_f32 x, cs_f32 y, const cs_f32 *depths,
                      cs_u32 count);

#endif
