/* The XML of 3MF files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "helper/three_mf.h"
#include "helper/three_mf_xml.h"
#include "import/colour.h"

static clshear_status full(const mf_reader *reader)
{
    return cs_model_full(reader->model, reader->error);
}

static clshear_status complain(const mf_reader *reader, const mf_xml *xml, const char *name)
{
    return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                   "%s: a <%.40s> in it has no usable \"%s\": line %ld of \"%s\"",
                   reader->model->path, (const char *)xml->tag->name, name, mf_xml_line(xml),
                   mf_part_name(reader));
}

static void leave_out(mf_reader *reader, unsigned bit, const char *what)
{
    if ((reader->left_out & 1u << bit) == 0)
        cs_warn(reader->model->log, "%s: has %s, which %s not supported; left out",
                reader->model->path, what, what[strlen(what) - 1] == 's' ? "are" : "is");
    reader->left_out |= 1u << bit;
}

/* Returns 0 where there is no such attribute, or it is no number and nothing else. */
static int number_of(const mf_xml *xml, const char *name, double *value)
{
    const char *text = mf_xml_value(xml, name);
    if (text == NULL) return 0;
    const char *end = text + strlen(text), *after = cs_parse_number(text, end, value);
    return after != text && after + strspn(after, " \t\r\n") == end;
}

/* A whole number of 0 or more, MF_NONE or MF_WRONG. */
static long long whole_of(const mf_xml *xml, const char *name)
{
    double value;
    if (mf_xml_value(xml, name) == NULL) return MF_NONE;
    if (!number_of(xml, name, &value) || !(value >= 0.0 && value < 4294967295.0)) return MF_WRONG;
    return (double)(long long)value == value ? (long long)value : MF_WRONG;
}

/* The part that a component names, or else the one that is being read; MF_NONE without memory. */
static long long part_of(mf_reader *reader, const mf_xml *xml)
{
    char key[CS_MATERIAL_NAME] = "";
    const char *path = mf_xml_value(xml, "path");
    if (path == NULL) return reader->part;
    snprintf(key, sizeof key, "%s", path);
    const uint32_t number = cs_index_map_add(&reader->parts, key);
    return number == UINT32_MAX ? MF_NONE : (long long)number;
}

/* Notes where something stands in its list; 0 without memory. */
static int remember(mf_places *names, const mf_id *id, size_t place)
{
    const uint32_t number = cs_index_map_add(&names->ids, id);
    if (number == UINT32_MAX) return 0;
    if (number == names->places.count && cs_model_extend(&names->places, 1) == NULL) return 0;
    ((size_t *)names->places.items)[number] = place;
    return 1;
}

/* ----- Colours ----- */

/* A group whose id is no number is one that nothing names. */
static clshear_status begin_group(mf_reader *reader, const mf_xml *xml)
{
    const mf_id id = {reader->part, whole_of(xml, "id")};
    const size_t place = reader->groups.count;
    mf_group *group = cs_model_extend(&reader->groups, 1);
    if (group == NULL) return full(reader);
    *group = (mf_group){reader->colours.count, 0};
    return id.number < 0 || remember(&reader->of_groups, &id, place) ? CLSHEAR_OK : full(reader);
}

/* #RRGGBB or #RRGGBBAA; white where it is anything else. */
static clshear_status add_colour(mf_reader *reader, const mf_xml *xml, const char *name)
{
    mf_group *groups = reader->groups.items;
    const char *text = mf_xml_value(xml, name);
    if (reader->groups.count == 0) return CLSHEAR_OK;
    mf_colour *colour = cs_model_extend(&reader->colours, 1);
    if (colour == NULL) return full(reader);
    groups[reader->groups.count - 1].count++;
    *colour = (mf_colour){{1, 1, 1, 1}, CS_NO_INDEX, "white"};
    if (text == NULL || text[0] != '#') return CLSHEAR_OK;
    const size_t length = strlen(text);
    if (length != 7 && length != 9) return CLSHEAR_OK;
    if (strspn(text + 1, "0123456789abcdefABCDEF") < length - 1) return CLSHEAR_OK;
    snprintf(colour->name, sizeof colour->name, "%s", text);
    for (size_t c = 0; 2 * c + 1 < length; c++) {
        const char digits[3] = {text[1 + 2 * c], text[2 + 2 * c], '\0'};
        const double value = (double)strtoul(digits, NULL, 16) / 255.0;
        colour->value[c] = c < 3 ? cs_colour_value(value, 1) : (float)value;
    }
    return CLSHEAR_OK;
}

/* ----- Objects ----- */

static mf_object *object_of(const mf_reader *reader)
{
    return (mf_object *)reader->objects.items + reader->objects.count - 1;
}

static clshear_status begin_object(mf_reader *reader, const mf_xml *xml)
{
    const mf_id id = {reader->part, whole_of(xml, "id")};
    if (id.number < 0) return complain(reader, xml, "id");
    const size_t place = reader->objects.count;
    mf_object *object = cs_model_extend(&reader->objects, 1);
    if (object == NULL || !remember(&reader->of_objects, &id, place)) return full(reader);
    *object = (mf_object){.id = id,
                          .group = whole_of(xml, "pid"),
                          .colour = whole_of(xml, "pindex"),
                          .first_vertex = reader->vertices.count,
                          .first_triangle = reader->triangles.count,
                          .first_component = reader->components.count};
    reader->is_in_object = !xmlTextReaderIsEmptyElement(xml->reader);
    return CLSHEAR_OK;
}

static clshear_status add_vertex(mf_reader *reader, const mf_xml *xml)
{
    static const char *const names[] = {"x", "y", "z"};
    double *position = cs_model_extend(&reader->vertices, 1);
    if (position == NULL) return full(reader);
    for (int i = 0; i < 3; i++)
        if (!number_of(xml, names[i], &position[i])) return complain(reader, xml, names[i]);
    object_of(reader)->vertices++;
    return CLSHEAR_OK;
}

static clshear_status add_triangle(mf_reader *reader, const mf_xml *xml)
{
    static const char *const vertices[] = {"v1", "v2", "v3"}, *const colours[] = {"p1", "p2", "p3"};
    mf_triangle *triangle = cs_model_extend(&reader->triangles, 1);
    if (triangle == NULL) return full(reader);
    triangle->group = whole_of(xml, "pid");
    for (int i = 0; i < 3; i++) {
        const long long vertex = whole_of(xml, vertices[i]);
        if (vertex < 0) return complain(reader, xml, vertices[i]);
        triangle->vertex[i] = (uint32_t)vertex;
        triangle->colour[i] = whole_of(xml, colours[i]);
        if (triangle->colour[i] == MF_NONE) triangle->colour[i] = triangle->colour[0];
    }
    object_of(reader)->triangles++;
    if (mf_xml_value(xml, "paint_color") != NULL || mf_xml_value(xml, "mmu_segmentation") != NULL)
        leave_out(reader, 0, "paint of a slicer");
    return CLSHEAR_OK;
}

/* An object in its place, for another object or to be built. */
static clshear_status add_component(mf_reader *reader, const mf_xml *xml, cs_array *list)
{
    static const mf_matrix identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
    const mf_id object = {part_of(reader, xml), whole_of(xml, "objectid")};
    if (object.part == MF_NONE) return full(reader);
    if (object.number < 0) return complain(reader, xml, "objectid");
    mf_component *component = cs_model_extend(list, 1);
    if (component == NULL) return full(reader);
    *component = (mf_component){object, identity};
    const char *at = mf_xml_value(xml, "transform");
    const char *end = at != NULL ? at + strlen(at) : NULL;
    for (int i = 0; at != NULL && i < 12; i++) {
        while (at < end && (unsigned char)*at <= ' ')
            at++;
        const char *after = cs_parse_number(at, end, &component->matrix.value[i]);
        if (after == at) return complain(reader, xml, "transform");
        at = after;
    }
    return CLSHEAR_OK;
}

/* ----- Tags ----- */

/* What is left out, by the tag that begins it. */
static const struct {
    const char *tag;
    const char *what;
    unsigned bit; /* of mf_reader.left_out; 0 is the paint's */
    int is_group;
} others[] = {{"texture2dgroup", "textures", 1, 1},
              {"compositematerials", "mixed materials", 2, 1},
              {"multiproperties", "several properties of triangles", 3, 1},
              {"beamlattice", "lattices of beams", 4, 0},
              {"displacementmesh", "displacements", 5, 0},
              {"volumetricstack", "volumes", 6, 0},
              {"volumedata", "volumes", 6, 0}};

static clshear_status take_in_object(mf_reader *reader, const mf_xml *xml)
{
    if (mf_xml_is(xml, "vertex")) return add_vertex(reader, xml);
    if (mf_xml_is(xml, "triangle")) return add_triangle(reader, xml);
    if (!mf_xml_is(xml, "component")) return CLSHEAR_OK;
    object_of(reader)->components++;
    return add_component(reader, xml, &reader->components);
}

static clshear_status take(mf_reader *reader, const mf_xml *xml)
{
    if (xml->closes) {
        if (mf_xml_is(xml, "object")) reader->is_in_object = 0;
        return CLSHEAR_OK;
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (mf_xml_is(xml, others[i].tag)) {
            leave_out(reader, others[i].bit, others[i].what);
            return others[i].is_group ? begin_group(reader, xml) : CLSHEAR_OK;
        }
    if (reader->is_in_object) return take_in_object(reader, xml);
    if (mf_xml_is(xml, "object")) return begin_object(reader, xml);
    if (mf_xml_is(xml, "basematerials") || mf_xml_is(xml, "colorgroup"))
        return begin_group(reader, xml);
    if (mf_xml_is(xml, "base")) return add_colour(reader, xml, "displaycolor");
    if (mf_xml_is(xml, "color")) return add_colour(reader, xml, "color");
    if (mf_xml_is(xml, "item") && reader->part == 0)
        return add_component(reader, xml, &reader->items);
    return CLSHEAR_OK;
}

clshear_status mf_read_part(mf_reader *reader, const cs_bytes *text)
{
    mf_xml xml;
    clshear_status status = CLSHEAR_OK;
    reader->is_in_object = 0;
    if (!mf_xml_open(&xml, text)) return full(reader);
    while (status == CLSHEAR_OK && mf_xml_next(&xml))
        status = take(reader, &xml);
    if (status == CLSHEAR_OK)
        status = mf_xml_end(&xml, reader->model->path, mf_part_name(reader), reader->error);
    mf_xml_close(&xml);
    return status;
}
