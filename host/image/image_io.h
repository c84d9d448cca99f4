/* Reads textures and pictures, and writes pictures. What is behind this C interface is the only
 * code that uses OpenImageIO. */
#ifndef CS_IMAGE_IMAGE_IO_H
#define CS_IMAGE_IMAGE_IO_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "image/texel_kinds.h"
#include "image/tone.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Texels in the device's layout: 4 IEEE halves each, linear Rec.709 and alpha, rows from the top.
 */
typedef struct cs_texels {
    uint32_t width;
    uint32_t height;
    uint16_t *halves; /* 4 a texel; owned */
} cs_texels;

/* Reads an image file, or where `memory` is not NULL the `size` bytes of one; `label` is what
 * messages call it. Colours are not multiplied by alpha, which is 1 where the file has none. Images
 * of integers are taken as sRGB unless they say otherwise, or are no colours. */
clshear_status cs_image_read_texels(const char *path, const char *label, const void *memory,
                                    size_t size, const cs_texel_use *use, cs_texels *texels,
                                    cs_error *error);

/* Reads the linear luminance of an image, with negative values clamped to 0, reduced to at most
 * `most` texels a side. The caller frees `luminance` with free(). */
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

/* A metadata entry of a file. */
typedef struct cs_attribute {
    char name[48];
    cs_attribute_kind kind;
    char *text;
    int32_t integer;
    float numbers[16]; /* one number, or a 4 x 4 matrix for row vectors */
} cs_attribute;

/* Float planes of equal size: a window of a larger image. */
typedef struct cs_picture {
    int width;
    int height;
    int x; /* left edge of the window in the full image, px */
    int y;
    int full_width;
    int full_height;
    size_t channel_count;
    const char *const *names;
    const float *const *planes;
    size_t attribute_count;
    const cs_attribute *attributes;
    cs_tone tone; /* for formats other than .exr */
} cs_picture;

/* A picture with the memory it owns. Initialise to zero. */
typedef struct cs_loaded_picture {
    cs_picture picture;
    char (*names)[32];
    float *pixels;
    const char **name_list;
    const float **plane_list;
    cs_attribute *attributes; /* text, integer and float metadata of the file */
} cs_loaded_picture;

/* Reads all channels of an EXR file as floats; no other format. */
clshear_status cs_image_read(const char *path, cs_loaded_picture *loaded, cs_error *error);
void cs_image_free(cs_loaded_picture *loaded);

/* Whether the extension of `path` names a format that can be written, and holds a picture of this
 * size: JPEG has 16 bits for it. */
clshear_status cs_image_check(const char *path, int width, int height, cs_error *error);

/* Writes .exr with all planes as float32, or other formats with the planes R, G, B under `tone`
 * and the sRGB curve (8 bits; TIFF 16). The file appears under its name only when it is complete.
 */
clshear_status cs_image_write(const char *path, const cs_picture *picture, cs_error *error);

#ifdef __cplusplus
}
#endif

#endif
