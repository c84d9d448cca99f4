#include "context/context.h"

#include <stdlib.h>

clshear_status cs_context_create(cs_device *device, int threads, clshear_context **result,
                                 cs_error *error)
{
    clshear_context *context = calloc(1, sizeof *context);
    if (context == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    atomic_init(&context->references, 1);
    cs_message_init(&context->message);
    cs_table_cache_init(&context->tables);
    cs_environment_cache_init(&context->environments);
    context->device = device;
    cs_device_set_log(device, &context->log);
    context->threads = threads;
    context->page_bytes = (size_t)1 << 27;
    *result = context;
    return CLSHEAR_OK;
}

clshear_context *cs_context_retain(clshear_context *context)
{
    atomic_fetch_add(&context->references, 1);
    return context;
}

void cs_context_release(clshear_context *context)
{
    if (context == NULL || atomic_fetch_sub(&context->references, 1) > 1) return;
    cs_table_cache_free(&context->tables);
    cs_environment_cache_free(&context->environments);
    cs_device_close(context->device);
    cs_message_destroy(&context->message);
    free(context);
}
