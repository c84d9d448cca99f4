/* Contexts: the device, what was made for it, and where messages go. */
#ifndef CS_CONTEXT_CONTEXT_H
#define CS_CONTEXT_CONTEXT_H

#include "base/status.h"
#include "clshear/device/sampler/pattern.h"
#include "device/device.h"

/* Tables of patterns on the device, used last at the end: more than the batches of a render, which
 * keep theirs meanwhile. Making one may take seconds. */
enum {
    CS_TABLES = 32
};

typedef struct cs_table_cache {
    cs_pattern pattern[CS_TABLES];
    cs_buffer *rows[CS_TABLES];
    int count;
} cs_table_cache;

/* The pattern's table; owned by the cache. */
clshear_status cs_table_cache_find(cs_table_cache *tables, cs_device *device,
                                   const cs_pattern *pattern, const cs_buffer **rows,
                                   cs_error *error);
void cs_table_cache_free(cs_table_cache *tables);

struct clshear_context {
    cs_error error;
    cs_log log;
    cs_device *device;
    cs_table_cache tables;
    int threads;
    size_t page_bytes; /* of one buffer of pixels at most; OpenCL devices have 128 MB at least */
};

#endif
