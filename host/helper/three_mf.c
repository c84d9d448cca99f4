#include "helper/three_mf.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zip.h>

#include "helper/three_mf_xml.h"

enum {
    MOST_RATIO = 1032 /* of deflate */
};

int cs_is_3mf(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && strcasecmp(dot, ".3mf") == 0;
}

static void begin(mf_reader *reader)
{
    cs_index_map_init(&reader->parts, CS_MATERIAL_NAME);
    cs_index_map_init(&reader->of_objects.ids, sizeof(mf_id));
    cs_index_map_init(&reader->of_groups.ids, sizeof(mf_id));
    reader->of_objects.places.item_size = reader->of_groups.places.item_size = sizeof(size_t);
    reader->objects.item_size = sizeof(mf_object);
    reader->vertices.item_size = sizeof(double[3]);
    reader->triangles.item_size = sizeof(mf_triangle);
    reader->components.item_size = reader->items.item_size = sizeof(mf_component);
    reader->groups.item_size = sizeof(mf_group);
    reader->colours.item_size = sizeof(mf_colour);
}

static void end(mf_reader *reader)
{
    cs_array *arrays[] = {&reader->of_objects.places,
                          &reader->of_groups.places,
                          &reader->objects,
                          &reader->vertices,
                          &reader->triangles,
                          &reader->items,
                          &reader->groups,
                          &reader->components,
                          &reader->colours};
    cs_index_map_free(&reader->parts);
    cs_index_map_free(&reader->of_objects.ids);
    cs_index_map_free(&reader->of_groups.ids);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        cs_array_free(arrays[i]);
}

/* ----- The archive ----- */

/* The bytes stay the caller's. */
static clshear_status open_archive(mf_reader *reader, const cs_bytes *bytes)
{
    zip_error_t flaw;
    zip_error_init(&flaw);
    zip_source_t *source = zip_source_buffer_create(bytes->data, bytes->size, 0, &flaw);
    reader->archive_bytes = bytes->size;
    if (source != NULL) reader->archive = zip_open_from_source(source, ZIP_RDONLY, &flaw);
    if (reader->archive == NULL) zip_source_free(source);
    const int is_full = zip_error_code_zip(&flaw) == ZIP_ER_MEMORY;
    zip_error_fini(&flaw);
    if (reader->archive != NULL) return CLSHEAR_OK;
    if (is_full) return cs_model_full(reader->model, reader->error);
    return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                   "%s: is no ZIP archive, as a 3MF file is, or it was cut", reader->model->path);
}

/* The number of an entry, whatever the case of its name and its first slash; -1 for none. */
static zip_int64_t find_entry(const mf_reader *reader, const char *name)
{
    char slashed[CS_MATERIAL_NAME + 1];
    snprintf(slashed, sizeof slashed, "/%s", name + (*name == '/'));
    const zip_flags_t flags = ZIP_FL_NOCASE | ZIP_FL_ENC_RAW;
    const zip_int64_t plain = zip_name_locate(reader->archive, slashed + 1, flags);
    return plain >= 0 ? plain : zip_name_locate(reader->archive, slashed, flags);
}

/* What keeps an entry from being unpacked; NULL for nothing. */
static const char *flaw_of(const mf_reader *reader, const zip_stat_t *about)
{
    if (about->encryption_method != ZIP_EM_NONE) return "is encrypted; write it plainly";
    if (about->comp_method != ZIP_CM_STORE && about->comp_method != ZIP_CM_DEFLATE)
        return "is packed in a way that is not supported; write it plainly";
    if (about->comp_size > reader->archive_bytes || about->size / MOST_RATIO > about->comp_size)
        return "is damaged, or was cut";
    return about->size < INT_MAX ? NULL
                                 : "has more than 2 GB; write objects into parts of their own";
}

/* Unpacks an entry; 0 where it is damaged. Reading behind its end, libzip tests the checksum. */
static int unpack(zip_t *archive, const zip_stat_t *about, char *data)
{
    zip_file_t *file = zip_fopen_index(archive, about->index, 0);
    if (file == NULL) return 0;
    const zip_int64_t size = zip_fread(file, data, about->size);
    const int is_whole =
        size >= 0 && (zip_uint64_t)size == about->size && zip_fread(file, data + size, 1) == 0;
    zip_fclose(file);
    data[about->size] = '\0';
    return is_whole;
}

static clshear_status read_entry(const mf_reader *reader, const char *name, cs_bytes *text)
{
    zip_stat_t about;
    const char *path = reader->model->path;
    const zip_int64_t number = find_entry(reader, name);
    if (number < 0 || zip_stat_index(reader->archive, (zip_uint64_t)number, 0, &about) != 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: \"%s\" is not in it", path, name);
    const char *flaw = flaw_of(reader, &about);
    char *data = flaw == NULL ? malloc(about.size + 1) : NULL;
    if (flaw == NULL && data == NULL)
        return cs_fail(reader->error, CLSHEAR_OUT_OF_MEMORY,
                       "%s: out of memory for the %zu bytes of \"%s\" in it", path,
                       (size_t)about.size, about.name);
    if (flaw == NULL && !unpack(reader->archive, &about, data)) flaw = "is damaged, or was cut";
    *text = (cs_bytes){data, data != NULL ? (size_t)about.size : 0};
    if (flaw == NULL) return CLSHEAR_OK;
    cs_bytes_free(text);
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: \"%s\" in it %s", path, about.name, flaw);
}

/* ----- Its parts ----- */

const char *mf_part_name(const mf_reader *reader)
{
    return (const char *)reader->parts.keys.items + (size_t)reader->part * CS_MATERIAL_NAME;
}

/* Whether a relationship names the part that is to be built; `name` gets it. */
static int names_root(const mf_xml *xml, char name[CS_MATERIAL_NAME])
{
    static const char end_of_type[] = "/3dmodel";
    const size_t tail = sizeof end_of_type - 1;
    const char *type = mf_xml_value(xml, "Type"), *target = mf_xml_value(xml, "Target");
    if (type == NULL || strlen(type) < tail || strcmp(type + strlen(type) - tail, end_of_type) != 0)
        return 0;
    if (target == NULL || strlen(target) >= CS_MATERIAL_NAME) return 0;
    memset(name, 0, CS_MATERIAL_NAME);
    snprintf(name, CS_MATERIAL_NAME, "%s", target);
    return 1;
}

/* The name of the root part, by the relationships of the archive, or the usual one. */
static clshear_status find_root(const mf_reader *reader, char name[CS_MATERIAL_NAME])
{
    static const char relationships[] = "_rels/.rels";
    cs_bytes text = {0};
    mf_xml xml;
    int found = 0;
    memset(name, 0, CS_MATERIAL_NAME);
    snprintf(name, CS_MATERIAL_NAME, "/3D/3dmodel.model");
    if (find_entry(reader, relationships) < 0) return CLSHEAR_OK;
    clshear_status status = read_entry(reader, relationships, &text);
    if (status != CLSHEAR_OK) return status;
    if (mf_xml_open(&xml, &text)) {
        while (!found && mf_xml_next(&xml))
            found = names_root(&xml, name);
        if (!found) status = mf_xml_end(&xml, reader->model->path, relationships, reader->error);
        mf_xml_close(&xml);
    } else {
        status = cs_model_full(reader->model, reader->error);
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
        if (status == CLSHEAR_OK) status = mf_read_part(reader, &text);
        cs_bytes_free(&text);
    }
    return status;
}

clshear_status cs_read_3mf(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    mf_reader reader = {.model = model, .error = error};
    clshear_status status = open_archive(&reader, bytes);
    if (status != CLSHEAR_OK) return status;
    model->z_up = 1;
    begin(&reader);
    status = read_parts(&reader);
    if (status == CLSHEAR_OK) status = mf_build(&reader);
    end(&reader);
    zip_discard(reader.archive);
    return status;
}
