#include "helper/collada_sets.h"

#include <assimp/mesh.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "helper/xml.h"

/* A name that textures have for a set, as a material binds it. */
typedef struct binding {
    const char *name; /* not 0-terminated */
    size_t length;
    unsigned long number;
} binding;

typedef struct numbering {
    unsigned long sets[AI_MAX_NUMBER_OF_TEXTURECOORDS]; /* from the lowest on */
    size_t count;
    cs_array bindings; /* binding: of each name the first one */
    size_t conflicts;  /* bindings of a name to another set than the first one */
    int is_full;       /* memory ran out */
} numbering;

/* Whether an attribute says that a tag is about texture coordinates. */
static int is_about_coordinates(const cs_xml_tag *tag, const char *attribute)
{
    static const char kind[] = "TEXCOORD";
    size_t length;
    const char *value = cs_xml_value(tag, attribute, &length);
    return value != NULL && length == sizeof kind - 1 && memcmp(value, kind, length) == 0;
}

/* Returns the number in an attribute, or 0 if the tag has no such attribute. */
static unsigned long number_in(const cs_xml_tag *tag, const char *attribute)
{
    size_t length;
    const char *value = cs_xml_value(tag, attribute, &length);
    return value != NULL ? strtoul(value, NULL, 10) : 0;
}

/* Returns how many sets have lower numbers. */
static size_t place_of(const numbering *work, unsigned long number)
{
    size_t place = 0;
    while (place < work->count && work->sets[place] < number)
        place++;
    return place;
}

/* Adds a number to the sets, in order. Returns 0 if there are too many. */
static int take_in(numbering *work, unsigned long number)
{
    const size_t place = place_of(work, number), behind = work->count - place;
    if (behind > 0 && work->sets[place] == number) return 1;
    if (work->count == AI_MAX_NUMBER_OF_TEXTURECOORDS) return 0;
    memmove(work->sets + place + 1, work->sets + place, behind * sizeof *work->sets);
    work->sets[place] = number;
    work->count++;
    return 1;
}

/* Returns the binding of a name of `length` bytes, or NULL if it has none. */
static const binding *find_binding(const numbering *work, const char *name, size_t length)
{
    const binding *all = work->bindings.items;
    for (size_t i = 0; i < work->bindings.count; i++)
        if (all[i].length == length && memcmp(all[i].name, name, length) == 0) return &all[i];
    return NULL;
}

static void bind(numbering *work, const cs_xml_tag *tag)
{
    size_t length;
    const char *name = cs_xml_value(tag, "semantic", &length);
    const unsigned long number = number_in(tag, "input_set");
    const binding *first = name != NULL ? find_binding(work, name, length) : NULL;
    if (first != NULL) work->conflicts += first->number != number;
    if (name == NULL || first != NULL) return;
    binding *made = cs_array_extend(&work->bindings, 1);
    work->is_full |= made == NULL;
    if (made != NULL) *made = (binding){name, length, number};
}

/* Collects the sets of all meshes, and the bindings. Returns 0 if there are too many sets. */
static int collect(numbering *work, const char *text)
{
    cs_xml_tag tag;
    while (cs_xml_next(&text, &tag)) {
        if (cs_xml_is(&tag, "input") && is_about_coordinates(&tag, "semantic")) {
            if (!take_in(work, number_in(&tag, "set"))) return 0;
        } else if (cs_xml_is(&tag, "bind_vertex_input") &&
                   is_about_coordinates(&tag, "input_semantic")) {
            bind(work, &tag);
        }
    }
    return 1;
}

/* Returns the number of the set that a texture calls by a name of `length` bytes: the number that
 * is bound to the name, or else the digits in it, or else 0. */
static unsigned long number_of(const numbering *work, const char *name, size_t length)
{
    const binding *bound = find_binding(work, name, length);
    const char *end = name + length;
    if (bound != NULL) return bound->number;
    while (name < end && (*name < '0' || *name > '9'))
        name++;
    return name < end ? strtoul(name, NULL, 10) : 0;
}

/* Writes a place, one digit, over an attribute's value of `length` bytes, and zeros before it. */
static void write_place(cs_bytes *bytes, const char *value, size_t length, size_t place)
{
    char *at = bytes->data + (value - bytes->data);
    memset(at, '0', length);
    at[length - 1] = (char)('0' + place % 10);
}

clshear_status cs_collada_number_sets(cs_bytes *bytes, size_t *conflicts, cs_error *error)
{
    numbering work = {.bindings = {.item_size = sizeof(binding)}};
    cs_xml_tag tag;
    size_t length;
    int is_text = strlen(bytes->data) == bytes->size && collect(&work, bytes->data);
    for (const char *text = bytes->data; is_text && cs_xml_next(&text, &tag);) {
        const int is_texture = cs_xml_is(&tag, "texture");
        if (!is_texture && !cs_xml_is(&tag, "input")) continue;
        if (!is_texture && !is_about_coordinates(&tag, "semantic")) continue;
        const char *value = cs_xml_value(&tag, is_texture ? "texcoord" : "set", &length);
        if (value == NULL || length == 0) continue;
        const unsigned long number =
            is_texture ? number_of(&work, value, length) : strtoul(value, NULL, 10);
        write_place(bytes, value, length, place_of(&work, number));
    }
    cs_array_free(&work.bindings);
    *conflicts = work.conflicts;
    return work.is_full ? cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory") : CLSHEAR_OK;
}
