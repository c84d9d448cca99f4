/* Contexts and what they say about themselves. */
#include <stdio.h>
#include <stdlib.h>

#include "context/context.h"
#include "film/film.h"

const char *clshear_version(void)
{
    return CLSHEAR_VERSION;
}

clshear_context_options clshear_context_defaults(void)
{
    return (clshear_context_options){0};
}

clshear_status clshear_context_create(const clshear_context_options *options,
                                      clshear_context **result)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const clshear_context_options defaults = clshear_context_defaults();
    clshear_context *context = calloc(1, sizeof *context);
    if (options == NULL) options = &defaults;
    CS_REQUIRE(context != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_REQUIRE(options->threads >= 0, CLSHEAR_BAD_ARGUMENT,
               "%d threads: must be 0 (all) or a positive number", options->threads);
    context->log = (cs_log){options->warn, options->warn_user};
    context->threads = options->threads;
    context->page_bytes = (size_t)1 << 27;
    CS_TRY(cs_device_open(options->device, options->threads, options->packet, &context->device,
                          error));
    *result = context;
    context = NULL;
done:
    clshear_context_free(context);
    return status;
}

void clshear_context_free(clshear_context *context)
{
    if (context == NULL) return;
    cs_table_cache_free(&context->tables);
    cs_device_close(context->device);
    free(context);
}

clshear_status clshear_film_read(clshear_context *context, const char *path, clshear_film **film)
{
    return cs_film_read(path, &context->error, film);
}

const char *clshear_message(const clshear_context *context)
{
    return context != NULL ? context->error.message : cs_thread_error()->message;
}

clshear_status clshear_list_devices(void (*report)(void *user, int number, const char *name),
                                    void *user)
{
    return cs_device_list(report, user, cs_thread_error());
}

const char *clshear_device_name(const clshear_context *context)
{
    return cs_device_name(context->device);
}

const char *clshear_driver_name(const clshear_context *context)
{
    return cs_device_driver(context->device);
}
