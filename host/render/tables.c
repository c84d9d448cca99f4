/* The context's tables of patterns. */
#include <string.h>

#include "pattern/pattern.h"
#include "render/handles.h"

static int is_same(const cs_pattern *a, const cs_pattern *b)
{
    return a->sampler == b->sampler && a->first == b->first && a->grid.count == b->grid.count;
}

static void drop(cs_tables *tables, int index)
{
    cs_buffer_free(tables->rows[index]);
    tables->count--;
    for (int i = index; i < tables->count; i++) {
        tables->rows[i] = tables->rows[i + 1];
        tables->pattern[i] = tables->pattern[i + 1];
    }
}

clshear_status cs_tables_find(cs_tables *tables, cs_device *device, const cs_pattern *pattern,
                              const cs_buffer **found, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array rows = {0};
    for (int i = 0; i < tables->count; i++)
        if (is_same(&tables->pattern[i], pattern)) {
            *found = tables->rows[i];
            return CLSHEAR_OK;
        }
    if (tables->count == CS_TABLES) drop(tables, 0);
    CS_TRY(cs_rows_make(pattern, CS_ORDER_COHERENT, &rows, error));
    CS_TRY(cs_buffer_create(device, rows.count * rows.item_size, rows.items,
                            &tables->rows[tables->count], error));
    tables->pattern[tables->count] = *pattern;
    *found = tables->rows[tables->count++];
done:
    cs_array_free(&rows);
    return status;
}

void cs_tables_free(cs_tables *tables)
{
    while (tables->count > 0)
        drop(tables, tables->count - 1);
}
