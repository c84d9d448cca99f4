#include "cli/parse.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/job.h"

/* Text of a settings file, kept to the end of the process, since the job points into it; and its
 * flags as they would stand on a line. */
static char *settings_text, *settings_words;

const char *cli_settings_words(void)
{
    return settings_words != NULL ? settings_words : "";
}

/* Appends a flag to the settings' words, as long as there is memory. */
static void note_setting(const char *name, size_t length, const char *value)
{
    const size_t used = settings_words != NULL ? strlen(settings_words) : 0;
    const size_t size = used + length + (value != NULL ? strlen(value) : 0) + 8;
    char *longer = realloc(settings_words, size);
    if (longer == NULL) return;
    snprintf(longer + used, size - used, "%s--%.*s%s%s", used > 0 ? " " : "", (int)length, name,
             value != NULL ? " " : "", value != NULL ? value : "");
    settings_words = longer;
}

static int complain(const char *place, const char *format, const char *a, const char *b)
{
    fprintf(stderr, "clshear: %s", place);
    fprintf(stderr, format, a, b);
    fputc('\n', stderr);
    return CLI_USAGE;
}

/* Applies one flag. `place` starts the message: "" or "FILE:LINE: ". */
static int apply(const cli_command *command, void *job, const char *place, const char *name,
                 size_t length, const char *value)
{
    char shown[64];
    snprintf(shown, sizeof shown, "%.*s", (int)length, name);
    const cli_flag *flag = cli_find_flag(command, name, length);
    if (flag == NULL) {
        const char *nearest = cli_nearest_flag(command, name, length);
        return nearest != NULL
                   ? complain(place, "unknown flag --%s; did you mean --%s?", shown, nearest)
                   : complain(place, "unknown flag --%s%s; see --help", shown, "");
    }
    if (flag->argument != NULL && value == NULL)
        return complain(place, "--%s needs a value: %s", shown, flag->argument);
    if (flag->argument == NULL && value != NULL)
        return complain(place, "--%s takes no value, not \"%s\"", shown, value);
    const char *wanted = flag->store(job, value);
    if (wanted == NULL) return CLI_DONE;
    char named[128];
    snprintf(named, sizeof named, "--%.40s %.60s", shown, value);
    return complain(place, "%s: must be %s", named, wanted);
}

/* One line of a settings file: "--flag value" or "flag value", "#" starts a comment. */
static int apply_line(const cli_command *command, void *job, char *line, const char *file,
                      int number)
{
    char place[4200];
    snprintf(place, sizeof place, "%s:%d: ", file, number);
    char *comment = strchr(line, '#');
    if (comment != NULL) *comment = '\0';
    line += strspn(line, " \t-");
    size_t end = strlen(line);
    while (end > 0 && isspace((unsigned char)line[end - 1]))
        line[--end] = '\0';
    if (*line == '\0') return CLI_DONE;
    size_t length = strcspn(line, " \t=");
    char *value = line + length;
    value += strspn(value, " \t=");
    if (*value == '\0') value = NULL;
    note_setting(line, length, value);
    return apply(command, job, place, line, length, value);
}

/* All of a text file; NULL, with errno, if it cannot be read. */
static char *read_text(const char *path)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return NULL;
    size_t size = 0, capacity = 1 << 12, got;
    char *text = malloc(capacity + 1);
    while (text != NULL && (got = fread(text + size, 1, capacity - size, stream)) > 0) {
        size += got;
        if (size < capacity) continue;
        capacity *= 2;
        char *larger = realloc(text, capacity + 1);
        if (larger == NULL) free(text);
        text = larger;
    }
    int reason = ferror(stream) ? errno : 0;
    fclose(stream);
    if (text != NULL) text[size] = '\0';
    if (reason == 0) return text;
    free(text);
    errno = reason;
    return NULL;
}

int cli_parse_settings(const cli_command *command, void *job, const char *path)
{
    settings_text = read_text(path);
    if (settings_text == NULL) {
        fprintf(stderr, "clshear: %s: cannot be read: %s\n", path, strerror(errno));
        return CLI_FAILED;
    }
    int number = 1;
    for (char *line = settings_text; line != NULL; number++) {
        char *next = strchr(line, '\n');
        if (next != NULL) *next++ = '\0';
        int code = apply_line(command, job, line, path, number);
        if (code != CLI_DONE) return code;
        line = next;
    }
    return CLI_DONE;
}

int cli_parse_words(const cli_command *command, void *job, int argc, char **argv,
                    const char **operands)
{
    int found = 0;
    for (int i = 1; i < argc; i++) {
        const char *word = argv[i];
        if (word[0] != '-' || word[1] == '\0') {
            if (found == command->most_operands)
                return found > 0 ? complain("", "more than one scene: %s and %s", operands[0], word)
                                 : complain("", "%s: not a flag%s", word, "");
            operands[found++] = word;
            continue;
        }
        const char *name = word + (word[1] == '-' ? 2 : 1);
        size_t length = strcspn(name, "=");
        const char *value = name[length] == '=' ? name + length + 1 : NULL;
        const cli_flag *flag = cli_find_flag(command, name, length);
        if (value == NULL && flag != NULL && flag->argument != NULL && i + 1 < argc)
            value = argv[++i];
        int code = apply(command, job, "", name, length, value);
        if (code != CLI_DONE) return code;
    }
    return CLI_DONE;
}
