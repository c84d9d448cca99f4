/* Rendered images: named float planes and metadata. */
#ifndef CS_FILM_FILM_H
#define CS_FILM_FILM_H

#include "base/array.h"
#include "base/message.h"
#include "base/status.h"
#include "clshear/clshear.h"
#include "image/image_io.h"

typedef struct cs_channel {
    char name[24];
    float *pixels; /* width * height */
} cs_channel;

struct clshear_film {
    cs_message message;
    cs_array channels;   /* cs_channel */
    cs_array attributes; /* cs_attribute */
    clshear_film_info info;
    char *path; /* of the file it was read from; NULL: it was made */
};

clshear_status cs_film_create(const int *window, int full_width, int full_height, cs_error *error,
                              clshear_film **film);

/* Reads the channels and the text, integer, float and matrix metadata of an EXR file. */
clshear_status cs_film_read(const char *path, cs_error *error, clshear_film **film);

/* The functions below store the reason of a failure in the calling thread's error. */

/* Name and plane of a channel, or NULL if the film does not have it. */
const char *cs_film_channel_name(const clshear_film *film, size_t index);
const float *cs_film_channel(const clshear_film *film, const char *name);

/* Implement clshear_film_write and clshear_film_write_ratio. */
clshear_status cs_film_write(clshear_film *film, const char *path);
clshear_status cs_film_write_ratio(clshear_film *film, const char *channel, const char *path);
/* Implements clshear_film_copy. */
clshear_status cs_film_copy(const clshear_film *film, const char *const *channels, size_t count,
                            void *target, size_t pixel_stride, size_t row_stride);
void cs_film_free(clshear_film *film);

/* Adds a plane of zeros. Returns NULL when out of memory. */
float *cs_film_add_channel(clshear_film *film, const char *name);

/* A text or number of the metadata; NULL or 0 if the film has none of that name. And the name of
 * text number `index`, or NULL. */
const char *cs_film_text(const clshear_film *film, const char *name);
const char *cs_film_text_name(const clshear_film *film, size_t index);
int cs_film_int(const clshear_film *film, const char *name, int *value);
float cs_film_float(const clshear_film *film, const char *name);

/* Fails unless a caller's line of metadata can have this name: written, and read again. */
clshear_status cs_film_check_name(const clshear_film *film, const char *name);

/* Gives a film the metadata of another. */
clshear_status cs_film_copy_attributes(const clshear_film *from, clshear_film *to);

clshear_status cs_film_annotate(clshear_film *film, const char *name, const char *text);
clshear_status cs_film_set_int(clshear_film *film, const char *name, int32_t value);
clshear_status cs_film_set_float(clshear_film *film, const char *name, float value);
clshear_status cs_film_set_matrix(clshear_film *film, const char *name, const float *matrix);

#endif
