/* Contexts: the device, what was made for it, and where messages go. */
#ifndef CS_CONTEXT_CONTEXT_H
#define CS_CONTEXT_CONTEXT_H

#include "base/status.h"
#include "device/device.h"
#include "sampler/pattern.h"

/* Tables of patterns on the device, used last at the end: more than the batches of a render, which
 * keep theirs meanwhile. Making one may take seconds. */
enum {
    CS_TABLES = 32
};

typedef struct cs_tables {
    cs_pattern pattern[CS_TABLES];
    cs_buffer *rows[CS_TABLES];
    int count;
} cs_tables;

/* The pattern's table; owned by the cache. */
clshear_status cs_tables_find(cs_tables *tables, cs_device *device, const cs_pattern *pattern,
                              const cs_buffer **rows, cs_error *error);
void cs_tables_free(cs_tables *tables);

struct clshear_context {
    cs_error error;
    cs_log log;
    cs_device *device;
    cs_tables tables;
    int threads;
    size_t page_bytes; /* of one buffer of pixels at most; OpenCL devices have 128 MB at least */
};

#endif
