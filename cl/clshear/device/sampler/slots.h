/* The slots of a tuple: what its coordinates are for. */
#ifndef CLSHEAR_DEVICE_SAMPLER_SLOTS_H
#define CLSHEAR_DEVICE_SAMPLER_SLOTS_H

#include "../dialect.h"

/* X(identifier, width, names): a slot of `width` coordinates, at most CS_SLOT_WIDEST, each with a
 * letter as its name. The list's order is the order in a tuple.
 *
 * FILM   Place in the pixel. After an equal-area shear, the first pair chooses the fibre.
 * LENS   Place on the lens. After an equal-area shear, the second pair is the place on the fibre.
 * LIGHT  Choice of an area light and of the place on it.
 *
 * Film and lens are the main slots: cs_draw makes them together, as well stratified in four
 * dimensions as the sampler can. cs_draw_extra makes each of the others by itself. A slot may be
 * appended; one that is moved changes every sample. */
#define CS_SLOT_LIST(X) \
    X(FILM, 2, "xy")    \
    X(LENS, 2, "uv")    \
    X(LIGHT, 2, "pq")

/* Numbers of the slots. */
#define CS_SLOT_NUMBER(identifier, width, names) CS_SLOT_##identifier,
enum {
    CS_SLOT_LIST(CS_SLOT_NUMBER) CS_SLOT_COUNT
};

/* Number of the first and of the last coordinate of each slot, and of coordinates in all. */
#define CS_SLOT_PLACE(identifier, width, names) \
    CS_AT_##identifier, CS_END_##identifier = CS_AT_##identifier + (width)-1,
enum {
    CS_SLOT_LIST(CS_SLOT_PLACE) CS_DIMENSIONS
};

enum {
    CS_MAIN_SLOTS = CS_SLOT_LENS + 1,     /* slots that cs_draw fills */
    CS_MAIN_DIMENSIONS = CS_END_LENS + 1, /* coordinates that cs_draw fills */
    CS_SLOT_WIDEST = 2                    /* coordinates of the widest slot */
};

/* The coordinates' names in a row: "xyuv...". */
#define CS_SLOT_NAMES(identifier, width, names) names
#define CS_DIMENSION_NAMES CS_SLOT_LIST(CS_SLOT_NAMES)

/* Number of the first coordinate of a slot. */
static inline cs_u32 cs_slot_place(cs_u32 slot)
{
#define CS_SLOT_CASE(identifier, width, names) \
    if (slot == (cs_u32)CS_SLOT_##identifier) return CS_AT_##identifier;
    CS_SLOT_LIST(CS_SLOT_CASE)
#undef CS_SLOT_CASE
    return CS_DIMENSIONS;
}

/* Coordinates of a slot: 1 or CS_SLOT_WIDEST. */
static inline cs_u32 cs_slot_width(cs_u32 slot)
{
    return cs_slot_place(slot + 1u) - cs_slot_place(slot);
}

#endif
