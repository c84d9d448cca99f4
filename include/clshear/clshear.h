/* clshear: depth of field with sheared samples.
 *
 * The rendering half of the library, in the order of use: settings, context, scene, camera, render,
 * film. analysis.h has the analysis of samples, kernels.h and device/ the kernels for other
 * programs, and opencl.h the sharing of OpenCL objects. The head of common.h describes the
 * conventions and the rules for threads.
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
 * Settings: the options of a render
 * --------------------------------------------------------------------------------------------- */

/* The settings, CLSHEAR_SPP, CLSHEAR_SAMPLER, ...: one for each line of setting_list.h. */
typedef enum clshear_setting {
#define CLSHEAR_ENUMERATOR(identifier, number, ...) CLSHEAR_##identifier = number,
    CLSHEAR_SETTING_LIST(CLSHEAR_ENUMERATOR)
#undef CLSHEAR_ENUMERATOR
} clshear_setting;

typedef enum clshear_setting_kind {
    CLSHEAR_SWITCH = 0,  /* 0 or 1 */
    CLSHEAR_INTEGER = 1, /* one or more whole numbers */
    CLSHEAR_NUMBER = 2,  /* one or more floating-point numbers */
    CLSHEAR_CHOICE = 3,  /* one of several names, or its number */
    CLSHEAR_TEXT = 4
} clshear_setting_kind;

typedef struct clshear_setting_info {
    size_t struct_size;
    clshear_setting setting;
    clshear_setting_kind kind;
    const char *name;     /* the flag's name, without dashes */
    const char *aliases;  /* other names, separated by spaces */
    const char *argument; /* placeholder of the value in help texts; "" for a switch */
    const char *help;     /* one line */
    const char *fallback; /* default value as text; "": the render chooses it */
    size_t values;        /* numbers in one value: 3 for a point */
    size_t most;          /* largest number of values; above 1, text appends one */
} clshear_setting_info;

/* Creates settings with every setting at its fallback. */
CLSHEAR_API clshear_status clshear_settings_create(clshear_settings **settings);
CLSHEAR_API clshear_status clshear_settings_copy(const clshear_settings *settings,
                                                 clshear_settings **copy);
CLSHEAR_API void clshear_settings_free(clshear_settings *settings);

/* Set one value. They fail with CLSHEAR_BAD_ARGUMENT, and change nothing, if the setting is of
 * another kind or the value is out of bounds. A CHOICE takes its number here.
 *
 * Some settings are alternatives, and setting one unsets the other: lens radius and f-number; focal
 * distance and focus pixel. Setting the blades chooses the polygon. */
CLSHEAR_API clshear_status clshear_settings_set_integer(clshear_settings *settings,
                                                        clshear_setting setting, int64_t value);
CLSHEAR_API clshear_status clshear_settings_set_number(clshear_settings *settings,
                                                       clshear_setting setting, double value);

/* Sets all numbers of a setting. `count` is a multiple of its `values`, at most `most` times. */
CLSHEAR_API clshear_status clshear_settings_set_numbers(clshear_settings *settings,
                                                        clshear_setting setting,
                                                        const double *numbers, size_t count);

/* Sets a value of any kind from text in the form of the command line: "256", "sobol", "0,1,-4". For
 * CLSHEAR_APERTURE the text may also be the path of an image file, which is read at once. */
CLSHEAR_API clshear_status clshear_settings_set_text(clshear_settings *settings,
                                                     clshear_setting setting, const char *text);

/* Sets an image aperture. `luminance` is its transmittance as seen from behind the lens: `width` x
 * `height` values, row by row from the top. Each side is 1 to 256. Values are 0 or more, not all 0,
 * and only ratios matter. The blur of the background has this shape, and the blur of the foreground
 * is turned by 180 degrees. */
CLSHEAR_API clshear_status clshear_settings_set_aperture(clshear_settings *settings,
                                                         const float *luminance, int width,
                                                         int height);

/* Copies every setting that is set in `over`, as if it were set last. Lists are replaced. */
CLSHEAR_API clshear_status clshear_settings_override(clshear_settings *settings,
                                                     const clshear_settings *over);

/* Resets a setting to its fallback. */
CLSHEAR_API void clshear_settings_unset(clshear_settings *settings, clshear_setting setting);

/* Returns 1 if a value was set (or chosen by clshear_camera_complete), else 0. */
CLSHEAR_API int clshear_settings_is_set(const clshear_settings *settings, clshear_setting setting);

/* Read the current value. They fail with CLSHEAR_BAD_ARGUMENT if the setting is of another kind, or
 * if it is not set and the render chooses its value. */
CLSHEAR_API clshear_status clshear_settings_get_integer(const clshear_settings *settings,
                                                        clshear_setting setting, int64_t *value);
CLSHEAR_API clshear_status clshear_settings_get_number(const clshear_settings *settings,
                                                       clshear_setting setting, double *value);

/* Reads up to `capacity` numbers. `count` receives the length of the value, which may be more. */
CLSHEAR_API clshear_status clshear_settings_get_numbers(const clshear_settings *settings,
                                                        clshear_setting setting, double *numbers,
                                                        size_t capacity, size_t *count);

/* Prints a value of any kind in the form that clshear_settings_set_text reads, truncated to `size`
 * bytes with the closing 0. */
CLSHEAR_API clshear_status clshear_settings_get_text(const clshear_settings *settings,
                                                     clshear_setting setting, char *text,
                                                     size_t size);

/* Reads a settings file with one setting per line, as "name value" or "--name value"; "#" begins
 * a comment. The callback `other` receives lines with an unknown name: the file's name, the
 * line's number from 1, the name and the value (NULL if there is none). It returns 0 if it
 * accepts the line. Otherwise, or if `other` is NULL, such lines are errors. The message names
 * file and line. */
CLSHEAR_API clshear_status clshear_settings_read(clshear_settings *settings, const char *path,
                                                 int (*other)(void *user, const char *file,
                                                              int line, const char *name,
                                                              const char *value),
                                                 void *user);

/* Describes setting number `index` of the table, from 0. Returns 0 past the last one. The caller
 * sets `info->struct_size`. */
CLSHEAR_API int clshear_setting_describe(size_t index, clshear_setting_info *info);

/* Finds a setting by its name or an alias. */
CLSHEAR_API clshear_status clshear_setting_find(const char *name, clshear_setting *setting);

/* Reads the lowest and highest value of each number of a setting, both inclusive; both 0 for texts.
 * Choices count from 0. */
CLSHEAR_API clshear_status clshear_setting_bounds(clshear_setting setting, double *low,
                                                  double *high);

/* Name and meaning of choice number `index` of a CHOICE setting. Returns 0 past the last one.
 * `meaning` may be NULL. */
CLSHEAR_API int clshear_setting_choice(clshear_setting setting, size_t index, const char **name,
                                       const char **meaning);

typedef struct clshear_progress {
    double fraction;      /* finished part, 0 to 1; 0 before the samples that count */
    double samples_per_s; /* mean rate since the start; 0 while depths are found */
    double remaining_s;   /* estimate; 0 while it is unknown */
    double noise;         /* relative standard error when a stop rule last looked; 0: it has not */
    double
        noise_pixel; /* as CLSHEAR_NOISE_PIXEL has it; 0: that rule is not set, or has not looked */
} clshear_progress;

/* Calls `progress` a few times a second during renders with these settings, in the rendering
 * thread. If it does not return 0, the render stops soon and its film has complete == 0. NULL: no
 * calls. */
CLSHEAR_API void clshear_settings_set_progress(clshear_settings *settings,
                                               int (*progress)(void *user,
                                                               const clshear_progress *state),
                                               void *user);

/* Shows pictures of renders with these settings while they go on. `wanted` is called between two
 * launches; when it does not return 0, `show` gets the picture so far, with complete == 0, which is
 * the library's. Both are called in the rendering thread. NULL: no calls. */
CLSHEAR_API void clshear_settings_set_preview(clshear_settings *settings, int (*wanted)(void *user),
                                              void (*show)(void *user, clshear_film *film),
                                              void *user);

/* ------------------------------------------------------------------------------------------------
 * Context: an OpenCL device and the kernels compiled for it
 * --------------------------------------------------------------------------------------------- */

/* Opens the device of the settings CLSHEAR_DEVICE, _THREADS and _PACKET (NULL settings: fallbacks).
 * Without the first, the environment variable CLSHEAR_DEVICE is asked, and then the fastest device
 * is taken that is no emulator. The kernels are compiled when a scene or an analysis first needs
 * them. Before its first render a device is tested; with the setting CLSHEAR_FORCE, one that fails
 * is used all the same. */
CLSHEAR_API clshear_status clshear_context_create(const clshear_settings *settings,
                                                  clshear_context **context);
CLSHEAR_API void clshear_context_free(clshear_context *context);

/* Calls `warn` with one line for every repair or guess: missing textures, degenerate triangles. The
 * call comes from the thread that does the work. NULL: no calls. Set it before other threads use
 * the context. */
CLSHEAR_API void clshear_context_set_warning(clshear_context *context,
                                             void (*warn)(void *user, const char *line),
                                             void *user);

/* Calls `alarm`, not the warning callback, with one line where a render goes on although something
 * that was asked for is lost: its checkpoint or its preview cannot be written, or its viewer is not
 * there or no more. NULL: the warning callback gets such lines. */
CLSHEAR_API void clshear_context_set_alarm(clshear_context *context,
                                           void (*alarm)(void *user, const char *line), void *user);

/* The message of the last failed call on this object, from any thread; "" before any failure. Valid
 * until the calling thread next asks for the message of any object. */
CLSHEAR_API const char *clshear_context_message(const clshear_context *context);

/* Name of the device, and name and version of its driver. Owned by the context. */
CLSHEAR_API const char *clshear_device_name(const clshear_context *context);
CLSHEAR_API const char *clshear_driver_name(const clshear_context *context);

/* Calls `report` for each OpenCL device, with its number and "name (platform)". */
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
    float transmission; /* part of the base that is transparent, as a thin wall or a solid */
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
    int solid;         /* not 0: what is transparent refracts, with `ior` on the side of a triangle
                          from which its corners run clockwise. The surface has to be closed. An ior
                          below 1.01 is taken as a thin wall */
    float attenuation_colour[3]; /* of white light, what is left inside a solid after ... */
    float attenuation_distance;  /* ... this way, in units of the scene; 0: all of it */
} clshear_material;

/* A triangle mesh with one material. */
typedef struct clshear_mesh {
    size_t struct_size;
    const float *positions;  /* 3 floats per vertex */
    const float *normals;    /* 3 floats per vertex; NULL: flat shading */
    const uint32_t *indices; /* 3 per triangle */
    size_t vertex_count;
    size_t triangle_count;
    float diffuse[3];  /* albedo of a Lambertian surface; 0 to 1e15, physical up to 1 */
    float emission[3]; /* radiance, on both sides; 0 to 1e15 */
    uint32_t
        material; /* what clshear_scene_add_material gave, in the place of those two; 0: none */
    const float *positions_to; /* where the vertices are when the shutter closes; NULL: at rest */
    const float *normals_to;   /* likewise; NULL: those above */
} clshear_mesh;

typedef enum clshear_light_kind {
    CLSHEAR_LIGHT_POINT = 0,
    CLSHEAR_LIGHT_DIRECTIONAL = 1,
    CLSHEAR_LIGHT_SPOT = 2,
    CLSHEAR_LIGHT_SPHERE = 3, /* seen by the camera, and hides what is behind it */
    CLSHEAR_LIGHT_QUAD = 4    /* a parallelogram; the same */
} clshear_light_kind;

typedef struct clshear_light {
    size_t struct_size;
    clshear_light_kind kind;
    float position[3]; /* position of a point or spot light, centre of a sphere, corner of a quad */
    float direction[3]; /* direction towards a directional light, or in which a spot light shines;
                         * any length above 0 */
    float colour[3];    /* radiant intensity of a point light, and of a spot light on its axis;
                         * irradiance of a directional light; radiance of a sphere or quad */
    float diameter_deg; /* angle that a directional light takes in the sky; 0: sharp shadows */
    float inner_deg;    /* angle from a spot light's axis up to which it is full */
    float outer_deg;    /* angle from which on it is dark: above the inner one, at most 90 */
    float radius;       /* of a sphere, above 0 */
    float edge1[3];     /* edges of a quad from its corner. It shines on the side from which the */
    float edge2[3];     /* turn from edge1 to edge2 is against the clock; the other is black */
} clshear_light;

typedef struct clshear_scene_info {
    size_t struct_size;
    size_t triangles;    /* triangles in the scene */
    size_t degenerate;   /* triangles without area, which are left out */
    size_t nodes;        /* nodes of the hierarchy */
    size_t references;   /* triangles in its leaves; spatial splits repeat some */
    size_t device_bytes; /* geometry on the device: nodes, triangles, faces, vertices */
    size_t lights;       /* added lights and those of the file */
    size_t emitters;     /* emissive triangles */
    int file_camera;     /* 1 if the file has a camera */
    double load_s;       /* time spent reading the file */
    double build_s;      /* time spent building the hierarchy */
    double low[3];       /* corners of the bounding box, in coordinates of the file */
    double high[3];
} clshear_scene_info;

/* Reads OBJ, glTF 2.0, PLY, STL or another format that Assimp supports, and completes the scene. Of
 * the settings (NULL: fallbacks) CLSHEAR_SMOOTH counts. Repairs are reported to the context's
 * warning callback: missing material files and textures, invalid colours (negative or not finite),
 * degenerate triangles.
 *
 * The program clshear-import reads the file, in a process with limits on time and memory, so that a
 * damaged file ends in a message. It is looked for beside the library, in libexec/clshear, and at
 * the path in the environment variable CLSHEAR_IMPORT. Without it, OBJ, glTF, PLY and STL are read
 * in the calling process, and other formats are refused.
 *
 * A scene that lies far from the origin is moved there, with a warning, since the device computes
 * with floats. Cameras and lights, in settings and added, stay in the coordinates of the file. */
CLSHEAR_API clshear_status clshear_scene_load(clshear_context *context, const char *path,
                                              const clshear_settings *settings,
                                              clshear_scene **scene);

/* Cameras of the scene's file: the name of number `index` from 0, or NULL past the last one. Owned
 * by the scene. CLSHEAR_CAMERA chooses one. */
CLSHEAR_API const char *clshear_scene_camera(const clshear_scene *scene, size_t index);

/* Creates an empty scene. Add meshes to it and then complete it. */
CLSHEAR_API clshear_status clshear_scene_create(clshear_context *context, clshear_scene **scene);
CLSHEAR_API clshear_status clshear_scene_add_mesh(clshear_scene *scene, const clshear_mesh *mesh);

/* Fills in glTF's defaults: white metal, fully rough. struct_size is set by the caller. */
CLSHEAR_API void clshear_material_init(clshear_material *material);

/* Adds a material for meshes to come, and gives its number, 1 or more. */
CLSHEAR_API clshear_status clshear_scene_add_material(clshear_scene *scene,
                                                      const clshear_material *material,
                                                      uint32_t *number);

/* Builds the hierarchy and uploads the scene to the device. No mesh can be added afterwards. */
CLSHEAR_API clshear_status clshear_scene_complete(clshear_scene *scene);

/* Adds a light, before or after the scene is complete. A scene with neither lights nor emissive
 * triangles is rendered in a neutral studio (clshear_light_complete), unless the settings have
 * lights. */
CLSHEAR_API clshear_status clshear_scene_add_light(clshear_scene *scene,
                                                   const clshear_light *light);

/* Fills in `info`. The caller sets `info->struct_size`. */
CLSHEAR_API void clshear_scene_describe(const clshear_scene *scene, clshear_scene_info *info);

/* The message of the last failed call on this object; see clshear_context_message. */
CLSHEAR_API const char *clshear_scene_message(const clshear_scene *scene);
CLSHEAR_API void clshear_scene_free(clshear_scene *scene);

/* ------------------------------------------------------------------------------------------------
 * Camera: the settings of a perspective or orthographic camera with a thin lens
 * --------------------------------------------------------------------------------------------- */

/* Sets every camera setting that is not set yet; a render does the same on its own copy of the
 * settings.
 * - Eye, target, up, and field of view or CLSHEAR_ORTHOGRAPHIC: from the scene file's camera, the
 *   one that CLSHEAR_CAMERA names or else the first. Without one, the scene fills the picture as
 *   seen from the front and slightly above, or from where CLSHEAR_ORBIT says. CLSHEAR_ORTHOGRAPHIC
 * 0 becomes the width that shows all of it.
 * - Focal distance: the focal plane, with its CLSHEAR_TILT, goes through what CLSHEAR_FOCUS_PIXEL
 *   sees, through CLSHEAR_FOCUS_POINT, or through what the middle pixel sees. If that is nothing,
 *   the distance is that of the centre of the bounding box.
 * - Lens radius: from CLSHEAR_F_STOP or CLSHEAR_BLUR. Without them, a point at infinity, or with
 *   parallel lines of sight the most blurred corner of the bounding box, blurs over 3 % of the
 *   shorter image axis. */
CLSHEAR_API clshear_status clshear_camera_complete(const clshear_scene *scene,
                                                   clshear_settings *settings);

/* Where neither the scene nor the settings have light: sets an even CLSHEAR_ENVIRONMENT and a soft
 * CLSHEAR_SUN at the camera's upper left, and a CLSHEAR_LIGHT in the eye if that is inside the
 * scene's bounding box. Completes the camera first. A render does the same, without changing the
 * settings. */
CLSHEAR_API clshear_status clshear_light_complete(const clshear_scene *scene,
                                                  clshear_settings *settings);

/* Sets the focal distance to the depth at the centre of pixel (x, y). */
CLSHEAR_API clshear_status clshear_camera_focus(const clshear_scene *scene,
                                                clshear_settings *settings, int x, int y);

/* ------------------------------------------------------------------------------------------------
 * Samplers
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_sampler_info {
    size_t struct_size;
    const char *name;
    const char *about; /* one line */
    int progressive;   /* 1: a pattern's first samples are independent of its length */
    int is_default;
} clshear_sampler_info;

/* Describes sampler number `index`, from 0. Returns 0 past the last one. The caller sets
 * `info->struct_size`. */
CLSHEAR_API int clshear_sampler_describe(size_t index, clshear_sampler_info *info);

/* ------------------------------------------------------------------------------------------------
 * Render
 * --------------------------------------------------------------------------------------------- */

/* Renders the scene. Renders with equal arguments are equal bit for bit, whatever the number of
 * threads. A render that the progress callback stops succeeds: the film has the samples so far, its
 * channel Samples their number, and its info complete == 0. NULL settings: fallbacks. */
CLSHEAR_API clshear_status clshear_render(clshear_scene *scene, const clshear_settings *settings,
                                          clshear_film **film);

/* Continues a render up to the settings' samples per pixel, without repeating the samples of
 * `base`. The base must have been made with CLSHEAR_EXTENDABLE and the same settings except
 * CLSHEAR_SPP. The sampler must be progressive. */
CLSHEAR_API clshear_status clshear_render_extend(clshear_scene *scene,
                                                 const clshear_settings *settings,
                                                 const clshear_film *base, clshear_film **film);

/* ------------------------------------------------------------------------------------------------
 * Film: the rendered pixels
 * --------------------------------------------------------------------------------------------- */

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
 *   Oracle                rule of the shear: 0 centre, 1 median, 2 near, 3 far, 4 no shear
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

/* Adds a line of text to the metadata of written files. Replaces a line of the same name. */
CLSHEAR_API clshear_status clshear_film_annotate(clshear_film *film, const char *name,
                                                 const char *text);

/* Reads an EXR written by clshear_film_write. */
CLSHEAR_API clshear_status clshear_film_read(const char *path, clshear_film **film);

/* Merges `count` films of shards of one render (CLSHEAR_SHARD), or merges of them: means weighted
 * by samples, variances by their counts. Any order gives the same result. It may be merged further,
 * and has complete == 0 while shards are missing. Fails with CLSHEAR_BAD_ARGUMENT for films of
 * different renders, of interrupted ones, and for a shard that comes twice. */
CLSHEAR_API clshear_status clshear_film_merge(const clshear_film *const *films, size_t count,
                                              clshear_film **merged);

/* Prints the shards of a film that are missing, as "2,5-7", truncated to `size` bytes; "" if none
 * are, or if the film is no shard. */
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
