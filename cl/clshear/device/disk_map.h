/* The equal-area shear of the disk, which is not separable: Rosenblatt's transform in the order
 * t_x, t_y | t_x, u | t, v | t, u.
 *
 * Three of the four are solved for by Halley's steps, each waiting for the one before it. Packets
 * are mapped together, all of them a stage at a time: while one waits, the processor finds work in
 * the others. */
#ifndef CLSHEAR_DEVICE_DISK_MAP_H
#define CLSHEAR_DEVICE_DISK_MAP_H

#include "camera_sample.h"
#include "disk_fibre.h"

#include "fp_contract_off.h"

enum {
    CS_DISK_STEPS = 2 /* Halley's steps for each unknown, at most: hardly any wants a third */
};

/* One packet on its way through the stages below. t_y and u are solved for in mirror images, with
 * tuple coordinates y <= 1/2 and u <= 1/2. */
typedef struct cs_disk_way {
    cs_blur blur;
    cs_disk_window window;
    cs_vfloat mass; /* probability below the unknown that is solved for */
    cs_vfloat root; /* square root of `mass` */
    cs_vint rough;  /* mask of the lanes whose unknown wants another step */
    cs_vfloat low;  /* left end of the slab, before it is cut to the window */
    cs_vfloat high; /* right end of the slab, likewise */
    cs_vfloat t_x;  /* first fibre coordinate: x - 1/2 + blur * u */
    cs_vfloat t_y;  /* second fibre coordinate: y - 1/2 + blur * v */
    cs_vfloat area; /* area of the slab's upper half, then of the window */
    cs_vfloat u;    /* lens coordinate */
} cs_disk_way;

/* The stages, in the order in which cs_disk_map calls them. */

/* Begins to solve for an unknown with the probability `mass` below it: every lane is rough. */
CS_INLINED void cs_disk_set_mass(cs_disk_way *way, cs_vfloat mass)
{
    way->mass = mass;
    way->root = cs_sqrt(mass);
    way->rough = mass >= 0.0f;
}

/* First guess of t_x. */
CS_INLINED void cs_disk_guess_t_x(const cs_camera_sample *tuple, cs_disk_way *way)
{
    cs_disk_set_mass(way, cs_disk_fibre_mass(tuple->x));
    way->t_x = cs_disk_fibre_guess(way->mass, way->blur.x);
}

/* A step towards t_x in the lanes that are rough. */
CS_INLINED void cs_disk_step_t_x(cs_disk_way *way)
{
    cs_vint again;
    cs_vfloat t = cs_disk_fibre_step(way->t_x, way->root, way->blur.x, &again);
    way->t_x = way->rough ? t : way->t_x;
    way->rough = again;
}

/* The slab of the disk that fibres at t_x cross. */
CS_INLINED void cs_disk_find_slab(const cs_camera_sample *tuple, cs_disk_way *way)
{
    cs_f32 inverse = 1.0f / way->blur.x;
    way->t_x = tuple->x > 0.5f ? -way->t_x : way->t_x;
    way->low = cs_max((way->t_x - 0.5f) * inverse, (cs_vfloat)(-CS_DISK_RADIUS));
    way->high = cs_min((way->t_x + 0.5f) * inverse, (cs_vfloat)(CS_DISK_RADIUS));
    way->window.slab = cs_disk_slab_of(way->low, way->high);
    way->area = cs_max(cs_disk_half_slab(way->window.slab), (cs_vfloat)(1e-12f));
}

/* First guess of t_y. */
CS_INLINED void cs_disk_guess_t_y(const cs_camera_sample *tuple, cs_disk_way *way)
{
    cs_vfloat mass = tuple->y > 0.5f ? 1.0f - tuple->y : tuple->y;
    cs_disk_set_mass(way, cs_max(mass, (cs_vfloat)(1e-9f)));
    way->t_y = cs_disk_slab_guess(way->mass, way->window.slab, way->blur.y);
}

/* A step towards t_y in the lanes that are rough. */
CS_INLINED void cs_disk_step_t_y(cs_disk_way *way)
{
    cs_vint again;
    cs_vfloat t =
        cs_disk_slab_step(way->t_y, way->root, way->window.slab, way->area, way->blur.y, &again);
    way->t_y = way->rough ? t : way->t_y;
    way->rough = again;
}

/* The window of the slab that fibres at t_y see. */
CS_INLINED void cs_disk_find_window(cs_disk_way *way)
{
    cs_f32 inverse = 1.0f / way->blur.y;
    way->window.blur = way->blur.y;
    way->window.bottom = (way->t_y - 0.5f) * inverse;
    way->window.top = (way->t_y + 0.5f) * inverse;
    way->area = cs_max(cs_disk_window_area(way->window, way->area), (cs_vfloat)(1e-12f));
}

/* First guess of u, in the slab cut to the window. */
CS_INLINED void cs_disk_guess_u(const cs_camera_sample *tuple, cs_disk_way *way)
{
    cs_vint mirror_x = tuple->u > 0.5f;
    cs_vfloat reach = cs_disk_chord(cs_min(way->window.top, (cs_vfloat)(0.0f)));
    way->window.slab = cs_disk_slab_of(cs_max(mirror_x ? -way->high : way->low, -reach),
                                       cs_min(mirror_x ? -way->low : way->high, reach));
    cs_disk_set_mass(way, mirror_x ? 1.0f - tuple->u : tuple->u);
    way->u = cs_disk_window_guess(way->mass, way->window);
}

/* A step towards u in the lanes that are rough. */
CS_INLINED void cs_disk_step_u(cs_disk_way *way)
{
    cs_vint again;
    cs_vfloat u = cs_disk_window_step(way->u, way->root, way->window, way->area, &again);
    way->u = way->rough ? u : way->u;
    way->rough = again;
}

/* The place v on the fibre, then everything out of the mirrors. */
CS_INLINED cs_camera_sample cs_disk_end(const cs_camera_sample *tuple, const cs_disk_way *way)
{
    cs_vint mirror_x = tuple->u > 0.5f;
    cs_vint mirror_y = tuple->y > 0.5f;
    cs_vfloat chord = cs_disk_chord(way->u);
    cs_vfloat u = mirror_x ? -way->u : way->u;
    cs_vfloat along = mirror_y ? 1.0f - tuple->v : tuple->v;
    cs_vfloat least = cs_max(-chord, way->window.bottom);
    cs_vfloat v = least + cs_disk_window_height(way->window, chord) * along;
    cs_vfloat y = way->t_y - way->blur.y * v;
    cs_camera_sample point;
    point.x = way->t_x - way->blur.x * u + 0.5f;
    point.y = (mirror_y ? -y : y) + 0.5f;
    point.u = way->blur.sign * u;
    point.v = way->blur.sign * (mirror_y ? -v : v);
    return point;
}

/* Maps `count` packets of tuples in place. `count` is 1 to CS_TOGETHER; packet k has the shear
 * shears[k], in pixels per lens unit; `squeeze` is that of the optics. */
static inline void cs_disk_map(cs_camera_sample *points, const cs_f32 *shears, int count,
                               cs_f32 squeeze)
{
    cs_disk_way way[CS_TOGETHER];
    for (int k = 0; k < count; k++)
        way[k].blur = cs_blur_of(shears[k], squeeze);
    for (int k = 0; k < count; k++)
        cs_disk_guess_t_x(points + k, way + k);
    for (int step = 0; step < CS_DISK_STEPS; step++)
        for (int k = 0; k < count; k++)
            if (cs_any(way[k].rough)) cs_disk_step_t_x(way + k);
    for (int k = 0; k < count; k++)
        cs_disk_find_slab(points + k, way + k);
    for (int k = 0; k < count; k++)
        cs_disk_guess_t_y(points + k, way + k);
    for (int step = 0; step < CS_DISK_STEPS; step++)
        for (int k = 0; k < count; k++)
            if (cs_any(way[k].rough)) cs_disk_step_t_y(way + k);
    for (int k = 0; k < count; k++)
        cs_disk_find_window(way + k);
    for (int k = 0; k < count; k++)
        cs_disk_guess_u(points + k, way + k);
    for (int step = 0; step < CS_DISK_STEPS; step++)
        for (int k = 0; k < count; k++)
            if (cs_any(way[k].rough)) cs_disk_step_u(way + k);
    for (int k = 0; k < count; k++)
        points[k] = cs_disk_end(points + k, way + k);
}

#include "fp_contract_restore.h"

#endif
