/* Faces of OBJ files. */
#include <string.h>

#include "import/obj_reader.h"

typedef struct obj_face {
    size_t first; /* corner */
    size_t count;
    size_t line;
    uint32_t material;
    uint32_t group;
} obj_face;

enum {
    PLACES = 3 /* of a corner: position, texture coordinate, normal */
};

static const char *const place_names[PLACES] = {"vertex", "texture coordinate", "normal"};

void cs_obj_begin(obj_reader *reader)
{
    cs_index_map_init(&reader->used, CS_MATERIAL_NAME);
    cs_index_map_init(&reader->libraries, CS_MATERIAL_NAME);
    reader->defined.item_size = sizeof(cs_material_description);
    reader->corners.item_size = sizeof(cs_corner);
    reader->waiting.item_size = sizeof(obj_face);
    reader->waiting_corners.item_size = sizeof(cs_corner);
}

void cs_obj_end(obj_reader *reader)
{
    cs_index_map_free(&reader->used);
    cs_index_map_free(&reader->libraries);
    cs_array_free(&reader->defined);
    cs_array_free(&reader->corners);
    cs_array_free(&reader->waiting);
    cs_array_free(&reader->waiting_corners);
}

static size_t count_of(const cs_model *model, int place)
{
    const cs_array *pools[PLACES] = {&model->positions, &model->textures, &model->normals};
    return pools[place]->count;
}

static uint32_t *place_of(cs_corner *corner, int place)
{
    uint32_t *places[PLACES] = {&corner->position, &corner->texture, &corner->normal};
    return places[place];
}

static clshear_status out_of_range(const obj_reader *reader, size_t line, int place,
                                   long long number)
{
    if (count_of(reader->model, place) == 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s:%zu: the face names %s %lld, but there are none", reader->model->path,
                       line, place_names[place], number);
    return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                   "%s:%zu: the face names %s %lld, but there are %zu; must be 1 to %zu, or "
                   "negative to count backwards",
                   reader->model->path, line, place_names[place], number,
                   count_of(reader->model, place), count_of(reader->model, place));
}

/* One number of a corner, from 1 or backwards from -1. */
static clshear_status resolve(const obj_reader *reader, long long number, int place,
                              cs_corner *corner)
{
    const long long count = (long long)count_of(reader->model, place);
    if (number == 0 && place > 0) return CLSHEAR_OK; /* programs write it where there is none */
    if (number == 0 || number < -count || number > CS_MODEL_MOST)
        return out_of_range(reader, reader->lines.number, place, number);
    *place_of(corner, place) = (uint32_t)(number > 0 ? number - 1 : count + number);
    return CLSHEAR_OK;
}

/* v, v/vt, v//vn or v/vt/vn */
static clshear_status read_corner(const obj_reader *reader, const char *word, cs_corner *corner)
{
    const char *at = word;
    *corner = (cs_corner){CS_NO_INDEX, CS_NO_INDEX, CS_NO_INDEX};
    for (int place = 0; place < PLACES; place++) {
        long long number;
        if (cs_parse_whole(&at, &number)) {
            const clshear_status status = resolve(reader, number, place, corner);
            if (status != CLSHEAR_OK) return status;
        } else if (place == 0 || (*at != '/' && *at != '\0')) {
            break;
        }
        if (*at == '\0') return CLSHEAR_OK;
        if (*at != '/') break;
        at++;
    }
    return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                   "%s:%zu: \"%.40s\" is no corner of a face; must be like 1, 1/1, 1//1 or 1/1/1",
                   reader->model->path, reader->lines.number, word);
}

/* The first place of the corners that is not there, or PLACES. */
static int missing_place(const cs_model *model, cs_corner *corners, size_t count, uint32_t *number)
{
    for (size_t i = 0; i < count; i++)
        for (int place = 0; place < PLACES; place++) {
            *number = *place_of(&corners[i], place);
            if (*number != CS_NO_INDEX && *number >= count_of(model, place)) return place;
        }
    return PLACES;
}

static clshear_status put_off(obj_reader *reader)
{
    const obj_face face = {reader->waiting_corners.count, reader->corners.count,
                           reader->lines.number, reader->material, reader->group};
    obj_face *added = cs_array_extend(&reader->waiting, 1);
    void *corners = cs_model_extend(&reader->waiting_corners, face.count);
    if (added == NULL || corners == NULL) return cs_model_full(reader->model, reader->error);
    *added = face;
    memcpy(corners, reader->corners.items, face.count * sizeof(cs_corner));
    return CLSHEAR_OK;
}

clshear_status cs_obj_face(obj_reader *reader, char *at)
{
    uint32_t number;
    reader->corners.count = 0;
    for (const char *word = cs_next_word(&at); word != NULL && *word != '#';
         word = cs_next_word(&at)) {
        cs_corner *corner = cs_array_extend(&reader->corners, 1);
        if (corner == NULL) return cs_model_full(reader->model, reader->error);
        const clshear_status status = read_corner(reader, word, corner);
        if (status != CLSHEAR_OK) return status;
    }
    cs_corner *corners = reader->corners.items;
    const size_t count = reader->corners.count;
    if (missing_place(reader->model, corners, count, &number) != PLACES) return put_off(reader);
    return cs_model_add_polygon(reader->model, corners, count, reader->material, reader->group,
                                reader->error);
}

clshear_status cs_obj_waiting_faces(obj_reader *reader)
{
    const obj_face *faces = reader->waiting.items;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < reader->waiting.count && status == CLSHEAR_OK; i++) {
        cs_corner *corners = (cs_corner *)reader->waiting_corners.items + faces[i].first;
        uint32_t number = 0;
        const int place = missing_place(reader->model, corners, faces[i].count, &number);
        if (place != PLACES)
            return out_of_range(reader, faces[i].line, place, (long long)number + 1);
        status = cs_model_add_polygon(reader->model, corners, faces[i].count, faces[i].material,
                                      faces[i].group, reader->error);
    }
    return status;
}
