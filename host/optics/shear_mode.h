/* Conversion of the public shear to the kernels' number. Both enumerations agree. */
#ifndef CS_OPTICS_SHEAR_MODE_H
#define CS_OPTICS_SHEAR_MODE_H

#include "clshear/choices.h"
#include "clshear/device/camera.h"

_Static_assert((int)CLSHEAR_SHEAR_NONE == CS_SHEAR_NONE, "cs_shear_mode casts");
_Static_assert((int)CLSHEAR_SHEAR_TOROIDAL == CS_SHEAR_TOROIDAL, "cs_shear_mode casts");
_Static_assert((int)CLSHEAR_SHEAR_EQUAL_AREA == CS_SHEAR_EQUAL_AREA, "cs_shear_mode casts");

static inline cs_u32 cs_shear_mode(clshear_shear shear)
{
    return (cs_u32)shear;
}

#endif
