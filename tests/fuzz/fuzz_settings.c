/* The bytes as a settings file, and what is set printed and read again. */
#include <stdlib.h>

#include "settings/settings.h"
#include "targets.h"

clshear_status __wrap_cs_image_read_luminance(const char *path, int most, float **luminance,
                                              int *width, int *height, cs_error *error);

/* The linker puts this in the place of cs_image_read_luminance (--wrap): the bytes would name any
 * file as the image of an aperture. */
clshear_status __wrap_cs_image_read_luminance(const char *path, int most, float **luminance,
                                              int *width, int *height, cs_error *error)
{
    (void)most, (void)luminance, (void)width, (void)height;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%.100s: no images here", path);
}

static int accept(void *user, const char *file, int line, const char *name, const char *value)
{
    (void)user, (void)file, (void)line, (void)name, (void)value;
    return 0;
}

void cs_fuzz_settings(const uint8_t *data, size_t size)
{
    clshear_settings settings = {0}, copy = {0};
    cs_error error;
    char text[4096];
    const char *path = cs_fuzz_file("x.flags", data, size);
    if (cs_settings_init(&settings, &error) != CLSHEAR_OK) abort();
    if (cs_settings_init(&copy, &error) != CLSHEAR_OK) abort();
    cs_settings_read(&settings, path, accept, NULL, &error);
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        if (!settings.values[i].is_set) continue;
        cs_settings_print(&settings, i, text, sizeof text);
        if (cs_setting_table[i].most == 1 &&
            cs_settings_set_text(&copy, i, text, &error) != CLSHEAR_OK)
            abort(); /* what was set is printed in a form that can be set */
    }
    cs_settings_override(&copy, &settings, &error);
    cs_settings_free(&settings);
    cs_settings_free(&copy);
}
