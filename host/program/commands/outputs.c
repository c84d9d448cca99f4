#include "commands/outputs.h"

#include <string.h>

#include "report/failure.h"

const char *value_on_line(const program_options *options, const char *name)
{
    const size_t length = strlen(name);
    const char *value = NULL;
    for (int i = 1; i < options->word_count && strcmp(options->words[i], "--") != 0; i++) {
        const char *word = options->words[i];
        if (*word != '-') continue;
        word += word[1] == '-' ? 2 : 1;
        if (strncmp(word, name, length) != 0) continue;
        if (word[length] == '=') value = word + length + 1;
        if (word[length] == '\0') value = i + 1 < options->word_count ? options->words[i + 1] : "";
    }
    return value;
}

const char *setting_text(const clshear_settings *settings, clshear_setting setting,
                         char text[SETTING_TEXT])
{
    *text = '\0';
    if (clshear_settings_is_set(settings, setting))
        clshear_settings_get_text(settings, setting, text, SETTING_TEXT);
    return *text != '\0' ? text : NULL;
}

int check_outputs(const program_options *options, const output_files *files)
{
    char sky[SETTING_TEXT], end[SETTING_TEXT];
    const struct {
        const char *owner;
        const char *path;
    } inputs[] = {{"the scene", options->scene},
                  {"the settings", options->file},
                  {"--environment", setting_text(options->settings, CLSHEAR_ENVIRONMENT, sky)},
                  {"--to", setting_text(options->settings, CLSHEAR_TO, end)},
                  {"--aperture", value_on_line(options, "aperture")}};
    int code = outputs_check(files);
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs && code == EXIT_DONE; i++)
        if (inputs[i].path != NULL)
            code = outputs_spare(files, inputs[i].owner, &inputs[i].path, 1);
    return code;
}
