/* Public functions that share OpenCL objects with the caller. */
#include "device/opencl.h"

#include "api/arguments.h"
#include "clshear/opencl.h"
#include "context/context.h"
#include "film/film.h"
#include "settings/settings.h"

clshear_status clshear_context_create_from(cl_context cl, cl_device_id device,
                                           cl_command_queue queue, const clshear_settings *settings,
                                           clshear_context **context)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(cl);
    CS_NEEDS(device);
    CS_NEEDS(queue);
    CS_NEEDS(context);
    cs_error *error = cs_thread_error();
    cs_device *adopted;
    const int packet = settings != NULL ? (int)cs_integer(settings, PACKET) : 0;
    const int threads = settings != NULL ? (int)cs_integer(settings, THREADS) : 0;
    clshear_status status = cs_device_adopt(cl, device, queue, packet, &adopted, error);
    if (status != CLSHEAR_OK) return status;
    status = cs_context_create(adopted, threads, context, error);
    if (status != CLSHEAR_OK) cs_device_close(adopted);
    if (status == CLSHEAR_OK)
        (*context)->is_forced = settings != NULL && cs_integer(settings, FORCE) != 0;
    return status;
}

void clshear_context_objects(const clshear_context *context, cl_context *cl, cl_device_id *device,
                             cl_command_queue *queue)
{
    if (context != NULL) cs_device_objects(context->device, cl, device, queue);
}

/* Whether `size` bytes from byte `offset` on are in the buffer. */
static clshear_status check_room(cl_mem buffer, size_t offset, size_t size, const char *channel,
                                 cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    size_t room = 0;
    CS_OPENCL(clGetMemObjectInfo(buffer, CL_MEM_SIZE, sizeof room, &room, NULL),
              "the buffer cannot be used");
    CS_REQUIRE(offset <= room && size <= room - offset, CLSHEAR_BAD_ARGUMENT,
               "the buffer has %zu bytes; channel %s takes %zu from byte %zu on", room, channel,
               size, offset);
done:
    return status;
}

clshear_status clshear_film_copy_to_buffer(clshear_film *film, clshear_context *context,
                                           const char *channel, cl_mem buffer, size_t offset)
{
    CS_PLAIN_FLOATS;
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
    CS_TRY(check_room(buffer, offset, size, channel, error));
    cs_device_objects(context->device, NULL, NULL, &queue);
    CS_OPENCL(clEnqueueWriteBuffer(queue, buffer, CL_TRUE, offset, size, plane, 0, NULL, NULL),
              "channel %s cannot be written to the buffer", channel);
done:
    return cs_message_keep(&film->message, status);
}
