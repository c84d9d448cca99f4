/* The bytes as words of a command line, one in a line; the first may be the name of a command. They
 * are parsed, not obeyed. */
#include <stdlib.h>
#include <string.h>

#include "commands/commands.h"
#include "targets.h"

enum {
    MOST_WORDS = 64
};

static const program_command *command_named(const char *name)
{
    for (size_t i = 1; all_commands[i] != NULL; i++)
        if (strcmp(name, all_commands[i]->name) == 0) return all_commands[i];
    return NULL;
}

static int split(char *text, char **words)
{
    int count = 0;
    words[count++] = "clshear";
    for (char *next = text; next != NULL && count < MOST_WORDS; count++) {
        words[count] = next;
        next = strchr(next, '\n');
        if (next != NULL) *next++ = '\0';
    }
    words[count] = NULL;
    return count;
}

void cs_fuzz_command_line(const uint8_t *data, size_t size)
{
    char *text = calloc(1, size + 1), *words[MOST_WORDS + 1];
    if (text == NULL) abort();
    if (size > 0) memcpy(text, data, size);
    const int count = split(text, words);
    const program_command *named = command_named(words[1]);
    const int skipped = named != NULL;
    const program_command *command = named != NULL ? named : all_commands[0];
    program_options *options = calloc(1, command->job_size);
    if (options == NULL) abort();
    options_parse(command, all_commands[0], count - skipped, words + skipped, options);
    options_free(options);
    free(options);
    free(text);
}
