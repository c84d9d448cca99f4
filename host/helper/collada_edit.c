#include "helper/collada_edit.h"

#include <string.h>

#include "base/array.h"
#include "helper/xml.h"

/* A part of the old text. */
typedef struct part {
    const char *at;
    size_t length;
} part;

/* A controller of morph targets, and the mesh that it changes. */
typedef struct morph {
    part id;
    part source; /* with its # */
} morph;

typedef struct editing {
    cs_array text;      /* char: the new one */
    const char *copied; /* up to here the old text is in the new one, or left out */
    cs_array morphs;    /* morph */
    int is_full;        /* memory ran out */
    int in_holes;       /* within <ph> */
    int is_renaming;    /* within an instance of a controller that became one of a mesh */
    cs_collada_losses lost;
} editing;

static void put(editing *edit, const char *text, size_t length)
{
    char *added = cs_array_extend(&edit->text, length);
    edit->is_full |= added == NULL;
    if (added != NULL) memcpy(added, text, length);
}

/* Copies the old text up to `to`, and goes on from `behind`. */
static void copy(editing *edit, const char *to, const char *behind)
{
    put(edit, edit->copied, (size_t)(to - edit->copied));
    edit->copied = behind;
}

static part value_of(const cs_xml_tag *tag, const char *name)
{
    part value = {NULL, 0};
    value.at = cs_xml_value(tag, name, &value.length);
    return value.at != NULL ? value : (part){"", 0};
}

static void find_morphs(editing *edit, const char *text)
{
    cs_xml_tag tag;
    part id = {"", 0};
    while (cs_xml_next(&text, &tag)) {
        if (tag.closes) continue;
        if (cs_xml_is(&tag, "controller")) id = value_of(&tag, "id");
        const part source = value_of(&tag, "source");
        if (!cs_xml_is(&tag, "morph") || id.length == 0 || source.length == 0) continue;
        morph *added = cs_array_extend(&edit->morphs, 1);
        edit->is_full |= added == NULL;
        if (added != NULL) *added = (morph){id, source};
    }
}

/* The morph of an id, or of a reference to one, which begins with a #; NULL where it is none. */
static const morph *morph_called(const editing *edit, part name)
{
    const morph *all = edit->morphs.items;
    if (name.length > 0 && name.at[0] == '#') name = (part){name.at + 1, name.length - 1};
    for (size_t i = 0; i < edit->morphs.count; i++)
        if (all[i].id.length == name.length && memcmp(all[i].id.at, name.at, name.length) == 0)
            return &all[i];
    return NULL;
}

static size_t count_numbers(const char *at, const char *end)
{
    size_t count = 0;
    while (at < end) {
        while (at < end && (unsigned char)*at <= ' ')
            at++;
        count += at < end;
        while (at < end && (unsigned char)*at > ' ')
            at++;
    }
    return count;
}

/* Leaves out an element, up to its end; `*at` moves there. */
static int leave_out(editing *edit, const cs_xml_tag *tag, const char *closing, const char **at)
{
    const char *end = tag->is_empty ? NULL : strstr(*at, closing);
    if (end == NULL) return 0;
    *at = end + strlen(closing);
    copy(edit, tag->begin, *at);
    return 1;
}

/* What refers to a controller of morph targets refers to its mesh instead. */
static void edit_reference(editing *edit, const cs_xml_tag *tag, const char *at)
{
    const int is_instance = cs_xml_is(tag, "instance_controller");
    const part name = value_of(tag, is_instance ? "url" : "source");
    const morph *target = morph_called(edit, name);
    if (target == NULL) return;
    if (!is_instance) {
        copy(edit, name.at, name.at + name.length);
        put(edit, target->source.at, target->source.length);
        return;
    }
    copy(edit, tag->begin, at);
    put(edit, "<instance_geometry url=\"", 24);
    put(edit, target->source.at, target->source.length);
    put(edit, tag->is_empty ? "\"/>" : "\">", tag->is_empty ? 3 : 2);
    edit->is_renaming = !tag->is_empty;
}

static void edit_end(editing *edit, const cs_xml_tag *tag, const char *at)
{
    if (cs_xml_is(tag, "ph")) {
        copy(edit, tag->begin, at);
        edit->in_holes = 0;
    } else if (edit->is_renaming && cs_xml_is(tag, "instance_controller")) {
        copy(edit, tag->begin, at);
        put(edit, "</instance_geometry>", 20);
        edit->is_renaming = 0;
    }
}

static void edit_tag(editing *edit, const cs_xml_tag *tag, const char **at)
{
    if (tag->closes) {
        edit_end(edit, tag, *at);
    } else if (cs_xml_is(tag, "color") && !tag->is_empty) {
        const char *end = *at + strcspn(*at, "<");
        if (count_numbers(*at, end) != 3) return;
        copy(edit, end, end);
        put(edit, " 1", 2);
    } else if (cs_xml_is(tag, "ph") && !tag->is_empty) {
        copy(edit, tag->begin, *at);
        edit->in_holes = 1;
    } else if (cs_xml_is(tag, "h") && edit->in_holes) {
        edit->lost.holes += (size_t)leave_out(edit, tag, "</h>", at);
    } else if (cs_xml_is(tag, "controller") && morph_called(edit, value_of(tag, "id")) != NULL) {
        edit->lost.morphs += (size_t)leave_out(edit, tag, "</controller>", at);
    } else if (cs_xml_is(tag, "skin") || cs_xml_is(tag, "instance_controller")) {
        edit_reference(edit, tag, *at);
    }
}

clshear_status cs_collada_edit(cs_bytes *bytes, cs_collada_losses *lost, cs_error *error)
{
    editing edit = {.text.item_size = 1, .morphs.item_size = sizeof(morph), .copied = bytes->data};
    const char *at = bytes->data;
    cs_xml_tag tag;
    *lost = (cs_collada_losses){0};
    if (strlen(bytes->data) != bytes->size) return CLSHEAR_OK;
    find_morphs(&edit, bytes->data);
    while (!edit.is_full && cs_xml_next(&at, &tag))
        edit_tag(&edit, &tag, &at);
    const char *end = bytes->data + bytes->size;
    copy(&edit, end + 1, end); /* with the final 0 */
    cs_array_free(&edit.morphs);
    if (edit.is_full) {
        cs_array_free(&edit.text);
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    }
    *lost = edit.lost;
    cs_bytes_free(bytes);
    *bytes = (cs_bytes){edit.text.items, edit.text.count - 1};
    return CLSHEAR_OK;
}
