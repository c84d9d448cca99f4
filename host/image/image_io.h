/* Reading textures and writing pictures: a C face on OpenImageIO, and the only user of it. */
#ifndef CS_IMAGE_IMAGE_IO_H
#define CS_IMAGE_IMAGE_IO_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Texels as the device reads them: 4 IEEE halves each, linear Rec.709, rows from the top. */
typedef struct cs_texels {
    uint32_t width;
    uint32_t height;
    uint16_t *halves; /* owned; free() */
} cs_texels;

/* Reads an image file, or where `memory` is not NULL the `size` bytes of one that is called `path`
 * in messages. Images of integers are taken as sRGB unless they say otherwise. */
clshear_status cs_image_read_texels(const char *path, const void *memory, size_t size,
                                    cs_texels *texels, cs_error *error);

/* Luminance of an image, linear, negative values as 0, reduced to at most `most` texels a side.
 * `luminance` is owned by the caller; free(). */
clshear_status cs_image_read_luminance(const char *path, int most, float **luminance, int *width,
                                       int *height, cs_error *error);

/* Three linear floats a texel, rows from the top. `colours` is owned by the caller; free(). */
clshear_status cs_image_read_colours(const char *path, float **colours, size_t *width,
                                     size_t *height, cs_error *error);

typedef enum cs_attribute_kind {
    CS_ATTRIBUTE_TEXT,
    CS_ATTRIBUTE_INT,
    CS_ATTRIBUTE_FLOAT,
    CS_ATTRIBUTE_MATRIX
} cs_attribute_kind;

/* One line of metadata. */
typedef struct cs_attribute {
    char name[48];
    cs_attribute_kind kind;
    char *text;
    int32_t integer;
    float numbers[16]; /* the first one, or a matrix, row vectors */
} cs_attribute;

/* Float planes of one size, a window of a larger image. */
typedef struct cs_picture {
    int width;
    int height;
    int x; /* of the window in the full image */
    int y;
    int full_width;
    int full_height;
    size_t channel_count;
    const char *const *names;
    const float *const *planes;
    size_t attribute_count;
    const cs_attribute *attributes;
} cs_picture;

/* A picture read from a file, and what it owns. Start from zeros. */
typedef struct cs_loaded_picture {
    cs_picture picture;
    char (*names)[32];
    float *pixels;
    const char **name_list;
    const float **plane_list;
    cs_attribute *attributes; /* texts, integers and floats of the file */
} cs_loaded_picture;

/* Reads all channels of a picture as floats. */
clshear_status cs_image_read(const char *path, cs_loaded_picture *loaded, cs_error *error);
void cs_image_free(cs_loaded_picture *loaded);

/* Whether the extension of `path` names a format that can be written. */
int cs_image_can_write(const char *path);

/* Writes .exr: all planes in float32. Others: planes R, G, B with the sRGB curve, 8 bits (TIFF 16).
 * The file appears under its name only when it is complete. */
clshear_status cs_image_write(const char *path, const cs_picture *picture, cs_error *error);

#ifdef __cplusplus
}
#endif

#endif
