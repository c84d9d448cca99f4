/* Angles and powers, by one name in both languages. Shared. */
#ifndef CS_KERNELS_TRIGONOMETRY_H
#define CS_KERNELS_TRIGONOMETRY_H

#include "clshear/device/packet.h"

#ifdef CS_DEVICE
#define cs_sin(x) sin(x)
#define cs_cos(x) cos(x)
#define cs_atan2(y, x) atan2(y, x)
#define cs_power(x, y) pow(x, y)
#else
#define cs_sin(x) sinf(x)
#define cs_cos(x) cosf(x)
#define cs_atan2(y, x) atan2f(y, x)
#define cs_power(x, y) powf(x, y)
#endif

#endif
