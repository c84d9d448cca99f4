/* clshear: settings, the options of a render.
 *
 * setting_list.h lists them; the page docs/settings.md describes them. */
#ifndef CLSHEAR_SETTINGS_H
#define CLSHEAR_SETTINGS_H

#include "choices.h"
#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

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
 * Some settings are alternatives, and setting one unsets the others: lens radius, f-number and
 * blur; focal distance, focus pixel and focus point; field of view and orthographic; orbit, and
 * eye, target or camera. Setting the blades chooses the polygon. */
CLSHEAR_API clshear_status clshear_settings_set_integer(clshear_settings *settings,
                                                        clshear_setting setting, int64_t value);
CLSHEAR_API clshear_status clshear_settings_set_number(clshear_settings *settings,
                                                       clshear_setting setting, double value);

/* Sets all numbers of a setting. `count` is a multiple of its `values`, at most `most` times. */
CLSHEAR_API clshear_status clshear_settings_set_numbers(clshear_settings *settings,
                                                        clshear_setting setting,
                                                        const double *numbers, size_t count);

/* Sets a value of any kind from text in the form of the command line: "256", "sobol", "0,1,-4". For
 * CLSHEAR_APERTURE the text may also be the path of an image file, which is read at once. An empty
 * text is refused; clshear_settings_unset leaves a setting out. */
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
 * file and line. Files that CLSHEAR_ENVIRONMENT, _APERTURE and _TO name are looked for beside the
 * settings file first, then in the current folder. */
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
    size_t struct_size;   /* set by the library */
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
 * launches; when it does not return 0, `show` gets the picture so far, with complete == 0. This
 * film is owned by the library and valid during the call only. Both are called in the rendering
 * thread. NULL: no calls. */
CLSHEAR_API void clshear_settings_set_preview(clshear_settings *settings, int (*wanted)(void *user),
                                              void (*show)(void *user, clshear_film *film),
                                              void *user);

#ifdef __cplusplus
}
#endif

#endif
