/* What public functions do with their arguments before they forward them. */
#ifndef CS_API_ARGUMENTS_H
#define CS_API_ARGUMENTS_H

#include <stdlib.h>
#include <string.h>

#include "base/status.h"

/* Fails in the calling function when a pointer that it needs is NULL. */
#define CS_NEEDS(pointer)                                                                       \
    do {                                                                                        \
        if ((pointer) == NULL)                                                                  \
            return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "%s: %s is NULL", __func__, \
                           #pointer);                                                           \
    } while (0)

/* Takes a struct that begins with its size over from a caller that may have an older or a newer
 * version of it: unknown members are left out, missing ones are zero. */
static inline clshear_status cs_struct_in(void *copy, size_t size, const void *given,
                                          const char *name)
{
    size_t given_size;
    memcpy(&given_size, given, sizeof given_size);
    if (given_size <= sizeof given_size)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "%s: struct_size is not set", name);
    memset(copy, 0, size);
    memcpy(copy, given, given_size < size ? given_size : size);
    return CLSHEAR_OK;
}

/* Gives a struct that begins with its size to such a caller, whose size stays. */
static inline void cs_struct_out(void *target, const void *source, size_t size)
{
    size_t target_size;
    memcpy(&target_size, target, sizeof target_size);
    const size_t common = target_size < size ? target_size : size;
    if (common > sizeof target_size)
        memcpy((char *)target + sizeof target_size, (const char *)source + sizeof target_size,
               common - sizeof target_size);
}

/* A handle on the heap with a copy of what was made, once `status` is CLSHEAR_OK. NULL, with the
 * status of the failure, when it is not or when there is no memory: the caller frees what was made.
 */
static inline void *cs_handle(clshear_status *status, const void *made, size_t size)
{
    if (*status != CLSHEAR_OK) return NULL;
    void *handle = malloc(size);
    if (handle == NULL)
        *status = cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory");
    else
        memcpy(handle, made, size);
    return handle;
}

/* A public function that reads one member of an object. */
#define CS_GETTER(type, object, member)                              \
    type clshear_##object##_##member(const clshear_##object *object) \
    {                                                                \
        return object->member;                                       \
    }

/* The same for an element of an array. */
#define CS_GETTER_AT(type, object, name, member)                                 \
    type clshear_##object##_##name(const clshear_##object *object, size_t index) \
    {                                                                            \
        return object->member[index];                                            \
    }

#endif
