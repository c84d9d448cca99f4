/* The way of a sample: tuple -> shear -> ray -> hit -> radiance -> mean and variance. */
#include "draw.h"
#include "gather.h"
#include "lens.h"
#include "shade.h"

static inline void cs_trace_packet(const cs_frame *frame, const cs_world *world,
                                   const cs_place *place, const cs_drawn *drawn, int packet,
                                   cs_radiance *radiance)
{
    cs_film_lens point = drawn->point[packet];
    cs_ray ray = cs_lens_ray(frame->camera, point.x + (f32)place->x, point.y + (f32)place->y,
                             point.u, point.v);
    *radiance = cs_radiance_along(world, frame->lights, frame->emitters, &ray,
                                  drawn->emitter[packet], drawn->active[packet]);
}

/* Samples at places `start` to `end` of the pixel's order, gathered. */
static inline void cs_sample(const cs_frame *frame, const cs_world *world, cs_rows rows,
                             cs_optics_table table, const cs_place *place, u32 start, u32 end,
                             cs_gather *gather)
{
    cs_drawn drawn;
    int first = 1;
    for (; start < end; start += (u32)(CS_TOGETHER * CS_PACKET)) {
        cs_draw_packets(frame, rows, table, place, start, end, &drawn);
        for (int packet = 0; packet < drawn.count; packet++) {
            cs_radiance radiance;
            cs_trace_packet(frame, world, place, &drawn, packet, &radiance);
            cs_gather_add(gather, radiance.channel, radiance.shadow_rays, drawn.active[packet],
                          first);
            first = 0;
        }
    }
}

/* One work-item draws blocks [first_block, last_block) of one pixel's pattern.
 *
 * Global size: at least frame.pixel_count; any local size. pixels: one cs_pixel for each pixel of
 * the crop from frame.page_first on, zero at first. order:
 * the crop's pixels (row by row) in the order in which they are drawn. shears: the oracle's answer
 * for each pixel of the crop, in pixels. rows: the pattern's table. table: the optics'. The others:
 * the scene, see cs_world. */
__kernel void cs_render(const cs_frame frame, __global cs_pixel *pixels, __global const uint *order,
                        __global const float *shears, __global const uint *rows,
                        __global const float *table, __global const cs_node *nodes,
                        __global const cs_triangle *triangles, __global const cs_face *faces,
                        __global const cs_vertex *vertices, __global const cs_material *materials,
                        __global const cs_texture *textures, __global const half *texels,
                        __global const cs_light *lights, __global const cs_emitter *emitters)
{
    if (get_global_id(0) >= frame.pixel_count) return;
    const cs_world world = {nodes,    triangles, faces,  vertices, materials,
                            textures, texels,    lights, emitters};
    u32 number = order[frame.first_pixel + (u32)get_global_id(0)];
    cs_place place;
    place.x = frame.crop_x + number % frame.crop_width;
    place.y = frame.crop_y + number / frame.crop_width;
    place.key = cs_pattern_key(frame.seed, place.y * frame.image_width + place.x, frame.replicate);
    place.shear = shears[number];
    __global cs_pixel *pixel = pixels + (number - frame.page_first);

    for (u32 block = frame.first_block; block < frame.last_block; block += CS_FLUSH_BLOCKS) {
        u32 end = min(block + (u32)CS_FLUSH_BLOCKS, frame.last_block) * (u32)CS_BLOCK;
        cs_gather gather;
        cs_sample(&frame, &world, rows, table, &place, block * (u32)CS_BLOCK, end, &gather);
        cs_merge_gather(pixel, &gather);
    }
    if (frame.last_block == frame.pattern.blocks) cs_finish_pattern(pixel);
}
