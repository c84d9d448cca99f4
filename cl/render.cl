/* The way of a sample: tuple -> shear -> ray -> hit -> radiance -> mean and variance. */
#include "frame.h"
#include "gather.h"
#include "lens.h"
#include "shade.h"
#include "shear.h"

typedef struct cs_place {
    u32 x; /* raster coordinates in the whole image */
    u32 y;
    u32 key;   /* of the pixel's current pattern */
    f32 shear; /* of its tuples, pixels */
} cs_place;

/* Draws and traces the packet that begins at place `start` of the pixel's order; returns the lanes
 * in use: those before `end` that are samples of the pattern. */
static inline vint cs_sample_packet(const cs_frame *frame, const cs_world *world,
                                    const cs_place *place, u32 start, u32 end,
                                    cs_radiance *radiance)
{
    vuint position = start + CS_LANE_INDEX;
    vint inside = position < end;
    vuint index = cs_index_at(&frame->grid, place->key, inside ? position : (vuint)(start));
    vint active = inside & (index < frame->grid.count);
    index = active ? index : (vuint)(0u);
    cs_pair film = cs_draw_pair(&frame->grid, place->key, CS_PAIR_FIBRE, index);
    cs_pair lens = cs_draw_pair(&frame->grid, place->key, CS_PAIR_LENS, index);
    cs_pair emitter = film;
    if (frame->emitters > 0u)
        emitter = cs_draw_pair(&frame->grid, place->key, CS_PAIR_EMITTER, index);
    cs_film_lens point = cs_shear(film.x, film.y, lens.x, lens.y, frame->shear_mode,
                                  frame->camera.aperture, place->shear);
    cs_ray ray = cs_lens_ray(frame->camera, point.x + (f32)place->x, point.y + (f32)place->y,
                             point.u, point.v);
    *radiance = cs_radiance_along(world, frame->lights, frame->emitters, &ray, emitter, active);
    return active;
}

/* One work-item draws blocks [first_block, last_block) of one pixel's pattern.
 *
 * Global size: at least frame.pixel_count; any local size. pixels: one cs_pixel for each pixel of
 * the crop, zero at first. shears: the oracle's answer for each pixel of the crop, in pixels. The
 * others: the scene, see cs_world. */
__kernel void cs_render(const cs_frame frame, __global cs_pixel *pixels,
                        __global const float *shears, __global const cs_node *nodes,
                        __global const cs_triangle *triangles, __global const cs_face *faces,
                        __global const cs_vertex *vertices, __global const cs_material *materials,
                        __global const cs_texture *textures, __global const half *texels,
                        __global const cs_light *lights, __global const cs_emitter *emitters)
{
    if (get_global_id(0) >= frame.pixel_count) return;
    const cs_world world = {nodes,    triangles, faces,  vertices, materials,
                            textures, texels,    lights, emitters};
    u32 number = cs_tiled_pixel(frame.first_pixel + (u32)get_global_id(0), frame.crop_width,
                                frame.crop_height);
    cs_place place;
    place.x = frame.crop_x + number % frame.crop_width;
    place.y = frame.crop_y + number / frame.crop_width;
    place.key = cs_pattern_key(frame.seed, place.y * frame.image_width + place.x, frame.replicate);
    place.shear = shears[number];
    __global cs_pixel *pixel = pixels + number;

    for (u32 block = frame.first_block; block < frame.last_block; block += CS_FLUSH_BLOCKS) {
        u32 end = min(block + (u32)CS_FLUSH_BLOCKS, frame.last_block) * (u32)CS_BLOCK;
        cs_gather gather;
        int first = 1;
        for (u32 start = block * (u32)CS_BLOCK; start < end; start += (u32)CS_PACKET) {
            cs_radiance radiance;
            vint active = cs_sample_packet(&frame, &world, &place, start, end, &radiance);
            cs_gather_add(&gather, radiance.channel, radiance.shadow_rays, active, first);
            first = 0;
        }
        cs_merge_gather(pixel, &gather);
    }
    if (frame.last_block == frame.grid.blocks) cs_finish_pattern(pixel);
}
