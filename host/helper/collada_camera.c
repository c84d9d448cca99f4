#include "helper/collada_camera.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/pi.h"

static const char parallel_tag[] = "<orthographic>", parallel_end[] = "</orthographic>";
static const char spread_tag[] = "<perspective>", spread_end[] = "</perspective>";

/* The element of this name in a text, with or without attributes; NULL: none. */
static char *find(char *text, const char *name)
{
    const size_t length = strlen(name);
    for (char *at = strchr(text, '<'); at != NULL; at = strchr(at + 1, '<'))
        if (strncmp(at + 1, name, length) == 0 && strchr("> \t\r\n", at[1 + length]) != NULL)
            return at;
    return NULL;
}

static void cut(char *from, const char *to)
{
    memmove(from, to, strlen(to) + 1);
}

/* Copies a text to `at`, without its final 0. Returns the place behind the copy. */
static char *put(char *at, const char *text)
{
    while (*text != '\0')
        *at++ = *text++;
    return at;
}

static void remove_element(char *text, const char *name)
{
    char end[32], *element = find(text, name);
    snprintf(end, sizeof end, "</%s>", name);
    const char *closing = element != NULL ? strstr(element, end) : NULL;
    if (closing != NULL) cut(element, closing + strlen(end));
}

/* The names have the same length. */
static void rename_element(char *text, const char *from, const char *to)
{
    char end[32], *element = find(text, from);
    snprintf(end, sizeof end, "</%s>", from);
    char *closing = element != NULL ? strstr(element, end) : NULL;
    if (closing == NULL) return;
    put(element + 1, to);
    put(closing + 2, to);
}

/* A minus before the number of an element, and a short name instead of `parallel_tag`. */
static void mark_parallel(char *block)
{
    cut(block + 2, block + sizeof parallel_tag - 2);
    block[1] = 'o';
    char *closing = strstr(block, parallel_end);
    if (closing != NULL) memcpy(closing, "</o>", sizeof "</o>");
    char *element = find(block, "xmag");
    char *value = element != NULL ? strchr(element, '>') : NULL;
    if (value == NULL) return;
    memmove(value + 2, value + 1, strlen(value + 1) + 1);
    value[1] = '-';
}

/* Edits the description of one camera, from its tag to the end. */
static void edit(char *block)
{
    const int is_parallel = strncmp(block, parallel_tag, sizeof parallel_tag - 1) == 0;
    const char *across = is_parallel ? "xmag" : "xfov", *down = is_parallel ? "ymag" : "yfov";
    if (find(block, down) != NULL) {
        remove_element(block, across);
        remove_element(block, "aspect_ratio");
        rename_element(block, down, across);
    }
    if (is_parallel) mark_parallel(block);
}

/* The next description of a camera, and its `end`; NULL: none that ends. */
static char *next_camera(char *text, char **end)
{
    for (char *at = strchr(text, '<'); at != NULL; at = strchr(at + 1, '<')) {
        const int is_parallel = strncmp(at, parallel_tag, sizeof parallel_tag - 1) == 0;
        if (!is_parallel && strncmp(at, spread_tag, sizeof spread_tag - 1) != 0) continue;
        const char *closing = is_parallel ? parallel_end : spread_end;
        *end = strstr(at, closing);
        if (*end == NULL) return NULL;
        *end += strlen(closing);
        return at;
    }
    return NULL;
}

clshear_status cs_collada_edit_cameras(cs_bytes *bytes, cs_error *error)
{
    char *from = bytes->data, *to = bytes->data, *end = NULL;
    if (strlen(bytes->data) != bytes->size) return CLSHEAR_OK; /* no text */
    for (char *camera; (camera = next_camera(from, &end)) != NULL; from = end) {
        const size_t length = (size_t)(end - camera), before = (size_t)(camera - from);
        char *block = malloc(length + 1);
        if (block == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
        memcpy(block, camera, length);
        block[length] = '\0';
        edit(block);
        memmove(to, from, before);
        to = put(to + before, block);
        free(block);
    }
    memmove(to, from, strlen(from) + 1);
    bytes->size = strlen(bytes->data);
    return CLSHEAR_OK;
}

void cs_collada_extent(const struct aiCamera *source, double scale, cs_model_camera *camera)
{
    const double aspect = source->mAspect > 0.0f ? (double)source->mAspect : 1.0;
    const double degrees = (double)source->mHorizontalFOV * 180.0 / CS_PI_DOUBLE;
    if (degrees >= 0.0) return;
    camera->height = -2.0 * degrees * scale / aspect;
    camera->fov = 1.0; /* any angle that a camera can have */
}
