#include "helper/collada_edit.h"

#include <assimp/material.h>
#include <math.h>
#include <string.h>

#include "base/array.h"
#include "base/number.h"
#include "base/pi.h"
#include "base/vec.h"
#include "helper/xml.h"

/* A part of the old text. */
typedef struct part {
    const char *at;
    size_t length;
} part;

/* A controller, of a skin or of morph targets. */
typedef struct controller {
    part id;
    part source; /* the mesh that it changes, or another controller; with its # */
    part matrix; /* of a skin: where the mesh is when it is bound; or empty */
    int is_morph;
} controller;

typedef struct editing {
    cs_array text;      /* char: the new one */
    const char *copied; /* up to here the old text is in the new one, or left out */
    cs_array controllers;
    int is_full;       /* memory ran out */
    int in_holes;      /* within <ph> */
    int is_instance;   /* within an instance of a controller, which becomes one of its mesh */
    const char *moved; /* a tag that is in the new text already; or NULL */
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

static void find_controllers(editing *edit, const char *text)
{
    cs_xml_tag tag;
    controller *last = NULL;
    while (cs_xml_next(&text, &tag)) {
        if (tag.closes) continue;
        if (cs_xml_is(&tag, "controller")) {
            last = cs_array_extend(&edit->controllers, 1);
            edit->is_full |= last == NULL;
            if (last != NULL) *last = (controller){value_of(&tag, "id"), {"", 0}, {"", 0}, 0};
        } else if (last != NULL && (cs_xml_is(&tag, "skin") || cs_xml_is(&tag, "morph"))) {
            last->source = value_of(&tag, "source");
            last->is_morph = cs_xml_is(&tag, "morph");
        } else if (last != NULL && cs_xml_is(&tag, "bind_shape_matrix")) {
            last->matrix = (part){text, strcspn(text, "<")};
        }
    }
}

/* The controller that a reference means, which begins with a #; NULL where it means none. */
static const controller *controller_called(const editing *edit, part name)
{
    const controller *all = edit->controllers.items;
    for (size_t i = 0; i < edit->controllers.count && name.length > 1; i++)
        if (all[i].id.length == name.length - 1 && all[i].source.length > 0 &&
            memcmp(all[i].id.at, name.at + 1, name.length - 1) == 0)
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

/* The place behind an element that `tag` begins and whose content is at `at`; NULL where it does
 * not end. No element is looked for that may hold others of its name. */
static const char *end_of(const cs_xml_tag *tag, const char *at)
{
    cs_xml_tag other;
    if (tag->is_empty) return at;
    while (cs_xml_next(&at, &other))
        if (other.closes && other.length == tag->length &&
            memcmp(other.name, tag->name, tag->length) == 0)
            return at;
    return NULL;
}

/* Leaves out an element; `*at` moves behind it. Returns 0 where it has no content or no end. */
static int leave_out(editing *edit, const cs_xml_tag *tag, const char **at)
{
    const char *end = tag->is_empty ? NULL : end_of(tag, *at);
    if (end == NULL) return 0;
    *at = end;
    copy(edit, tag->begin, *at);
    return 1;
}

static void end_instance(editing *edit)
{
    static const char end[] = "</instance_geometry></node>";
    put(edit, end, sizeof end - 1);
    edit->is_instance = 0;
}

/* An instance of a controller becomes one of its mesh, where that was when it was bound. */
static void edit_instance(editing *edit, const cs_xml_tag *tag, const char *at)
{
    enum {
        MOST = 8 /* controllers on each other */
    };
    static const char node[] = "<node>", matrix[] = "<matrix>", end_of_matrix[] = "</matrix>";
    static const char mesh[] = "<instance_geometry url=\"";
    const controller *first = controller_called(edit, value_of(tag, "url")), *last = first;
    part place = {"", 0};
    if (first == NULL) return;
    for (int i = 0; i < MOST; i++) {
        if (place.length == 0) place = last->matrix;
        edit->lost.morphs += (size_t)last->is_morph;
        const controller *next = controller_called(edit, last->source);
        if (next == NULL) break;
        last = next;
    }
    copy(edit, tag->begin, at);
    put(edit, node, sizeof node - 1);
    if (place.length > 0) {
        put(edit, matrix, sizeof matrix - 1);
        put(edit, place.at, place.length);
        put(edit, end_of_matrix, sizeof end_of_matrix - 1);
    }
    put(edit, mesh, sizeof mesh - 1);
    put(edit, last->source.at, last->source.length);
    put(edit, "\">", 2);
    edit->is_instance = !tag->is_empty;
    if (tag->is_empty) end_instance(edit);
}

/* Reads `count` numbers; 0 where there are fewer. */
static int read_numbers(const char *at, double *numbers, int count)
{
    const char *end = at + strcspn(at, "<");
    for (int i = 0; i < count; i++) {
        while (at < end && (unsigned char)*at <= ' ')
            at++;
        const char *after = cs_parse_number(at, end, &numbers[i]);
        if (after == at) return 0;
        at = after;
    }
    return 1;
}

/* A skew becomes a matrix: Assimp ends the program at it. Points move along the second axis by the
 * tangent of the angle times their distance along the first, as in RenderMan where the axes are at
 * right angles. A right angle moves points to infinity. */
static void edit_skew(editing *edit, const cs_xml_tag *tag, const char **at)
{
    static const char matrix[] = "<matrix>", end_of_matrix[] = "</matrix>";
    double numbers[7] = {0}, *first = numbers + 1, *second = numbers + 4;
    char text[32];
    const int has_numbers = !tag->is_empty && read_numbers(*at, numbers, 7);
    const double scale = cs_vec_dot_double(first, first) * cs_vec_dot_double(second, second);
    const int is_whole = has_numbers && scale > 0.0 && fabs(numbers[0]) < 90.0;
    if (!leave_out(edit, tag, at)) copy(edit, tag->begin, *at);
    edit->lost.skews += !is_whole;
    if (!is_whole) return;
    const double far = tan(numbers[0] * (CS_PI_DOUBLE / 180.0)) / sqrt(scale);
    put(edit, matrix, sizeof matrix - 1);
    for (int i = 0; i < 16; i++) {
        const int row = i / 4, column = i % 4;
        double value = row == column ? 1.0 : 0.0;
        if (row < 3 && column < 3) value += far * second[row] * first[column];
        cs_format_number(text, sizeof text, value, 9);
        put(edit, text, strlen(text));
        put(edit, " ", 1);
    }
    put(edit, end_of_matrix, sizeof end_of_matrix - 1);
}

/* Moves the input of positions to the beginning of <vertices>, whose content is at `at`. Assimp
 * asks for too much memory where positions follow another input. */
static void edit_vertices(editing *edit, const char *at)
{
    const char *inside = at, *first = NULL;
    cs_xml_tag tag;
    while (cs_xml_next(&inside, &tag) && cs_xml_is(&tag, "input")) {
        const part semantic = value_of(&tag, "semantic");
        if (tag.closes) continue;
        if (first == NULL) first = tag.begin;
        if (semantic.length != 8 || memcmp(semantic.at, "POSITION", 8) != 0) continue;
        const char *end = end_of(&tag, inside);
        if (first == tag.begin || end == NULL) return;
        copy(edit, at, at);
        put(edit, tag.begin, (size_t)(end - tag.begin));
        edit->moved = tag.begin;
        return;
    }
}

/* Adds Assimp's default material at the end of the file. Assimp gives meshes without a material the
 * first one in the order of names, which this is, since no XML name begins with an exclamation
 * mark. */
static void add_default(editing *edit, const cs_xml_tag *tag)
{
    static const char material[] =
        "<library_effects><effect id=\"!\"><profile_COMMON><technique><lambert><diffuse>"
        "<color>0.6 0.6 0.6 1</color></diffuse></lambert></technique></profile_COMMON></effect>"
        "</library_effects><library_materials><material id=\"!\" name=\"" AI_DEFAULT_MATERIAL_NAME
        "\"><instance_effect url=\"#!\"/></material></library_materials>";
    copy(edit, tag->begin, tag->begin);
    put(edit, material, sizeof material - 1);
}

static void edit_end(editing *edit, const cs_xml_tag *tag, const char *at)
{
    if (cs_xml_is(tag, "COLLADA")) {
        add_default(edit, tag);
    } else if (cs_xml_is(tag, "ph")) {
        copy(edit, tag->begin, at);
        edit->in_holes = 0;
    } else if (edit->is_instance && cs_xml_is(tag, "instance_controller")) {
        copy(edit, tag->begin, at);
        end_instance(edit);
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
        edit->lost.holes += (size_t)leave_out(edit, tag, at);
    } else if (tag->begin == edit->moved) {
        if (!leave_out(edit, tag, at)) copy(edit, tag->begin, *at);
    } else if (cs_xml_is(tag, "vertices") && !tag->is_empty) {
        edit_vertices(edit, *at);
    } else if (cs_xml_is(tag, "skew")) {
        edit_skew(edit, tag, at);
    } else if (cs_xml_is(tag, "library_controllers")) {
        leave_out(edit, tag, at);
    } else if (cs_xml_is(tag, "instance_controller") && !edit->is_instance) {
        edit_instance(edit, tag, *at);
    }
}

clshear_status cs_collada_edit(cs_bytes *bytes, cs_collada_losses *lost, cs_error *error)
{
    editing edit = {
        .text.item_size = 1, .controllers.item_size = sizeof(controller), .copied = bytes->data};
    const char *at = bytes->data;
    cs_xml_tag tag;
    *lost = (cs_collada_losses){0};
    if (strlen(bytes->data) != bytes->size) return CLSHEAR_OK;
    find_controllers(&edit, bytes->data);
    while (!edit.is_full && cs_xml_next(&at, &tag))
        edit_tag(&edit, &tag, &at);
    const char *end = bytes->data + bytes->size;
    copy(&edit, end + 1, end); /* with the final 0 */
    cs_array_free(&edit.controllers);
    if (edit.is_full) {
        cs_array_free(&edit.text);
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    }
    *lost = edit.lost;
    cs_bytes_free(bytes);
    *bytes = (cs_bytes){edit.text.items, edit.text.count - 1};
    return CLSHEAR_OK;
}
