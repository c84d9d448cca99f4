/* A target for libFuzzer: the bytes as a settings file, and what is set printed and read again. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "settings/settings.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* An aperture's image, which is not read here. */
clshear_status cs_image_read_luminance(const char *path, int most, float **luminance, int *width,
                                       int *height, cs_error *error)
{
    (void)most, (void)luminance, (void)width, (void)height;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%.100s: no images here", path);
}

static int accept(void *user, const char *file, int line, const char *name, const char *value)
{
    (void)user, (void)file, (void)line, (void)name, (void)value;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char path[] = "/tmp/clshear_settings_XXXXXX";
    static int is_open;
    clshear_settings settings = {0}, copy = {0};
    cs_error error;
    char text[4096];
    if (!is_open && mkstemp(path) < 0) abort();
    is_open = 1;
    FILE *stream = fopen(path, "wb");
    if (stream == NULL) abort();
    if (size > 0) fwrite(data, 1, size, stream);
    fclose(stream);
    if (cs_settings_init(&settings, &error) != CLSHEAR_OK) abort();
    if (cs_settings_init(&copy, &error) != CLSHEAR_OK) abort();
    cs_settings_read(&settings, path, accept, NULL, &error);
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        if (!settings.values[i].is_set) continue;
        cs_settings_print(&settings, i, text, sizeof text);
        if (cs_setting_table[i].most == 1) cs_settings_set_text(&copy, i, text, &error);
    }
    cs_settings_override(&copy, &settings, &error);
    cs_settings_free(&settings);
    cs_settings_free(&copy);
    return 0;
}
