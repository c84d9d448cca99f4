#include "context/environments.h"

#include <stdlib.h>
#include <string.h>

#include "clshear/device/hash.h"
#include "scene/environment.h"

void cs_environment_cache_init(cs_environment_cache *cache)
{
    pthread_mutex_init(&cache->lock, NULL);
}

static void clear(cs_environment_cache *cache)
{
    free(cache->path);
    cs_buffer_free(cache->image);
    cache->path = NULL;
    cache->image = NULL;
}

void cs_environment_cache_free(cs_environment_cache *cache)
{
    clear(cache);
    pthread_mutex_destroy(&cache->lock);
}

static cs_u32 fingerprint_of(const cs_array *texels)
{
    const cs_u32 *words = texels->items;
    cs_u32 fingerprint = 0;
    for (size_t i = 0; i < texels->count * texels->item_size / sizeof *words; i++)
        fingerprint = cs_key(fingerprint, words[i]);
    return fingerprint;
}

static clshear_status make(cs_device *device, const char *text, cs_light *light, cs_buffer **image,
                           cs_u32 *fingerprint, cs_error *error)
{
    cs_environment made = {0};
    clshear_status status = cs_environment_read(text, &made, error);
    const cs_array *texels = &made.image;
    if (status == CLSHEAR_OK && texels->count > 0)
        status = cs_buffer_create(device, texels->count * texels->item_size, texels->items, image,
                                  error);
    *light = made.light;
    *fingerprint = fingerprint_of(texels);
    cs_environment_free(&made);
    return status;
}

/* Whether the cache has this file as it is now. */
static int is_kept(const cs_environment_cache *cache, const char *path, const struct stat *file)
{
    const struct stat *kept = &cache->file;
    return cache->path != NULL && strcmp(cache->path, path) == 0 && kept->st_dev == file->st_dev &&
           kept->st_ino == file->st_ino && kept->st_size == file->st_size &&
           kept->st_mtim.tv_sec == file->st_mtim.tv_sec &&
           kept->st_mtim.tv_nsec == file->st_mtim.tv_nsec;
}

static void keep(cs_environment_cache *cache, const char *path, const struct stat *file,
                 const cs_light *light, cs_buffer *image, cs_u32 fingerprint)
{
    clear(cache);
    cache->path = strdup(path); /* NULL: nothing is kept */
    cache->file = *file;
    cache->light = *light;
    cache->image = cs_buffer_retain(image);
    cache->fingerprint = fingerprint;
}

clshear_status cs_environment_cache_find(cs_environment_cache *cache, cs_device *device,
                                         const char *text, cs_light *light, cs_buffer **image,
                                         cs_u32 *fingerprint, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    struct stat file;
    *image = NULL;
    if (stat(text, &file) != 0) return make(device, text, light, image, fingerprint, error);
    pthread_mutex_lock(&cache->lock); /* held while it is read: others may want the same */
    if (is_kept(cache, text, &file)) {
        *light = cache->light;
        *image = cs_buffer_retain(cache->image);
        *fingerprint = cache->fingerprint;
    } else {
        status = make(device, text, light, image, fingerprint, error);
        if (status == CLSHEAR_OK && *image != NULL)
            keep(cache, text, &file, light, *image, *fingerprint);
    }
    pthread_mutex_unlock(&cache->lock);
    return status;
}
