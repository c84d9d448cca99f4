#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "options/options.h"
#include "report/failure.h"
#include "report/words.h"

static const program_flag common_rows[] = {
    TEXT_FLAG("settings", "FILE", "read flags from FILE (SCENE.flags if it exists)", "",
              offsetof(program_options, settings_file), ""),
    SWITCH_FLAG("quiet q", "no progress and no remarks, only errors",
                offsetof(program_options, quiet)),
    SWITCH_FLAG("help h", "print this and stop", offsetof(program_options, help)),
};
/* The first of them for commands without a scene, beside which settings may lie. */
static const program_flag settings_without_scene = TEXT_FLAG(
    "settings", "FILE", "read flags from FILE", "", offsetof(program_options, settings_file), "");
enum {
    SETTINGS_ROW = 0,
    HELP_ROW = 2,
    COMMON_ROWS = sizeof common_rows / sizeof *common_rows,
    MOST_SETTINGS = 128
};

typedef struct parser {
    const program_command *command;
    const program_command *renders;
    program_options *options;
    clshear_settings *settings; /* that are being read: the line's or the file's */
    uint64_t on_line;           /* bit of each row of the command that the line gives */
    int code;
} parser;

/* What the library refused. */
static int complain_status(clshear_status status, const char *before)
{
    const int is_usage = status == CLSHEAR_BAD_ARGUMENT;
    return complain(is_usage ? EXIT_USAGE : EXIT_FAILED, "%s%s", is_usage ? before : "",
                    clshear_message());
}

static int takes_setting(const program_command *command, const clshear_setting_info *setting)
{
    for (size_t i = 0; i < command->flag_count; i++)
        if (has_word(command->flags[i].names, setting->name, strlen(setting->name))) return 0;
    if (command->settings == NULL) return 1;
    for (size_t i = 0; i < command->setting_count; i++)
        if (command->settings[i] == setting->setting) return 1;
    return 0;
}

/* Row `index` of those that all commands have. */
static const program_flag *common_row(const program_command *command, size_t index)
{
    return index == SETTINGS_ROW && !command->takes_scene ? &settings_without_scene
                                                          : &common_rows[index];
}

static const char *argument_of(const named_flag *flag)
{
    const char *argument = flag->row != NULL ? flag->row->argument : flag->setting.argument;
    return argument != NULL ? argument : "";
}

int command_flag(const program_command *command, size_t index, named_flag *flag)
{
    const size_t rows = command->flag_count + COMMON_ROWS;
    *flag = (named_flag){.setting = {.struct_size = sizeof flag->setting}};
    if (index < rows)
        flag->row = index < command->flag_count ? &command->flags[index]
                                                : common_row(command, index - command->flag_count);
    size_t left = index < rows ? 0 : index - rows;
    for (size_t i = 0; index >= rows && clshear_setting_describe(i, &flag->setting); i++)
        if (takes_setting(command, &flag->setting) && left-- == 0) return 1;
    return index < rows;
}

/* Whether a command has the flag; otherwise `nearest` becomes a name like that, or "". */
static int find(const parser *p, const program_command *command, const char *name, named_flag *flag,
                const char **nearest)
{
    const size_t length = strlen(name);
    size_t best = length / 2 + 2 < 4 ? length / 2 + 2 : 4;
    *nearest = "";
    for (size_t i = 0; command_flag(command, i, flag); i++) {
        const char *names =
            flag->row != NULL
                ? flag->row->names
                : options_text(p->options, "%s %s", flag->setting.name, flag->setting.aliases);
        if (has_word(names, name, length)) return 1;
        for (size_t size = next_word(&names); size > 0; size = next_word(&names)) {
            const size_t edits = word_distance(name, length, names, size);
            const int begins = length > 1 && length < size && strncmp(name, names, length) == 0;
            if (size > 1 && (begins ? best > 0 : edits < best)) {
                best = begins ? 0 : edits;
                *nearest = options_text(p->options, "%.*s", (int)size, names);
            }
            names += size;
        }
    }
    return 0;
}

/* What a name like "no-adaptive" means: "adaptive=0", or NULL. */
static const char *negation_of(const parser *p, const char *name)
{
    named_flag flag;
    const char *nearest;
    if (strncmp(name, "no-", 3) != 0 || !find(p, p->command, name + 3, &flag, &nearest) ||
        flag.row != NULL || *argument_of(&flag) != '\0')
        return NULL;
    return options_text(p->options, "%s=0", flag.setting.name);
}

/* `dashes`: those before the name, as they were given. */
static int complain_unknown(const parser *p, const char *place, const char *dashes,
                            const char *name, const char *nearest)
{
    const char *negation = negation_of(p, name);
    if (negation != NULL) nearest = negation;
    if (*nearest == '\0')
        return complain(EXIT_USAGE, "%sunknown flag %s%s; see --help", place, dashes, name);
    return complain(EXIT_USAGE, "%sunknown flag %s%s; did you mean --%s?", place, dashes, name,
                    nearest);
}

/* Tells which settings were set `before` and are not now, since the flag `name` came. */
static void tell_unused(const parser *p, const char *place, const char *name, const int *before)
{
    clshear_setting_info info = {.struct_size = sizeof info};
    for (size_t i = 0; clshear_setting_describe(i, &info) && i < MOST_SETTINGS; i++)
        if (before[i] && !clshear_settings_is_set(p->settings, info.setting) && !p->options->quiet)
            remark("%s--%s is not used: --%s comes after it", place, info.name, name);
}

/* Sets a setting; alternatives that were set before it are told. */
static clshear_status set_setting(const parser *p, const char *place, const named_flag *flag,
                                  const char *name, const char *value)
{
    clshear_setting_info info = {.struct_size = sizeof info};
    int before[MOST_SETTINGS] = {0};
    for (size_t i = 0; clshear_setting_describe(i, &info) && i < MOST_SETTINGS; i++)
        before[i] = clshear_settings_is_set(p->settings, info.setting);
    const clshear_status status =
        clshear_settings_set_text(p->settings, flag->setting.setting, value != NULL ? value : "1");
    if (status == CLSHEAR_OK) tell_unused(p, place, name, before);
    return status;
}

/* Applies a flag. `place` starts the messages: "" or "FILE:LINE: ". */
static int apply(const parser *p, const char *place, const named_flag *flag, const char *name,
                 const char *value)
{
    const program_flag *row = flag->row;
    const char *argument = argument_of(flag);
    if (*argument != '\0' && value == NULL)
        return complain(EXIT_USAGE, "%s--%s needs a value: %s", place, name, argument);
    if (*argument != '\0' && *value == '\0')
        return complain(EXIT_USAGE, "%s--%s is empty: give %s, or leave it out", place, name,
                        argument);
    if (row != NULL && *argument == '\0' && value != NULL)
        return complain(EXIT_USAGE, "%s--%s takes no value, not \"%s\"", place, name, value);
    if (row == NULL) {
        const clshear_status status = set_setting(p, place, flag, name, value);
        return status == CLSHEAR_OK ? EXIT_DONE : complain_status(status, "--");
    }
    if (flag_store(p->options, row, value)) return EXIT_DONE;
    return complain(EXIT_USAGE, "%s--%s %.200s: must be %s", place, name, value,
                    flag_expectation(p->options, row));
}

/* A bit for each row of the command, and from the highest down of those of all commands. */
static uint64_t bit_of(const parser *p, const program_flag *row)
{
    for (size_t i = 0; i < p->command->flag_count; i++)
        if (row == &p->command->flags[i]) return (uint64_t)1 << i;
    size_t index = 0;
    while (row != common_row(p->command, index))
        index++;
    return (uint64_t)1 << (63 - index);
}

/* A line of a settings file that names no setting: a callback of clshear_settings_read. */
static int take_line(void *user, const char *file, int line, const char *name, const char *value)
{
    parser *p = user;
    program_options *options = p->options;
    named_flag flag;
    const char *nearest;
    const char *place = options_text(options, "%s:%d: ", file, line);
    options->file_words = options_text(options, "%s%s--%s%s%s", options->file_words,
                                       *options->file_words != '\0' ? " " : "", name,
                                       value != NULL ? " " : "", value != NULL ? value : "");
    if (find(p, p->command, name, &flag, &nearest)) {
        if (flag.row == common_row(p->command, SETTINGS_ROW) || flag.row == &common_rows[HELP_ROW])
            return p->code =
                       complain(EXIT_USAGE, "%s%s: is for the command line only", place, name);
        const int is_left_out = p->command != p->renders && flag.row->adds;
        if (!is_left_out && (p->on_line & bit_of(p, flag.row)) == 0)
            p->code = apply(p, place, &flag, name, value);
    } else if (!find(p, p->renders, name, &flag, &nearest)) {
        p->code = complain_unknown(p, place, "--", name, nearest);
    }
    return p->code;
}

/* Reads a settings file, and sets what the line has over it. */
static int read_file(parser *p, const char *path)
{
    program_options *options = p->options;
    clshear_setting_info info = {.struct_size = sizeof info};
    char value[4096];
    clshear_status status = clshear_settings_create(&p->settings);
    if (status != CLSHEAR_OK) return complain_status(status, "");
    options->file_words = "";
    status = clshear_settings_read(p->settings, path, take_line, p);
    for (size_t i = 0; status == CLSHEAR_OK && clshear_setting_describe(i, &info); i++)
        if (clshear_settings_is_set(p->settings, info.setting) &&
            clshear_settings_get_text(p->settings, info.setting, value, sizeof value) == CLSHEAR_OK)
            options->file_words = options_text(options, "%s%s--%s%s%s", options->file_words,
                                               *options->file_words != '\0' ? " " : "", info.name,
                                               *info.argument != '\0' ? " " : "=", value);
    if (status == CLSHEAR_OK) status = clshear_settings_override(p->settings, options->settings);
    clshear_settings_free(options->settings);
    options->settings = p->settings;
    if (status == CLSHEAR_OK || p->code != EXIT_DONE) return p->code;
    return complain_status(status, "");
}

/* Takes a word that is no flag: the scene, or one of the files. */
static int take_name(const parser *p, const char *word)
{
    program_options *options = p->options;
    const int takes_files = p->command->takes_files;
    if (!takes_files && !p->command->takes_scene)
        return complain(EXIT_USAGE, "%s: not a flag", *word != '\0' ? word : "an empty word");
    if (*word == '\0')
        return complain(EXIT_USAGE, "%s is empty: give the file that is to be read",
                        takes_files ? "a file's name" : "the scene's name");
    if (takes_files) {
        options->files[options->file_count++] = word;
        return EXIT_DONE;
    }
    if (options->scene != NULL)
        return complain(EXIT_USAGE, "more than one scene: %s and %s", options->scene, word);
    options->scene = word;
    return EXIT_DONE;
}

/* Words behind "--" are names, whatever they begin with. */
static int read_line(parser *p, int argc, char **argv)
{
    program_options *options = p->options;
    int only_names = 0;
    for (int i = 1; i < argc; i++) {
        named_flag flag;
        const char *word = argv[i], *nearest;
        if (!only_names && strcmp(word, "--") == 0) {
            only_names = 1;
            continue;
        }
        if (only_names || word[0] != '-' || word[1] == '\0') {
            const int code = take_name(p, word);
            if (code != EXIT_DONE) return code;
            continue;
        }
        const char *dashes = word[1] == '-' ? "--" : "-";
        word += strlen(dashes);
        const size_t length = strcspn(word, "=");
        const char *name = options_text(options, "%.*s", (int)length, word);
        const char *value = word[length] == '=' ? word + length + 1 : NULL;
        if (!find(p, p->command, name, &flag, &nearest))
            return complain_unknown(p, "", dashes, name, nearest);
        if (value == NULL && *argument_of(&flag) != '\0' && i + 1 < argc) value = argv[++i];
        if (flag.row == common_row(p->command, SETTINGS_ROW) && options->settings_file.count > 0)
            return complain(EXIT_USAGE, "--%s is given twice: put all into one file", name);
        const int code = apply(p, "", &flag, name, value);
        if (code != EXIT_DONE) return code;
        if (flag.row != NULL) p->on_line |= bit_of(p, flag.row);
    }
    return EXIT_DONE;
}

/* The settings file that the line names, or "path/scene.flags" of "path/scene.obj" if it exists;
 * else NULL. */
static const char *find_file(program_options *options)
{
    const char *scene = options->scene;
    if (options->settings_file.count > 0) return options->settings_file.items[0];
    if (scene == NULL) return NULL;
    const char *dot = strrchr(scene, '.'), *slash = strrchr(scene, '/');
    if (dot == NULL || (slash != NULL && dot < slash)) return NULL;
    const char *path = options_text(options, "%.*s.flags", (int)(dot - scene), scene);
    return access(path, F_OK) == 0 ? path : NULL;
}

int options_parse(const program_command *command, const program_command *renders, int argc,
                  char **argv, program_options *options)
{
    parser p = {.command = command, .renders = renders, .options = options};
    options->word_count = argc;
    options->words = argv;
    options->files = calloc((size_t)argc, sizeof *options->files);
    if (options->files == NULL) return complain(EXIT_FAILED, "out of memory");
    const clshear_status status = clshear_settings_create(&options->settings);
    if (status != CLSHEAR_OK) return complain_status(status, "");
    p.settings = options->settings;
    int code = read_line(&p, argc, argv);
    if (code != EXIT_DONE || options->help) return code;
    const char *file = find_file(options);
    if (file != NULL) code = read_file(&p, file);
    options->file = file;
    for (size_t i = 0; i < command->flag_count && code == EXIT_DONE; i++) {
        const program_flag *row = &command->flags[i];
        const size_t *count = (const void *)((const char *)options + row->target);
        if (*row->fallback != '\0' && *count == 0) flag_store(options, row, row->fallback);
    }
    if (code == EXIT_DONE && file != NULL && !options->quiet) remark("settings from %s", file);
    return code;
}
