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

/* Samples at places `start` to `end` of the order of a few pixels, gathered and merged into them.
 * Of several pixels there are no more than are drawn together. */
static inline void cs_sample(const cs_frame *frame, const cs_world *world, cs_rows rows,
                             cs_optics_table table, const cs_place *places, int count, u32 start,
                             u32 end, CS_GLOBAL cs_pixel *pixels)
{
    cs_drawn drawn;
    cs_gather gather;
    int first = 1;
    for (; start < end; start += (u32)(CS_TOGETHER * CS_PACKET)) {
        int more = count == 1 && start + (u32)(CS_TOGETHER * CS_PACKET) < end;
        cs_draw_packets(frame, rows, table, places, count, start, end, &drawn);
        for (int packet = 0; packet < drawn.count; packet++) {
            const cs_place *place = places + drawn.place[packet];
            cs_radiance radiance;
            cs_trace_packet(frame, world, place, &drawn, packet, &radiance);
            cs_gather_add(&gather, radiance.channel, radiance.shadow_rays, drawn.active[packet],
                          first);
            first =
                packet + 1 < drawn.count ? drawn.place[packet + 1] != drawn.place[packet] : !more;
            if (first) cs_merge_gather(pixels + place->state, &gather);
        }
    }
}

/* One work-item draws blocks [first_block, last_block) of the patterns of frame.pixels_each pixels.
 *
 * Global size: at least frame.pixel_count / frame.pixels_each, rounded up; any local size. pixels:
 * one cs_pixel for each pixel of the crop from frame.page_first on, or each that is drawn, zero at
 * first. order: the crop's pixels (row by row) in the order in which they are drawn. shears: the
 * oracle's answer for each pixel of the crop, in pixels. rows: the pattern's table. table: the
 * optics'. The others: the scene, see cs_world. */
__kernel void cs_render(const cs_frame frame, __global cs_pixel *pixels, __global const uint *order,
                        __global const float *shears, __global const uint *rows,
                        __global const float *table, __global const cs_node *nodes,
                        __global const cs_triangle *triangles, __global const cs_face *faces,
                        __global const cs_vertex *vertices, __global const cs_material *materials,
                        __global const cs_texture *textures, __global const half *texels,
                        __global const cs_light *lights, __global const cs_emitter *emitters)
{
    u32 begin = (u32)get_global_id(0) * frame.pixels_each;
    if (begin >= frame.pixel_count) return;
    const cs_world world = {nodes,    triangles, faces,  vertices, materials,
                            textures, texels,    lights, emitters};
    cs_place places[CS_TOGETHER];
    int count = (int)min(frame.pixels_each, frame.pixel_count - begin);
    for (int i = 0; i < count; i++) {
        u32 number = order[frame.first_pixel + begin + (u32)i];
        places[i] = cs_place_of(&frame, begin + (u32)i, number, shears[number]);
    }
    for (u32 block = frame.first_block; block < frame.last_block; block += CS_FLUSH_BLOCKS) {
        u32 end = min(block + (u32)CS_FLUSH_BLOCKS, frame.last_block) * (u32)CS_BLOCK;
        cs_sample(&frame, &world, rows, table, places, count, block * (u32)CS_BLOCK, end, pixels);
    }
    if (frame.last_block != frame.pattern.blocks) return;
    for (int i = 0; i < count; i++)
        cs_finish_pattern(pixels + places[i].state);
}
