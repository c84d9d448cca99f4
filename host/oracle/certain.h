/* Pixels that certainly show nothing but what lies behind the scene. */
#ifndef CS_ORACLE_CERTAIN_H
#define CS_ORACLE_CERTAIN_H

#include <stdint.h>

#include "base/status.h"
#include "clshear/device/dialect.h"

/* Marks by 1 in `certain`, else 0, the pixels of a window that nothing reaches. reach_px: for each
 * pixel, row by row, how far from its middle what its rays have hit may be seen, in either axis,
 * px; negative: they have hit nothing. Takes a few operations a pixel, however far blur reaches.
 * Fails when out of memory. */
clshear_status cs_mark_certain(const cs_f32 *reach_px, int width, int height, uint8_t *certain,
                               cs_error *error);

#endif
