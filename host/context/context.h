/* Contexts: the device, and what was made for it. */
#ifndef CS_CONTEXT_CONTEXT_H
#define CS_CONTEXT_CONTEXT_H

#include <stdatomic.h>

#include "base/message.h"
#include "base/status.h"
#include "clshear/device/sampler/pattern.h"
#include "context/environments.h"
#include "device/device.h"

/* Most sample tables that are kept on the device: more than the batches of a render. Making one may
 * take seconds. */
enum {
    CS_TABLES = 32
};

/* Sample tables of patterns; the one used last is at the end. */
typedef struct cs_table_cache {
    pthread_mutex_t lock;
    cs_pattern pattern[CS_TABLES];
    cs_buffer *rows[CS_TABLES];
    int count;
} cs_table_cache;

/* The pattern's table; the caller frees it by cs_buffer_free. Any thread may call this. */
clshear_status cs_table_cache_find(cs_table_cache *tables, cs_device *device,
                                   const cs_pattern *pattern, cs_buffer **rows, cs_error *error);
void cs_table_cache_init(cs_table_cache *tables);
void cs_table_cache_free(cs_table_cache *tables);

struct clshear_context {
    atomic_int references; /* of the user and of the scenes */
    cs_message message;
    cs_log log;
    cs_device *device;
    cs_table_cache tables;
    cs_environment_cache environments;
    int threads;
    int is_forced;        /* whether a device is used that fails its test */
    atomic_int is_tested; /* whether it has passed, or is forced */
    size_t page_bytes; /* most bytes of one buffer of pixels; OpenCL devices have 128 MB at least */
};

/* Makes a context that takes over the device. */
clshear_status cs_context_create(cs_device *device, int threads, clshear_context **context,
                                 cs_error *error);

/* Each retain is undone by a release; the last one frees the context. */
clshear_context *cs_context_retain(clshear_context *context);
void cs_context_release(clshear_context *context);

#endif
