/* Checks and conversions of arguments in public functions. */
#ifndef CS_API_ARGUMENTS_H
#define CS_API_ARGUMENTS_H

#include <stdlib.h>
#include <string.h>

#include "base/floats.h"
#include "base/status.h"

/* Returns from the calling function with an error if `pointer` is NULL. */
#define CS_NEEDS(pointer)                                                                       \
    do {                                                                                        \
        if ((pointer) == NULL)                                                                  \
            return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "%s: %s is NULL", __func__, \
                           #pointer);                                                           \
    } while (0)

/* The same of a file's name, which must have a letter, too. */
#define CS_NEEDS_NAME(path)                                                              \
    do {                                                                                 \
        CS_NEEDS(path);                                                                  \
        if (*(path) == '\0')                                                             \
            return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,                      \
                           "%s: %s is empty: give the name of a file", __func__, #path); \
    } while (0)

/* Copies a versioned struct from the caller. Its size is its first member and may be that of an
 * older or newer version: missing members become zero and unknown ones are ignored. */
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

/* Declares `copy`, a struct that the caller gives by pointer, or fails in the calling function. */
#define CS_TAKE(type, copy, given)                                        \
    type copy;                                                            \
    CS_NEEDS(given);                                                      \
    if (cs_struct_in(&(copy), sizeof(copy), given, #given) != CLSHEAR_OK) \
    return CLSHEAR_BAD_ARGUMENT

/* Copies a versioned struct to the caller, up to the caller's size. The size itself stays
 * unchanged. Without a target nothing is copied. */
static inline void cs_struct_out(void *target, const void *source, size_t size)
{
    if (target == NULL) return;
    size_t target_size;
    memcpy(&target_size, target, sizeof target_size);
    const size_t common = target_size < size ? target_size : size;
    if (common > sizeof target_size)
        memcpy((char *)target + sizeof target_size, (const char *)source + sizeof target_size,
               common - sizeof target_size);
}

/* Returns a heap copy of `made` if `status` is CLSHEAR_OK. Otherwise, or when out of memory,
 * returns NULL and stores the failure in `status`; the caller then frees `made`. */
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

/* Defines hand_over for an object: passes `made` to the caller, or frees it after a failure. */
#define CS_HAND_OVER(object)                                                       \
    static clshear_status hand_over(clshear_status status, clshear_##object *made, \
                                    clshear_##object **result)                     \
    {                                                                              \
        clshear_##object *handle = cs_handle(&status, made, sizeof *made);         \
        if (handle != NULL)                                                        \
            *result = handle;                                                      \
        else                                                                       \
            cs_##object##_free(made);                                              \
        return status;                                                             \
    }

/* Defines a public function that returns a member of an object: 0 or NULL without an object. */
#define CS_GETTER(type, object, member)                              \
    type clshear_##object##_##member(const clshear_##object *object) \
    {                                                                \
        return object != NULL ? object->member : (type)0;            \
    }

/* Defines the public function that frees an object: what is in it, and the object. */
#define CS_FREES(object)                                   \
    void clshear_##object##_free(clshear_##object *object) \
    {                                                      \
        if (object == NULL) return;                        \
        cs_##object##_free(object);                        \
        free(object);                                      \
    }

/* Defines a public function that returns an element of an object's array of `count` elements: 0 or
 * NULL past the last one, or without an object. */
#define CS_GETTER_AT(type, object, name, member, count)                                   \
    type clshear_##object##_##name(const clshear_##object *object, size_t index)          \
    {                                                                                     \
        return object != NULL && index < object->count ? object->member[index] : (type)0; \
    }

#endif
