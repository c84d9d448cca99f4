#include "helper/three_mf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "helper/xml.h"

int cs_is_3mf(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && strcasecmp(dot, ".3mf") == 0;
}

static void begin(mf_reader *reader)
{
    cs_index_map_init(&reader->parts, CS_MATERIAL_NAME);
    cs_index_map_init(&reader->ids, sizeof(mf_id));
    reader->numbers.item_size = sizeof(size_t);
    reader->objects.item_size = sizeof(mf_object);
    reader->vertices.item_size = sizeof(double[3]);
    reader->triangles.item_size = sizeof(mf_triangle);
    reader->components.item_size = reader->items.item_size = sizeof(mf_component);
    reader->groups.item_size = sizeof(mf_group);
    reader->colours.item_size = sizeof(mf_colour);
}

static void end(mf_reader *reader)
{
    cs_array *arrays[] = {&reader->numbers,    &reader->objects, &reader->vertices,
                          &reader->triangles,  &reader->items,   &reader->groups,
                          &reader->components, &reader->colours};
    cs_index_map_free(&reader->parts);
    cs_index_map_free(&reader->ids);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        cs_array_free(arrays[i]);
}

static clshear_status read_entry(const mf_reader *reader, const char *name, cs_bytes *text)
{
    cs_zip_entry entry;
    const char *path = reader->model->path;
    if (!cs_zip_find(&reader->zip, name, &entry))
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: \"%s\" is not in it", path, name);
    clshear_status status = cs_zip_read(&reader->zip, &entry, path, text, reader->error);
    return status == CLSHEAR_OK ? cs_bytes_to_utf8(text, path, reader->error) : status;
}

/* Whether a relationship names the part that is to be built; `name` gets it. */
static int names_root(const cs_xml_tag *tag, char name[CS_MATERIAL_NAME])
{
    static const char end_of_type[] = "/3dmodel";
    const size_t tail = sizeof end_of_type - 1;
    size_t length, size;
    const char *type = cs_xml_value(tag, "Type", &length);
    if (type == NULL || length < tail || memcmp(type + length - tail, end_of_type, tail) != 0)
        return 0;
    const char *target = cs_xml_value(tag, "Target", &size);
    if (target == NULL || size >= CS_MATERIAL_NAME) return 0;
    memset(name, 0, CS_MATERIAL_NAME);
    memcpy(name, target, size);
    return 1;
}

/* The name of the root part, by the relationships of the archive, or the usual one. */
static clshear_status find_root(const mf_reader *reader, char name[CS_MATERIAL_NAME])
{
    cs_zip_entry entry;
    cs_bytes text = {0};
    cs_xml_tag tag;
    memset(name, 0, CS_MATERIAL_NAME);
    snprintf(name, CS_MATERIAL_NAME, "/3D/3dmodel.model");
    if (!cs_zip_find(&reader->zip, "_rels/.rels", &entry)) return CLSHEAR_OK;
    const clshear_status status = read_entry(reader, "_rels/.rels", &text);
    const char *at = text.data;
    while (status == CLSHEAR_OK && cs_xml_next(&at, &tag) && !names_root(&tag, name)) {
    }
    cs_bytes_free(&text);
    return status;
}

/* Reads the root part, and then those that others name. */
static clshear_status read_parts(mf_reader *reader)
{
    char name[CS_MATERIAL_NAME];
    clshear_status status = find_root(reader, name);
    if (status != CLSHEAR_OK) return status;
    if (cs_index_map_add(&reader->parts, name) == UINT32_MAX)
        return cs_model_full(reader->model, reader->error);
    for (size_t i = 0; i < reader->parts.keys.count && status == CLSHEAR_OK; i++) {
        cs_bytes text = {0};
        memcpy(name, (const char(*)[CS_MATERIAL_NAME])reader->parts.keys.items + i, sizeof name);
        reader->part = (long long)i;
        status = read_entry(reader, name, &text);
        if (status == CLSHEAR_OK) status = mf_read_part(reader, text.data);
        cs_bytes_free(&text);
    }
    return status;
}

clshear_status cs_read_3mf(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    mf_reader reader = {.model = model, .error = error};
    if (!cs_zip_open(bytes->data, bytes->size, &reader.zip))
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: is no ZIP archive, as a 3MF file is, or it was cut", model->path);
    model->z_up = 1;
    begin(&reader);
    clshear_status status = read_parts(&reader);
    if (status == CLSHEAR_OK) status = mf_build(&reader);
    end(&reader);
    return status;
}
