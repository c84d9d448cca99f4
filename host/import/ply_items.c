#include "import/ply_items.h"

#include <math.h>

#include "import/colour.h"

clshear_status cs_ply_complain(const cs_ply_reader *reader, const cs_ply_element *element,
                               size_t item, const char *what)
{
    const char *path = reader->model->path;
    size_t line = 1;
    if (reader->head.format != CS_PLY_ASCII)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: %s %zu of %zu: %s", path,
                       element->name, item, element->count, what);
    for (const char *at = reader->cursor.begin; at != reader->cursor.at; at++)
        line += *at == '\n';
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%zu: %s %zu of %zu: %s", path, line,
                   element->name, item, element->count, what);
}

static clshear_status ends(const cs_ply_reader *reader, const cs_ply_element *element, size_t item)
{
    return cs_ply_complain(
        reader, element, item,
        reader->cursor.at == reader->cursor.row ? "its line has fewer numbers than the head says"
        : reader->cursor.at == reader->cursor.end || reader->head.format != CS_PLY_ASCII
            ? "the file ends here; it was cut"
            : "this is not a number");
}

int cs_ply_colour(const cs_ply_scalars *given, float *colour)
{
    if (!given->is_there[CS_PLY_RED] || !given->is_there[CS_PLY_GREEN] ||
        !given->is_there[CS_PLY_BLUE])
        return 0;
    for (int c = 0; c < 3; c++) {
        const cs_ply_type type = given->type[CS_PLY_RED + c];
        const double value = given->value[CS_PLY_RED + c] / cs_ply_most(type);
        colour[c] = cs_colour_value(value, cs_ply_is_integer(type));
    }
    return 1;
}

/* ----- Lists ----- */

static clshear_status read_list(cs_ply_reader *reader, const cs_ply_element *element, size_t item,
                                const cs_ply_property *property)
{
    double count;
    if (!cs_ply_next(&reader->cursor, property->count_type, &count))
        return ends(reader, element, item);
    const size_t least = cs_ply_least_size(reader->head.format, property->type);
    const size_t left = (size_t)(reader->cursor.end - reader->cursor.at) / least;
    if (!(count >= 0.0 && count == floor(count)))
        return cs_ply_complain(reader, element, item, "a list has no length of 0 or more");
    if (count > (double)left)
        return cs_ply_complain(reader, element, item, "a list is longer than the rest of the file");
    const int is_indices = property->role == CS_PLY_INDICES;
    const int is_text = property->role == CS_PLY_COORDINATES;
    for (size_t i = 0; i < (size_t)count; i++) {
        double value;
        if (!cs_ply_next(&reader->cursor, property->type, &value))
            return ends(reader, element, item);
        if (is_indices) {
            cs_corner *corner = cs_array_extend(&reader->corners, 1);
            if (corner == NULL) return cs_model_full(reader->model, reader->error);
            const int usable = value >= 0.0 && value < (double)CS_MODEL_MOST;
            *corner = (cs_corner){usable ? (uint32_t)value : CS_NO_INDEX, CS_NO_INDEX, CS_NO_INDEX};
        } else if (is_text) {
            double *text = cs_array_extend(&reader->texts, 1);
            if (text == NULL) return cs_model_full(reader->model, reader->error);
            *text = value;
        }
    }
    return CLSHEAR_OK;
}

clshear_status cs_ply_read_item(cs_ply_reader *reader, const cs_ply_element *element, size_t item,
                                cs_ply_scalars *given)
{
    reader->corners.count = reader->texts.count = 0;
    cs_ply_begin_row(&reader->cursor);
    for (size_t p = 0; p < element->property_count; p++) {
        const cs_ply_property *property = &element->properties[p];
        double value;
        if (property->count_type != CS_PLY_NO_TYPE) {
            clshear_status status = read_list(reader, element, item, property);
            if (status != CLSHEAR_OK) return status;
            continue;
        }
        if (!cs_ply_next(&reader->cursor, property->type, &value))
            return ends(reader, element, item);
        if (property->role >= CS_PLY_SCALARS) continue;
        given->value[property->role] = value;
        given->type[property->role] = property->type;
        given->is_there[property->role] = 1;
    }
    reader->is_longer |= cs_ply_end_row(&reader->cursor);
    return CLSHEAR_OK;
}
