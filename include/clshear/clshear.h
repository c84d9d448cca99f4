/* clshear: depth of field with sheared samples.
 *
 * The rendering half of the library, in the order in which a program uses it: settings, context,
 * scene, camera, render, film. The analysis is in analysis.h, the kernels for other programs in
 * kernels.h and device/, sharing of OpenCL objects in opencl.h. Conventions, and what may run in
 * several threads, stand at the head of common.h.
 *
 * World space is right-handed, in any unit. Raster coordinates start at the top left corner of the
 * image. Radiance is linear Rec.709. */
#ifndef CLSHEAR_H
#define CLSHEAR_H

#include "choices.h"
#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Settings: everything that a render can be asked for
 * --------------------------------------------------------------------------------------------- */

/* One setting: CLSHEAR_SPP, CLSHEAR_SAMPLER, ...: a line of setting_list.h. */
typedef enum clshear_setting {
#define CLSHEAR_ENUMERATOR(identifier, number, ...) CLSHEAR_##identifier = number,
    CLSHEAR_SETTING_LIST(CLSHEAR_ENUMERATOR)
#undef CLSHEAR_ENUMERATOR
} clshear_setting;

typedef enum clshear_setting_kind {
    CLSHEAR_SWITCH = 0,  /* 0 or 1 */
    CLSHEAR_INTEGER = 1, /* one or more whole numbers */
    CLSHEAR_NUMBER = 2,  /* one or more floating-point numbers */
    CLSHEAR_CHOICE = 3,  /* one out of several names, or its number */
    CLSHEAR_TEXT = 4
} clshear_setting_kind;

typedef struct clshear_setting_info {
    size_t struct_size;
    clshear_setting setting;
    clshear_setting_kind kind;
    const char *name;     /* as on the command line, without dashes */
    const char *aliases;  /* other names, separated by spaces */
    const char *argument; /* placeholder of the value in help texts; "" for a switch */
    const char *help;     /* one line */
    const char *fallback; /* value when nothing is set, as text; "": chosen by the render */
    size_t values;        /* numbers in one value: 3 for a point */
    size_t most;          /* values that it holds; more than 1: setting it by text adds one */
} clshear_setting_info;

/* Creates settings with nothing set, so that every fallback counts. */
CLSHEAR_API clshear_status clshear_settings_create(clshear_settings **settings);
CLSHEAR_API clshear_status clshear_settings_copy(const clshear_settings *settings,
                                                 clshear_settings **copy);
CLSHEAR_API void clshear_settings_free(clshear_settings *settings);

/* Set one value. Fail with CLSHEAR_BAD_ARGUMENT, and change nothing, when the setting is of another
 * kind or the value is out of bounds. A CHOICE takes its number here.
 *
 * Settings that answer the same question replace each other, and the last one set counts: lens
 * radius and f-number; focal distance and focus pixel. Setting the blades chooses the polygon. */
CLSHEAR_API clshear_status clshear_settings_set_integer(clshear_settings *settings,
                                                        clshear_setting setting, int64_t value);
CLSHEAR_API clshear_status clshear_settings_set_number(clshear_settings *settings,
                                                       clshear_setting setting, double value);

/* Sets all numbers of a setting: `count` is a multiple of its `values`, up to `most` times. */
CLSHEAR_API clshear_status clshear_settings_set_numbers(clshear_settings *settings,
                                                        clshear_setting setting,
                                                        const double *numbers, size_t count);

/* Sets a value of any kind from text, as the command line has it: "256", "sobol", "0,1,-4". For
 * CLSHEAR_APERTURE the text may also be the path of an image file, which is read at once. */
CLSHEAR_API clshear_status clshear_settings_set_text(clshear_settings *settings,
                                                     clshear_setting setting, const char *text);

/* Sets an image aperture: luminance that passes, seen from behind the lens, `width` x `height`
 * values row by row from the top; each side 1 to 256, values 0 or more and not all 0. Only ratios
 * count. The blur of the background has this shape, that of the foreground is turned by 180
 * degrees. */
CLSHEAR_API clshear_status clshear_settings_set_aperture(clshear_settings *settings,
                                                         const float *luminance, int width,
                                                         int height);

/* Sets all that `over` has set, as if it were set last; lists are replaced. */
CLSHEAR_API clshear_status clshear_settings_override(clshear_settings *settings,
                                                     const clshear_settings *over);

/* Forgets what was set: the fallback counts again. */
CLSHEAR_API void clshear_settings_unset(clshear_settings *settings, clshear_setting setting);

/* 1 if a value was set (or chosen by clshear_camera_complete), else 0. */
CLSHEAR_API int clshear_settings_is_set(const clshear_settings *settings, clshear_setting setting);

/* Read the value that counts. Fail with CLSHEAR_BAD_ARGUMENT when the setting is of another kind,
 * or when nothing is set and the fallback is chosen by the render. */
CLSHEAR_API clshear_status clshear_settings_get_integer(const clshear_settings *settings,
                                                        clshear_setting setting, int64_t *value);
CLSHEAR_API clshear_status clshear_settings_get_number(const clshear_settings *settings,
                                                       clshear_setting setting, double *value);

/* Reads up to `capacity` numbers, and their whole number into `count`. */
CLSHEAR_API clshear_status clshear_settings_get_numbers(const clshear_settings *settings,
                                                        clshear_setting setting, double *numbers,
                                                        size_t capacity, size_t *count);

/* Writes the value of any kind as text that clshear_settings_set_text takes back, cut to `size`
 * bytes with the closing 0. */
CLSHEAR_API clshear_status clshear_settings_get_text(const clshear_settings *settings,
                                                     clshear_setting setting, char *text,
                                                     size_t size);

/* Reads a settings file: one setting a line, as "name value" or "--name value"; "#" begins a
 * comment. Lines that name no setting are passed to `other` with the file's name and the line's
 * number, 1 for the first; it returns 0 if it took them (`value` is NULL where there is none). They
 * are errors where `other` is NULL or returns something else. The message names file and line. */
CLSHEAR_API clshear_status clshear_settings_read(clshear_settings *settings, const char *path,
                                                 int (*other)(void *user, const char *file,
                                                              int line, const char *name,
                                                              const char *value),
                                                 void *user);

/* Setting number `index` of the table, from 0; returns 0 past the last one. `info->struct_size` is
 * set by the caller. */
CLSHEAR_API int clshear_setting_describe(size_t index, clshear_setting_info *info);

/* The setting of that name, or of one of its other names. */
CLSHEAR_API clshear_status clshear_setting_find(const char *name, clshear_setting *setting);

/* Lowest and highest value of each number of a setting, both included; both 0 for texts. Choices
 * count from 0. */
CLSHEAR_API clshear_status clshear_setting_bounds(clshear_setting setting, double *low,
                                                  double *high);

/* Name and meaning of choice number `index` of a CHOICE setting; returns 0 past the last one.
 * `meaning` may be NULL. */
CLSHEAR_API int clshear_setting_choice(clshear_setting setting, size_t index, const char **name,
                                       const char **meaning);

typedef struct clshear_progress {
    double fraction;      /* done, 0 to 1; 0 while a pilot does not know what is left */
    double samples_per_s; /* so far */
    double remaining_s;   /* estimate; 0 while it is not known */
} clshear_progress;

/* Calls `progress` a few times a second during renders with these settings, in the thread that
 * renders. When it returns something else than 0, the render stops soon: the film then has
 * complete == 0. NULL: no calls. */
CLSHEAR_API void clshear_settings_set_progress(clshear_settings *settings,
                                               int (*progress)(void *user,
                                                               const clshear_progress *state),
                                               void *user);

/* ------------------------------------------------------------------------------------------------
 * Context: an OpenCL device and the kernels compiled for it
 * --------------------------------------------------------------------------------------------- */

/* Opens the device that the settings name (CLSHEAR_DEVICE, _THREADS, _PACKET; NULL: fallbacks). The
 * kernels are compiled when a scene or an analysis first needs them. */
CLSHEAR_API clshear_status clshear_context_create(const clshear_settings *settings,
                                                  clshear_context **context);
CLSHEAR_API void clshear_context_free(clshear_context *context);

/* Calls `warn` with one line for whatever is repaired or guessed: missing textures, degenerate
 * triangles. The call comes in the thread whose work it concerns. NULL: no calls. Set it before
 * other threads use the context. */
CLSHEAR_API void clshear_context_set_warning(clshear_context *context,
                                             void (*warn)(void *user, const char *line),
                                             void *user);

/* Why the last call on this object that failed did so, whichever thread made it; "" before any
 * failure. Valid until the calling thread asks again for a message of any object. */
CLSHEAR_API const char *clshear_context_message(const clshear_context *context);

/* Name of the device, and name and version of its driver. Owned by the context. */
CLSHEAR_API const char *clshear_device_name(const clshear_context *context);
CLSHEAR_API const char *clshear_driver_name(const clshear_context *context);

/* Calls `report` once for each OpenCL device, with its number and "name (platform)". */
CLSHEAR_API clshear_status clshear_list_devices(void (*report)(void *user, int number,
                                                               const char *name),
                                                void *user);

/* ------------------------------------------------------------------------------------------------
 * Scene: triangles, materials, lights and the hierarchy over them
 * --------------------------------------------------------------------------------------------- */

typedef enum clshear_alpha_mode {
    CLSHEAR_ALPHA_OPAQUE = 0, /* alpha is not used */
    CLSHEAR_ALPHA_MASK = 1,   /* nothing is there where it is below the cutoff */
    CLSHEAR_ALPHA_BLEND = 2   /* it is the part that covers what is behind */
} clshear_alpha_mode;

/* The surface of glTF 2.0 and its extensions; all numbers without a remark are 0 to 1. */
typedef struct clshear_material {
    size_t struct_size;
    float base_colour[3]; /* of a metal's reflection, or of what is below a dielectric's */
    float metallic;
    float roughness;
    float ior;          /* index of refraction of the dielectric: 1 to 10 */
    float specular;     /* the dielectric's reflection is multiplied by it; 0: Lambert's surface */
    float transmission; /* part of the base that is transparent, as a thin wall */
    float alpha;
    clshear_alpha_mode alpha_mode;
    float alpha_cutoff;
    float clearcoat;
    float clearcoat_roughness;
    float sheen_colour[3];
    float sheen_roughness;
    float emission[3]; /* radiance, on both sides; 0 to 1e15 */
    int unlit;         /* not 0: shows its base colour and takes no part in light */
    int double_sided;  /* kept; all surfaces have two sides */
} clshear_material;

/* Triangles of one material. */
typedef struct clshear_mesh {
    size_t struct_size;
    const float *positions;  /* 3 floats a vertex */
    const float *normals;    /* 3 floats a vertex; NULL: flat */
    const uint32_t *indices; /* 3 a triangle */
    size_t vertex_count;
    size_t triangle_count;
    float diffuse[3];  /* albedo of a Lambertian surface; 0 to 1e15, physical up to 1 */
    float emission[3]; /* radiance, on both sides; 0 to 1e15 */
    uint32_t
        material; /* what clshear_scene_add_material gave, in the place of those two; 0: none */
} clshear_mesh;

typedef enum clshear_light_kind {
    CLSHEAR_LIGHT_POINT = 0,
    CLSHEAR_LIGHT_DIRECTIONAL = 1,
    CLSHEAR_LIGHT_SPOT = 2
} clshear_light_kind;

typedef struct clshear_light {
    size_t struct_size;
    clshear_light_kind kind;
    float position[3];  /* of a point or spot light */
    float direction[3]; /* towards a directional light, or in which a spot light shines; any length
                         * above 0 */
    float colour[3];    /* radiant intensity of a point light, and of a spot light on its axis;
                         * irradiance of a directional light */
    float diameter_deg; /* angle that a directional light takes in the sky; 0: sharp shadows */
    float inner_deg;    /* angle from a spot light's axis up to which it is full */
    float outer_deg;    /* and from which on it is dark: above the inner one, at most 90 */
} clshear_light;

typedef struct clshear_scene_info {
    size_t struct_size;
    size_t triangles;    /* in the scene */
    size_t degenerate;   /* triangles without area that were left out */
    size_t nodes;        /* of the hierarchy */
    size_t references;   /* triangles in its leaves; spatial splits repeat some */
    size_t device_bytes; /* geometry on the device: nodes, triangles, faces, vertices */
    size_t lights;       /* point, directional, spot */
    size_t emitters;     /* emissive triangles */
    int file_camera;     /* 1 if the file has a camera */
    double load_s;       /* time spent reading the file */
    double build_s;      /* time spent building the hierarchy */
} clshear_scene_info;

/* Reads OBJ, glTF 2.0, PLY, STL or another format that Assimp knows, and completes the scene. What
 * can be repaired is reported to the context's warning callback: missing material files and
 * textures, invalid colours (negative or not finite), degenerate triangles. */
CLSHEAR_API clshear_status clshear_scene_load(clshear_context *context, const char *path,
                                              clshear_scene **scene);

/* Creates an empty scene, to be filled with meshes and then completed. */
CLSHEAR_API clshear_status clshear_scene_create(clshear_context *context, clshear_scene **scene);
CLSHEAR_API clshear_status clshear_scene_add_mesh(clshear_scene *scene, const clshear_mesh *mesh);

/* Fills in glTF's defaults: white metal, fully rough. struct_size is set by the caller. */
CLSHEAR_API void clshear_material_init(clshear_material *material);

/* Adds a material for meshes to come, and gives its number, 1 or more. */
CLSHEAR_API clshear_status clshear_scene_add_material(clshear_scene *scene,
                                                      const clshear_material *material,
                                                      uint32_t *number);

/* Builds the hierarchy and puts the scene on the device. No mesh can be added afterwards. */
CLSHEAR_API clshear_status clshear_scene_complete(clshear_scene *scene);

/* Adds a light, before or after the scene is complete. A scene with neither lights nor emissive
 * triangles is rendered in a neutral studio (clshear_light_complete), unless the settings have
 * lights. */
CLSHEAR_API clshear_status clshear_scene_add_light(clshear_scene *scene,
                                                   const clshear_light *light);

/* Fills in `info`, whose struct_size is set by the caller. */
CLSHEAR_API void clshear_scene_describe(const clshear_scene *scene, clshear_scene_info *info);

/* As clshear_context_message. */
CLSHEAR_API const char *clshear_scene_message(const clshear_scene *scene);
CLSHEAR_API void clshear_scene_free(clshear_scene *scene);

/* ------------------------------------------------------------------------------------------------
 * Camera: the settings of a pinhole camera with a thin lens
 * --------------------------------------------------------------------------------------------- */

/* Sets what the settings leave open: eye, target, up and field of view from the scene file's
 * camera, or else so that the bounding box fills the picture from the front (looking down -Z);
 * focus on CLSHEAR_FOCUS_PIXEL, or else on the middle pixel, or the depth of the box's centre where
 * that sees nothing; the lens radius from CLSHEAR_F_STOP, or else so that a point at infinity blurs
 * over 3 % of the shorter image axis. A render does the same, without changing the settings. */
CLSHEAR_API clshear_status clshear_camera_complete(const clshear_scene *scene,
                                                   clshear_settings *settings);

/* Where neither the scene nor the settings have light: sets an even CLSHEAR_ENVIRONMENT and a soft
 * CLSHEAR_SUN at the camera's upper left, and a CLSHEAR_LIGHT in the eye if that is inside the
 * scene's bounding box. Completes the camera first. A render does the same, without changing the
 * settings. */
CLSHEAR_API clshear_status clshear_light_complete(const clshear_scene *scene,
                                                  clshear_settings *settings);

/* Sets the focal distance to the depth that pixel (x, y) sees through its centre. */
CLSHEAR_API clshear_status clshear_camera_focus(const clshear_scene *scene,
                                                clshear_settings *settings, int x, int y);

/* ------------------------------------------------------------------------------------------------
 * Samplers
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_sampler_info {
    size_t struct_size;
    const char *name;
    const char *about; /* one line */
    int progressive;   /* the first samples of a pattern do not depend on how many follow */
    int is_default;
} clshear_sampler_info;

/* Sampler number `index`, from 0; returns 0 past the last one. `info->struct_size` is set by the
 * caller. */
CLSHEAR_API int clshear_sampler_describe(size_t index, clshear_sampler_info *info);

/* ------------------------------------------------------------------------------------------------
 * Render
 * --------------------------------------------------------------------------------------------- */

/* Renders. Two renders with equal arguments give equal bits, whatever the number of threads. A
 * render that the progress callback stops succeeds: the film holds what was done so far, its
 * channel Samples says how much that is, and its info has complete == 0. NULL settings: fallbacks.
 */
CLSHEAR_API clshear_status clshear_render(clshear_scene *scene, const clshear_settings *settings,
                                          clshear_film **film);

/* Continues a render up to the settings' samples per pixel, without repeating those that `base`
 * has. The base must have been made with CLSHEAR_EXTENDABLE and equal settings but for
 * CLSHEAR_SPP, and the sampler must be progressive. */
CLSHEAR_API clshear_status clshear_render_extend(clshear_scene *scene,
                                                 const clshear_settings *settings,
                                                 const clshear_film *base, clshear_film **film);

/* ------------------------------------------------------------------------------------------------
 * Film: the rendered pixels
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_film_info {
    size_t struct_size;
    int width; /* of the crop, px */
    int height;
    size_t channels;
    int complete;           /* 0: the render was stopped */
    uint64_t samples;       /* traced, of all pixels */
    uint64_t shadow_rays;   /* traced besides the one camera ray of each sample */
    uint64_t pilot_samples; /* traced to find shears and allocate samples, then discarded */
    double prepass_s;       /* time for the depth of every pixel */
    double pilot_s;         /* time for shears and allocation */
    double kernel_s;        /* time on the device, pilot included */
    double render_s;        /* time of the whole call */
} clshear_film_info;

/* Fills in `info`, whose struct_size is set by the caller. */
CLSHEAR_API void clshear_film_describe(const clshear_film *film, clshear_film_info *info);

/* Name of channel `index`, or NULL past the last one. Owned by the film. The channels:
 *   R G B                 mean radiance
 *   Variance.R/G/B        variance of that mean, from the replicates; absent with fewer than two
 *   SampleVariance.R/G/B  variance of one sample
 *   Z                     camera depth at the pixel's centre, infinite where nothing is seen
 *   Z.near, Z.far         nearest and farthest depth of the lens rays
 *   Shear                 shear of the samples, px
 *   CoC                   circle of confusion at the pixel's centre, px
 *   Oracle                rule taken: 0 centre, 1 median, 2 near, 3 far, 4 no shear
 *   Samples               samples of the pixel
 *   Gain                  with CLSHEAR_GAIN: variance of small patterns without shear over their
 *                         variance with it, both averaged over 5 x 5 pixels
 *   Pattern<n>.R/G/B      with CLSHEAR_KEEP_PATTERNS or _EXTENDABLE: mean of replicate n */
CLSHEAR_API const char *clshear_film_channel_name(const clshear_film *film, size_t index);

/* The pixels of a channel, row by row from the top, or NULL if there is no such channel. Owned by
 * the film. */
CLSHEAR_API const float *clshear_film_channel(const clshear_film *film, const char *name);

/* Copies `count` channels of every pixel into the caller's memory: channel c of pixel (x, y) of the
 * crop goes to the float at byte y * row_stride + x * pixel_stride + c * sizeof(float). */
CLSHEAR_API clshear_status clshear_film_copy(clshear_film *film, const char *const *channels,
                                             size_t count, void *target, size_t pixel_stride,
                                             size_t row_stride);

/* Mean over pixels and colours of the channels Variance.R/G/B; NaN if they are absent. */
CLSHEAR_API double clshear_film_mean_variance(const clshear_film *film);

/* Adds a line of text to the metadata of written files; replaces one of that name. */
CLSHEAR_API clshear_status clshear_film_annotate(clshear_film *film, const char *name,
                                                 const char *text);

/* Reads an EXR written by clshear_film_write. */
CLSHEAR_API clshear_status clshear_film_read(const char *path, clshear_film **film);

/* Writes all channels as float32 (.exr), or R G B with the sRGB curve (.png, .jpg, .tif). An
 * existing file is replaced only once the new one is complete. */
CLSHEAR_API clshear_status clshear_film_write(clshear_film *film, const char *path);

/* Writes one channel as a picture in false colours (.png, .jpg, .tif): its logarithm from 1/16
 * (blue) over 1 (white) to 16 (orange). */
CLSHEAR_API clshear_status clshear_film_write_ratio(clshear_film *film, const char *channel,
                                                    const char *path);

/* As clshear_context_message. */
CLSHEAR_API const char *clshear_film_message(const clshear_film *film);
CLSHEAR_API void clshear_film_free(clshear_film *film);

#ifdef __cplusplus
}
#endif

#endif
