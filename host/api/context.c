/* Public functions of contexts. */
#include "context/context.h"
#include "api/arguments.h"
#include "clshear/clshear.h"
#include "settings/settings.h"

/* Device settings of a context. NULL settings: fallbacks. */
typedef struct device_wish {
    const char *name;
    int threads;
    int packet;
} device_wish;

static device_wish wish_of(const clshear_settings *settings)
{
    if (settings == NULL) return (device_wish){0};
    return (device_wish){.name = cs_text(settings, DEVICE),
                         .threads = (int)cs_integer(settings, THREADS),
                         .packet = (int)cs_integer(settings, PACKET)};
}

clshear_status clshear_context_create(const clshear_settings *settings, clshear_context **context)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(context);
    cs_error *error = cs_thread_error();
    const device_wish wish = wish_of(settings);
    cs_device *device;
    clshear_status status = cs_device_open(wish.name, wish.threads, wish.packet, &device, error);
    if (status != CLSHEAR_OK) return status;
    status = cs_context_create(device, wish.threads, context, error);
    if (status != CLSHEAR_OK) cs_device_close(device);
    if (status == CLSHEAR_OK)
        (*context)->is_forced = settings != NULL && cs_integer(settings, FORCE) != 0;
    return status;
}

void clshear_context_free(clshear_context *context)
{
    cs_context_release(context);
}

void clshear_context_set_warning(clshear_context *context,
                                 void (*warn)(void *user, const char *line), void *user)
{
    if (context == NULL) return;
    context->log.warn = warn;
    context->log.user = user;
}

void clshear_context_set_alarm(clshear_context *context,
                               void (*alarm)(void *user, const char *line), void *user)
{
    if (context == NULL) return;
    context->log.alarm = alarm;
    context->log.alarm_user = user;
}

const char *clshear_context_message(const clshear_context *context)
{
    return context != NULL ? cs_message_text(&context->message) : "";
}

const char *clshear_device_name(const clshear_context *context)
{
    return context != NULL ? cs_device_name(context->device) : NULL;
}

const char *clshear_driver_name(const clshear_context *context)
{
    return context != NULL ? cs_device_driver(context->device) : NULL;
}

clshear_status clshear_list_devices(void (*report)(void *user, int number, const char *name),
                                    void *user)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(report);
    return cs_device_list(report, user, cs_thread_error());
}
