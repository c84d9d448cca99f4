/* clshear: film, the rendered pixels. */
#ifndef CLSHEAR_FILM_H
#define CLSHEAR_FILM_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_film_info {
    size_t struct_size;
    int width; /* width of the crop, px */
    int height;
    size_t channels;
    int complete;           /* 0: the render was stopped */
    uint64_t samples;       /* camera rays, of all pixels */
    uint64_t shadow_rays;   /* shadow rays of these samples */
    uint64_t pilot_samples; /* samples of the pilots, which are discarded */
    double prepass_s;       /* time for the depths of all pixels */
    double pilot_s;         /* time of the pilots */
    double kernel_s;        /* time on the device, including the pilots */
    double render_s;        /* time of the whole call */
    const char *stopped_by; /* setting that ended a render with rules: "noise", "noise-pixel",
                             * "time", or "spp" where no rule did; NULL: there were none */
    double noise;           /* relative standard error when a rule last looked; 0: none did */
    double noise_pixel;     /* as CLSHEAR_NOISE_PIXEL has it; 0: the rule was not set */
    double spp_expected;    /* samples per pixel that the noise promised would take; 0: unknown, or
                             * the promise is kept */
    uint64_t host_bytes;    /* memory that the render took at its fullest, estimated, */
    uint64_t device_bytes;  /* ... and that on the device; both without the scene */
    int window[4];          /* the crop in the full image: x0 <= x < x1, y0 <= y < y1, px */
    int full_width;         /* of the full image, px */
    int full_height;
} clshear_film_info;

/* Fills in `info`. The caller sets `info->struct_size`. */
CLSHEAR_API void clshear_film_describe(const clshear_film *film, clshear_film_info *info);

/* Name of channel `index`, or NULL past the last one. Owned by the film. The channels:
 *   R G B                 mean radiance
 *   Variance.R/G/B        variance of that mean, from two or more replicates
 *   SampleVariance.R/G/B  variance of one sample
 *   Z                     camera depth at the pixel's centre, infinite without a hit
 *   Z.near, Z.far         nearest and farthest depth of the lens rays
 *   Shear                 shear of the samples, px
 *   CoC                   circle of confusion at the pixel's centre, px
 *   Oracle                rule of the shear: 0 centre, 1 median, 2 near, 3 far, 4 no shear; where
 *                         something moves, the pilot also chooses 5 lens alone, 6 motion alone
 *   Velocity.X/Y          where something moves: velocity on the film of what the pixel's centre
 *                         sees, px while the shutter is open, to the right and down
 *   Samples               number of samples
 *   Gain                  with CLSHEAR_GAIN: variance of small patterns without shear over their
 *                         variance with it, both averaged over 5 x 5 pixels
 *   Albedo.R/G/B ...      with CLSHEAR_AOV: means through lens and pixel, see clshear_aov
 *   Pattern<n>.R/G/B      with CLSHEAR_KEEP_PATTERNS or _EXTENDABLE: mean of replicate n */
CLSHEAR_API const char *clshear_film_channel_name(const clshear_film *film, size_t index);

/* The pixels of a channel, row by row from the top, or NULL if the film does not have it. Owned by
 * the film. */
CLSHEAR_API const float *clshear_film_channel(const clshear_film *film, const char *name);

/* Copies `count` channels of every pixel into the caller's memory. Channel c of pixel (x, y) of the
 * crop is the float at byte y * row_stride + x * pixel_stride + c * sizeof(float). */
CLSHEAR_API clshear_status clshear_film_copy(clshear_film *film, const char *const *channels,
                                             size_t count, void *target, size_t pixel_stride,
                                             size_t row_stride);

/* Mean of the channels Variance.R/G/B over pixels and colours; NaN if they are absent. */
CLSHEAR_API double clshear_film_mean_variance(const clshear_film *film);

/* Adds a line of text to the metadata of written files. Replaces a line of the same name. The name
 * has 1 to 47 bytes and no colon, and is neither a number of the film nor one that EXR keeps for
 * itself, as dataWindow. Names that differ in capitals only are one name in files: the second is
 * refused. An empty text is not written. */
CLSHEAR_API clshear_status clshear_film_annotate(clshear_film *film, const char *name,
                                                 const char *text);

/* A line of text of the metadata: by its name, or NULL if the film has none of it; and the name of
 * line number `index` from 0, or NULL past the last one. Owned by the film. */
CLSHEAR_API const char *clshear_film_text(const clshear_film *film, const char *name);
CLSHEAR_API const char *clshear_film_text_name(const clshear_film *film, size_t index);

/* Reads an EXR written by clshear_film_write. Of its render, clshear_film_describe then has
 * `complete`, `samples` and `render_s`. */
CLSHEAR_API clshear_status clshear_film_read(const char *path, clshear_film **film);

/* Merges `count` films of shards of one render (CLSHEAR_SHARD), or merges of them: means weighted
 * by samples, variances by their counts. Any order gives the same result. It may be merged further,
 * and has complete == 0 while shards are missing. Fails with CLSHEAR_BAD_ARGUMENT for films of
 * different renders, of interrupted ones, and for a shard that comes twice. */
CLSHEAR_API clshear_status clshear_film_merge(const clshear_film *const *films, size_t count,
                                              clshear_film **merged);

/* Prints the shards of a film that are missing, as "2,5-7", truncated to `size` bytes; "" if none
 * are, or if the film is no shard; "?" if what it says of its shards cannot be read. */
CLSHEAR_API void clshear_film_missing(const clshear_film *film, char *text, size_t size);

/* Writes all channels as float32 (.exr), or R G B with the sRGB curve (.png, .jpg, .tif). An
 * existing file is replaced only when the new one is complete. */
CLSHEAR_API clshear_status clshear_film_write(clshear_film *film, const char *path);

/* Whether clshear_film_write can write a picture of this size under a name with this extension, to
 * be asked before a render: JPEG holds at most 65500 pixels a side. */
CLSHEAR_API clshear_status clshear_film_check_path(const char *path, int width, int height);

/* Writes one channel in false colours (.png, .jpg, .tif), on a logarithmic scale from 1/16 (blue)
 * over 1 (white) to 16 (orange). */
CLSHEAR_API clshear_status clshear_film_write_ratio(clshear_film *film, const char *channel,
                                                    const char *path);

/* The message of the last failed call on this object; see clshear_context_message. */
CLSHEAR_API const char *clshear_film_message(const clshear_film *film);
CLSHEAR_API void clshear_film_free(clshear_film *film);

#ifdef __cplusplus
}
#endif

#endif
