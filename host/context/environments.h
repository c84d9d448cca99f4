/* The environment of a context's last renders, so that renders of one scene do not read its file
 * again. */
#ifndef CS_CONTEXT_ENVIRONMENTS_H
#define CS_CONTEXT_ENVIRONMENTS_H

#include <pthread.h>
#include <sys/stat.h>

#include "base/status.h"
#include "device/device.h"
#include "kernels/scene.h"

/* The image that was read last; its path is NULL before the first. */
typedef struct cs_environment_cache {
    pthread_mutex_t lock;
    char *path;
    struct stat file; /* as it was when it was read */
    cs_light light;
    cs_buffer *image;
    cs_u32 fingerprint; /* of the image */
} cs_environment_cache;

void cs_environment_cache_init(cs_environment_cache *cache);
void cs_environment_cache_free(cs_environment_cache *cache);

/* As cs_environment_read, with the image on the device: `image`, NULL for a colour, is freed by
 * cs_buffer_free; `fingerprint`, of what is in it, is 0 for a colour. A file is read again when it
 * has changed since. Any thread may call this. */
clshear_status cs_environment_cache_find(cs_environment_cache *cache, cs_device *device,
                                         const char *text, cs_light *light, cs_buffer **image,
                                         cs_u32 *fingerprint, cs_error *error);

#endif
