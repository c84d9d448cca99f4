/* The context's tables of patterns. */
#include <string.h>

#include "context/context.h"
#include "pattern/pattern.h"

static int is_same(const cs_pattern *a, const cs_pattern *b)
{
    return a->sampler == b->sampler && a->first == b->first && a->grid.count == b->grid.count &&
           memcmp(a->shape, b->shape, sizeof a->shape) == 0;
}

/* Takes an entry out and closes the gap. */
static void remove_entry(cs_table_cache *tables, int index)
{
    tables->count--;
    for (int i = index; i < tables->count; i++) {
        tables->rows[i] = tables->rows[i + 1];
        tables->pattern[i] = tables->pattern[i + 1];
    }
}

static void drop(cs_table_cache *tables, int index)
{
    cs_buffer_free(tables->rows[index]);
    remove_entry(tables, index);
}

static void append(cs_table_cache *tables, const cs_pattern *pattern, cs_buffer *rows)
{
    if (tables->count == CS_TABLES) drop(tables, 0);
    tables->pattern[tables->count] = *pattern;
    tables->rows[tables->count++] = rows;
}

/* Takes the pattern's table out of the cache; NULL if it is not there. */
static cs_buffer *take(cs_table_cache *tables, const cs_pattern *pattern)
{
    for (int i = 0; i < tables->count; i++)
        if (is_same(&tables->pattern[i], pattern)) {
            cs_buffer *found = tables->rows[i];
            remove_entry(tables, i);
            return found;
        }
    return NULL;
}

static clshear_status make(cs_device *device, const cs_pattern *pattern, cs_buffer **buffer,
                           cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array rows = {0};
    CS_TRY(cs_sample_table_make(pattern, CS_ORDER_COHERENT, &rows, error));
    CS_TRY(cs_buffer_create(device, rows.count * rows.item_size, rows.items, buffer, error));
done:
    cs_array_free(&rows);
    return status;
}

clshear_status cs_table_cache_find(cs_table_cache *tables, cs_device *device,
                                   const cs_pattern *pattern, cs_buffer **found, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    pthread_mutex_lock(&tables->lock); /* held while one is made: others may want the same */
    cs_buffer *buffer = take(tables, pattern);
    if (buffer == NULL) status = make(device, pattern, &buffer, error);
    if (status == CLSHEAR_OK) {
        append(tables, pattern, buffer);
        *found = cs_buffer_retain(buffer);
    }
    pthread_mutex_unlock(&tables->lock);
    return status;
}

void cs_table_cache_init(cs_table_cache *tables)
{
    pthread_mutex_init(&tables->lock, NULL);
}

void cs_table_cache_free(cs_table_cache *tables)
{
    while (tables->count > 0)
        drop(tables, tables->count - 1);
    pthread_mutex_destroy(&tables->lock);
}
