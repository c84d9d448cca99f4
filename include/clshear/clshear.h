/* clshear: depth of field with sheared samples.
 *
 * The public interface of the library, in the order in which a program uses it: context, scene,
 * camera, render, film; the analysis is in analysis.h, which this file includes. It is
 * plain C and every function is described where it is declared.
 *
 * Conventions
 * - Functions that can fail return a clshear_status; results go to the trailing pointer and are
 * left alone on failure. clshear_message() has the reason, in one line.
 * - Handles are freed by the matching _free, which accepts NULL. A scene and a film must be freed
 *   before their context.
 * - A handle may be used by one thread at a time. Two contexts may live in one process and work at
 *   the same time; load their scene files one after the other, or the messages of two bad files may
 *   mix.
 * - Arrays passed in are copied. Nothing here prints, aborts or exits.
 * - World space is right-handed, in any unit. Raster coordinates start at the top left corner of
 *   the image. Radiance is linear Rec.709. */
#ifndef CLSHEAR_H
#define CLSHEAR_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the library, as "major.minor.patch". */
CLSHEAR_API const char *clshear_version(void);

/* ------------------------------------------------------------------------------------------------
 * Context: an OpenCL device and the kernels compiled for it
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_context clshear_context;

typedef struct clshear_context_options {
    const char *device; /* number in the device list, or part of a name; NULL: the first device */
    int threads;        /* CPU threads of host and device; 0: all */
    int packet;         /* samples traced together: 1, 4, 8 or 16; 0: 16 or 8 on CPUs, 1 on GPUs */
    void (*warn)(void *user, const char *line); /* told what was repaired or guessed; may be NULL */
    void *warn_user;
} clshear_context_options;

CLSHEAR_API clshear_context_options clshear_context_defaults(void);

/* Opens a device; kernels are compiled when a scene or an analysis first needs them. `options` may
 * be NULL. */
CLSHEAR_API clshear_status clshear_context_create(const clshear_context_options *options,
                                                  clshear_context **context);
CLSHEAR_API void clshear_context_free(clshear_context *context);

/* Why the last call on this context failed; with NULL, why the last call without a context of this
 * thread failed. Valid until the next failing call. */
CLSHEAR_API const char *clshear_message(const clshear_context *context);

/* Calls `report` once for each OpenCL device, with its number and "name (platform)". */
CLSHEAR_API clshear_status clshear_list_devices(void (*report)(void *user, int number,
                                                               const char *name),
                                                void *user);

/* Name of the context's device, and of its driver with version. Owned by the context. */
CLSHEAR_API const char *clshear_device_name(const clshear_context *context);
CLSHEAR_API const char *clshear_driver_name(const clshear_context *context);

/* ------------------------------------------------------------------------------------------------
 * Scene: triangles, materials, lights and the hierarchy over them
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_scene clshear_scene;

/* Triangles of one material. Pointers to absent data are NULL. */
typedef struct clshear_mesh {
    const float *positions;  /* 3 floats a vertex */
    const float *normals;    /* 3 floats a vertex; NULL: flat */
    const uint32_t *indices; /* 3 a triangle */
    size_t vertex_count;
    size_t triangle_count;
    float diffuse[3];  /* albedo; like all colours 0 to 1e15 */
    float emission[3]; /* radiance, both sides */
} clshear_mesh;

typedef enum clshear_light_kind {
    CLSHEAR_LIGHT_POINT = 0,
    CLSHEAR_LIGHT_DIRECTIONAL = 1
} clshear_light_kind;

typedef struct clshear_light {
    clshear_light_kind kind;
    float vector[3]; /* point: position; directional: towards the light, any length above 0 */
    float colour[3]; /* point: radiant intensity; directional: irradiance */
} clshear_light;

typedef struct clshear_scene_info {
    size_t triangles;       /* in the scene */
    size_t degenerate;      /* dropped: no area */
    size_t nodes;           /* of the hierarchy */
    size_t references;      /* triangles in its leaves; spatial splits repeat some */
    size_t device_bytes;    /* geometry on the device: nodes, triangles, faces, vertices */
    size_t lights;          /* point and directional */
    size_t emitters;        /* emissive triangles */
    int file_camera;        /* 1 if the file has a camera */
    double load_s, build_s; /* time spent reading, and building the hierarchy */
} clshear_scene_info;

/* Reads OBJ, glTF 2.0, PLY, STL or whatever else Assimp knows, and builds the hierarchy. What can
 * be repaired (missing material files and textures, colours that are none, degenerate triangles) is
 * told to the context's `warn`. */
CLSHEAR_API clshear_status clshear_scene_load(clshear_context *context, const char *path,
                                              clshear_scene **scene);

/* Makes a scene of `count` meshes in memory. */
CLSHEAR_API clshear_status clshear_scene_create(clshear_context *context,
                                                const clshear_mesh *meshes, size_t count,
                                                clshear_scene **scene);

/* Adds a light. A scene with neither lights nor emissive triangles is rendered with a point light
 * under the top of its bounding box. */
CLSHEAR_API clshear_status clshear_scene_add_light(clshear_scene *scene,
                                                   const clshear_light *light);
CLSHEAR_API clshear_scene_info clshear_scene_describe(const clshear_scene *scene);
CLSHEAR_API void clshear_scene_free(clshear_scene *scene);

/* ------------------------------------------------------------------------------------------------
 * Camera: a pinhole frame and a thin lens
 * --------------------------------------------------------------------------------------------- */

typedef enum clshear_aperture {
    CLSHEAR_APERTURE_DISK = 0,
    CLSHEAR_APERTURE_SQUARE = 1,  /* side: twice the lens radius */
    CLSHEAR_APERTURE_POLYGON = 2, /* regular; corners at the lens radius */
    CLSHEAR_APERTURE_IMAGE = 3    /* longer side: twice the lens radius */
} clshear_aperture;

/* How much light passes where, seen from behind the lens; rows from the top. What is blurred in the
 * background has this shape, what is blurred in the foreground is turned by 180 degrees. */
typedef struct clshear_aperture_image {
    float *luminance; /* 0 or more, not all 0; only ratios count */
    int width;        /* 1 to 256 each */
    int height;
} clshear_aperture_image;

/* Reads the luminance of an image file, reduced to at most 256 x 256. Fails with a message that
 * clshear_message(NULL) has. Start from zeros; free with clshear_aperture_image_free. */
CLSHEAR_API clshear_status clshear_aperture_image_read(const char *path,
                                                       clshear_aperture_image *image);
CLSHEAR_API void clshear_aperture_image_free(clshear_aperture_image *image);

typedef struct clshear_camera {
    float eye[3];
    float target[3];
    float up[3];
    float fov_deg;        /* along the shorter image axis, in (0, 180) */
    float lens_radius;    /* 0: pinhole; negative: not chosen yet */
    float focal_distance; /* camera depth of the focal plane; 0 or less: not chosen yet */
    clshear_aperture aperture;
    int blades;                          /* corners of the polygon, 3 to 32 */
    float blade_rotation_deg;            /* anticlockwise as seen; at 0 a corner is on the right */
    const clshear_aperture_image *image; /* of an image aperture; of the caller */
    float anamorphic;                    /* the aperture is this many times narrower; 0: not */
} clshear_camera;

/* The file's camera, or one that frames the bounding box from the front (up = +Y, looking down -Z)
 * for an image of this size. The lens is not chosen. */
CLSHEAR_API clshear_status clshear_scene_camera(const clshear_scene *scene, int width, int height,
                                                clshear_camera *camera);

/* Sets the focal distance to the depth of what pixel (x, y) sees through its centre. */
CLSHEAR_API clshear_status clshear_camera_focus(const clshear_scene *scene, int width, int height,
                                                int x, int y, clshear_camera *camera);

/* Chooses what is not chosen yet: focus on the middle pixel (or the box's centre where that sees
 * nothing), and a lens that blurs a point at infinity over 3 % of the shorter image axis. */
CLSHEAR_API clshear_status clshear_camera_complete(const clshear_scene *scene, int width,
                                                   int height, clshear_camera *camera);

/* Lens radius of f-number `f_stop` for a full-frame sensor (24 mm along the shorter axis) where a
 * unit of the scene is `unit_m` metres. */
CLSHEAR_API float clshear_lens_radius(const clshear_camera *camera, float f_stop, float unit_m);

/* ------------------------------------------------------------------------------------------------
 * Samplers
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_sampler_info {
    const char *name;
    const char *about; /* a line of text */
    int progressive;   /* the first samples of a pattern do not depend on how many follow */
    int is_default;
} clshear_sampler_info;

/* Sampler number `index`, from 0; returns 0 past the last one. */
CLSHEAR_API int clshear_sampler_describe(size_t index, clshear_sampler_info *info);

/* ------------------------------------------------------------------------------------------------
 * Point sets: what samplers draw, without a device. Functions here fail with a message that
 * clshear_message(NULL) has, for the calling thread.
 * --------------------------------------------------------------------------------------------- */

typedef enum clshear_shear {
    CLSHEAR_SHEAR_NONE = 0,
    CLSHEAR_SHEAR_TOROIDAL = 1,  /* along the fibre, wrapped around */
    CLSHEAR_SHEAR_EQUAL_AREA = 2 /* the first pair becomes the fibre coordinate; no seams */
} clshear_shear;

/* Sets of equally many points of the unit cube. Freed by clshear_points_free; start from zeros. */
typedef struct clshear_points {
    float *values; /* coordinate d of point i of set s: values[(s * count + i) * dimensions + d] */
    size_t sets;
    size_t count;
    size_t dimensions; /* 1 to 6 */
    char names[8];     /* a letter for each: x y (film), u v (lens), p q (light) */
} clshear_points;

/* Draws `sets` independent patterns of `count` tuples, or of the next number that the sampler has,
 * in all six dimensions; progressive samplers in the order of their sequence. */
CLSHEAR_API clshear_status clshear_points_draw(const char *sampler, size_t count, size_t sets,
                                               uint32_t seed, clshear_points *points);

/* Shears points whose first coordinates are x, y, u, v by `shear_px` pixels per aperture width, for
 * a square aperture. */
CLSHEAR_API clshear_status clshear_points_shear(clshear_points *points, clshear_shear shear,
                                                float shear_px);

/* Keeps the coordinates named in `names`, in that order. */
CLSHEAR_API clshear_status clshear_points_select(clshear_points *points, const char *names);

/* Reads text, one point a line, coordinates separated by spaces or commas, sets by lines that begin
 * with "#"; or an EXR as clshear_points_write makes it. "-" is standard input. */
CLSHEAR_API clshear_status clshear_points_read(const char *path, clshear_points *points);

/* Writes .csv (commas), .exr (a channel for each coordinate, a row for each set), or text for any
 * other name. "-" is text on standard output. */
CLSHEAR_API clshear_status clshear_points_write(const clshear_points *points, const char *path);
CLSHEAR_API void clshear_points_free(clshear_points *points);

/* ------------------------------------------------------------------------------------------------
 * Render
 * --------------------------------------------------------------------------------------------- */

/* Which depth a pixel is sheared for. */
typedef enum clshear_oracle {
    CLSHEAR_ORACLE_CENTRE = 0, /* what is seen through the middles of pixel and lens */
    CLSHEAR_ORACLE_MEDIAN = 1, /* the others: of rays all over pixel and lens */
    CLSHEAR_ORACLE_NEAR = 2,
    CLSHEAR_ORACLE_FAR = 3,
    CLSHEAR_ORACLE_PILOT = 4 /* tries centre, near, far and no shear, and takes what is clearly
                                best; fewer than 64 samples per pixel: centre */
} clshear_oracle;

/* How a pixel weighs what is around its centre. All are positive, and constant on 16 parts of their
 * width (a box on one), with the filter's mean there. */
typedef enum clshear_filter {
    CLSHEAR_FILTER_BOX = 0,            /* usual width 1 px */
    CLSHEAR_FILTER_TENT = 1,           /* 2 px */
    CLSHEAR_FILTER_GAUSSIAN = 2,       /* 3 px: six standard deviations, less its value there */
    CLSHEAR_FILTER_BLACKMAN_HARRIS = 3 /* 3 px; four terms */
} clshear_filter;

typedef struct clshear_progress {
    double fraction;      /* done, 0 to 1 */
    double samples_per_s; /* so far */
    double remaining_s;   /* estimate */
} clshear_progress;

typedef struct clshear_options {
    int width;
    int height;
    int crop[4];  /* x0, x1, y0, y1: pixels x0 <= x < x1, y0 <= y < y1; all 0: the whole image */
    uint32_t spp; /* samples per pixel; rounded up to a multiple of `replicates` */
    uint32_t replicates; /* independent patterns per pixel, each of spp / replicates samples; two or
                            more give the variance of the result; 0: 2, or 1 for one sample */
    uint32_t seed;
    const char *sampler; /* a name from clshear_sampler_describe; NULL: the default */
    clshear_shear shear; /* toroidal: of a disk or square with a box filter 1 px wide */
    clshear_oracle oracle;
    clshear_filter filter; /* samples are drawn in proportion to it */
    float filter_width_px; /* all of it, at most 64; 0: the usual */
    int adaptive;          /* share samples out by what varies most; spp is the mean, from 128 on */
    int gain;              /* also find out, at low cost, what the shear gains: channel Gain */
    int lens_rays;         /* for the depths of a pixel, 0 to 256 */
    int keep_patterns;     /* channels Pattern<replicate>.R/G/B: the mean of each replicate */
    int extendable;        /* keep what `extend` will need: channels Pattern<replicate>.R/G/B */
    const struct clshear_film *extend; /* go on with this render, made extendable with the same
                                          arguments but for spp; the sampler must be progressive */
    int (*progress)(void *user, const clshear_progress *progress); /* not 0: stop; may be NULL */
    void *progress_user;
} clshear_options;

/* 512 x 512, 256 samples in 2 replicates, seed 0, default sampler, equal-area shear, pilot. */
CLSHEAR_API clshear_options clshear_options_defaults(void);

typedef struct clshear_film clshear_film;

/* Renders. The camera's lens must be chosen. Two renders with the same arguments give the same
 * bits, whatever the number of threads. When cancelled, the film holds what was done so far, its
 * `Samples` channel says how much that is, and the status is CLSHEAR_CANCELLED. */
CLSHEAR_API clshear_status clshear_render(clshear_scene *scene, const clshear_camera *camera,
                                          const clshear_options *options, clshear_film **film);

/* ------------------------------------------------------------------------------------------------
 * Film: the rendered pixels
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_film_info {
    int width; /* of the crop */
    int height;
    size_t channels;
    uint64_t samples;       /* traced, of all pixels */
    uint64_t shadow_rays;   /* traced besides one camera ray for each sample */
    double prepass_s;       /* depth of every pixel */
    double pilot_s;         /* finding shears and sharing samples out */
    uint64_t pilot_samples; /* traced for that and thrown away */
    double kernel_s;        /* on the device, pilot included */
    double render_s;        /* all of clshear_render */
} clshear_film_info;

CLSHEAR_API clshear_film_info clshear_film_describe(const clshear_film *film);

/* Name of channel `index`, or NULL past the last one: R G B (mean radiance), Variance.R/G/B (of
 * that mean, from the replicates; absent with fewer than two), SampleVariance.R/G/B (of one
 * sample), Z (camera depth at the pixel's centre, infinite where nothing is seen), Z.near, Z.far
 * (of the lens rays), Shear (px), CoC (circle of confusion at the centre, px), Oracle (the rule
 * taken: 0 centre, 1 median, 2 near, 3 far, 4 no shear), Samples; and with `gain`, Gain: variance
 * of small patterns without shear over that with the pixel's shear, both averaged over 5 x 5
 * pixels. */
CLSHEAR_API const char *clshear_film_channel_name(const clshear_film *film, size_t index);

/* The pixels of a channel, row by row from the top, or NULL if there is no such channel. Owned by
 * the film. */
CLSHEAR_API const float *clshear_film_channel(const clshear_film *film, const char *name);

/* Adds a line of text to the metadata of written files; replaces one of that name. */
CLSHEAR_API clshear_status clshear_film_annotate(clshear_film *film, const char *name,
                                                 const char *text);

/* Reads an EXR written by clshear_film_write. */
CLSHEAR_API clshear_status clshear_film_read(clshear_context *context, const char *path,
                                             clshear_film **film);

/* Writes all channels as float32 (.exr), or R G B with the sRGB curve (.png, .jpg, .tif). An
 * existing file is replaced only once the new one is complete. */
CLSHEAR_API clshear_status clshear_film_write(clshear_film *film, const char *path);
/* Writes one channel as a picture in false colours (.png, .jpg, .tif): its logarithm from 1/16
 * (blue) over 1 (white) to 16 (orange). */
CLSHEAR_API clshear_status clshear_film_write_ratio(clshear_film *film, const char *channel,
                                                    const char *path);
CLSHEAR_API void clshear_film_free(clshear_film *film);

#ifdef __cplusplus
}
#endif

#include "analysis.h"

#endif
