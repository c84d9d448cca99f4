/* Public functions that share OpenCL objects with the caller. */
#include "device/opencl.h"

#include "api/arguments.h"
#include "clshear/opencl.h"
#include "context/context.h"
#include "film/film.h"
#include "settings/settings.h"

clshear_status clshear_context_create_from(cl_context cl, cl_device_id id, cl_command_queue queue,
                                           const clshear_settings *settings,
                                           clshear_context **context)
{
    CS_NEEDS(cl);
    CS_NEEDS(id);
    CS_NEEDS(queue);
    CS_NEEDS(context);
    cs_error *error = cs_thread_error();
    cs_device *device;
    const int packet = settings != NULL ? (int)cs_integer(settings, PACKET) : 0;
    const int threads = settings != NULL ? (int)cs_integer(settings, THREADS) : 0;
    clshear_status status = cs_device_adopt(cl, id, queue, packet, &device, error);
    if (status != CLSHEAR_OK) return status;
    status = cs_context_create(device, threads, context, error);
    if (status != CLSHEAR_OK) cs_device_close(device);
    if (status == CLSHEAR_OK)
        (*context)->is_forced = settings != NULL && cs_integer(settings, FORCE) != 0;
    return status;
}

void clshear_context_objects(const clshear_context *context, cl_context *cl, cl_device_id *device,
                             cl_command_queue *queue)
{
    if (context != NULL) cs_device_objects(context->device, cl, device, queue);
}

clshear_status clshear_film_copy_to_buffer(clshear_film *film, clshear_context *context,
                                           const char *channel, cl_mem buffer, size_t offset)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    cl_command_queue queue;
    CS_NEEDS(film);
    CS_NEEDS(context);
    CS_NEEDS(channel);
    CS_NEEDS(buffer);
    const float *plane = cs_film_channel(film, channel);
    const size_t size = (size_t)film->info.width * (size_t)film->info.height * sizeof *plane;
    CS_REQUIRE(plane != NULL, CLSHEAR_BAD_ARGUMENT, "the film has no channel %s", channel);
    cs_device_objects(context->device, NULL, NULL, &queue);
    CS_OPENCL(clEnqueueWriteBuffer(queue, buffer, CL_TRUE, offset, size, plane, 0, NULL, NULL),
              "channel %s cannot be written to the buffer", channel);
done:
    return cs_message_keep(&film->message, status);
}
