/* Lookup in the scene's textures. Device only. */
#ifndef CS_TEXTURE_H
#define CS_TEXTURE_H

#include "clshear/device/packet.h"
#include "kernels/features.h"
#include "kernels/scene_buffers.h"

/* Between which two of `size` texels the repeating coordinate `place` lies, and how far on. */
typedef struct cs_texel_pair {
    cs_int_lanes first;
    cs_int_lanes second;
    cs_float_lanes part;
} cs_texel_pair;

static inline cs_texel_pair cs_texels_at(cs_vfloat place, cs_u32 size)
{
    cs_f32 last = (cs_f32)size - 1.0f;
    cs_vfloat centre = (place - floor(place)) * (cs_f32)size - 0.5f;
    cs_vfloat before = floor(centre);
    /* Rounding may reach the far edge; the limits also hold what huge coordinates give. */
    cs_vfloat first = before < 0.0f ? (cs_vfloat)(last) : cs_min(before, (cs_vfloat)(last));
    cs_vfloat second =
        before + 1.0f > last ? (cs_vfloat)(0.0f) : cs_max(before + 1.0f, (cs_vfloat)(0.0f));
    cs_texel_pair pair;
    pair.first.all = CS_OVER_LANES(convert_int)(first);
    pair.second.all = CS_OVER_LANES(convert_int)(cs_min(second, (cs_vfloat)(last)));
    pair.part.all = centre - before;
    return pair;
}

#if CS_HAS(LOOKUPS)
/* The same for coordinates that do not repeat: beyond its edges the image has the colour of its
 * border, or is seen in a mirror. */
static inline cs_texel_pair cs_texels_within(cs_vfloat place, cs_u32 size, cs_u32 wrap)
{
    cs_f32 last = (cs_f32)size - 1.0f;
    cs_vfloat turns = place - 2.0f * floor(0.5f * place); /* 0 to 2 */
    cs_vfloat inside = wrap == CS_TEXTURE_MIRROR ? 1.0f - fabs(1.0f - turns) : place;
    cs_vfloat centre =
        cs_min(cs_max(inside * (cs_f32)size - 0.5f, (cs_vfloat)(0.0f)), (cs_vfloat)(last));
    cs_vfloat before = floor(centre);
    cs_texel_pair pair;
    pair.first.all = CS_OVER_LANES(convert_int)(before);
    pair.second.all = CS_OVER_LANES(convert_int)(cs_min(before + 1.0f, (cs_vfloat)(last)));
    pair.part.all = centre - before;
    return pair;
}
#endif

/* The texture at the coordinates (s, t) of the lanes that are `wanted`, bilinear but for
 * CS_TEXTURE_NEAREST; (0, 0) is the lower left corner of the image. With the feature MATERIALS
 * there is a fourth channel. */
static inline void cs_texels(const cs_scene_buffers *scene, cs_u32 texture, cs_vfloat s,
                             cs_vfloat t, cs_int_lanes wanted, cs_float_lanes *colour)
{
    CS_GLOBAL const cs_texture *image = scene->textures + texture;
#if CS_HAS(LOOKUPS)
    cs_u32 wrap_s = image->lookup & CS_TEXTURE_WRAP_MASK;
    cs_u32 wrap_t = image->lookup >> CS_TEXTURE_WRAP_BITS & CS_TEXTURE_WRAP_MASK;
    cs_texel_pair x = wrap_s == CS_TEXTURE_REPEAT ? cs_texels_at(s, image->width)
                                                  : cs_texels_within(s, image->width, wrap_s);
    cs_texel_pair y = wrap_t == CS_TEXTURE_REPEAT
                          ? cs_texels_at(1.0f - (t - floor(t)), image->height)
                          : cs_texels_within(1.0f - t, image->height, wrap_t);
    if (image->lookup & CS_TEXTURE_NEAREST) {
        x.part.all = x.part.all < 0.5f ? (cs_vfloat)(0.0f) : (cs_vfloat)(1.0f);
        y.part.all = y.part.all < 0.5f ? (cs_vfloat)(0.0f) : (cs_vfloat)(1.0f);
    }
#else
    cs_texel_pair x = cs_texels_at(s, image->width);
    cs_texel_pair y = cs_texels_at(1.0f - (t - floor(t)), image->height);
#endif
    y.first.all *= (cs_i32)image->width;
    y.second.all *= (cs_i32)image->width;
    CS_GLOBAL const half *texels = scene->texels + 4u * (size_t)image->first;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        if (!wanted.lane[lane]) continue;
        size_t left = (size_t)x.first.lane[lane], right = (size_t)x.second.lane[lane];
        size_t above = (size_t)y.first.lane[lane], below = (size_t)y.second.lane[lane];
        cs_f32 across = x.part.lane[lane];
        float4 upper =
            mix(vload_half4(above + left, texels), vload_half4(above + right, texels), across);
        float4 lower =
            mix(vload_half4(below + left, texels), vload_half4(below + right, texels), across);
        float4 value = mix(upper, lower, y.part.lane[lane]);
        colour[0].lane[lane] = value.x;
        colour[1].lane[lane] = value.y;
        colour[2].lane[lane] = value.z;
#if CS_HAS(MATERIALS)
        colour[3].lane[lane] = value.w;
#endif
    }
}

#endif
