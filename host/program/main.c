/* The program: the first word may name a command, otherwise a scene is rendered. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "commands/commands.h"
#include "report/failure.h"
#include "report/progress.h"

static int run(int argc, char **argv)
{
    for (size_t i = 1; argc > 1 && all_commands[i] != NULL; i++)
        if (strcmp(argv[1], all_commands[i]->name) == 0)
            return command_run(all_commands[i], argc - 1, argv + 1);
    return command_run(all_commands[0], argc, argv);
}

int main(int argc, char **argv)
{
    progress_note_signals();
    const int code = run(argc, argv);
    if (code != EXIT_DONE || (fflush(stdout) == 0 && !ferror(stdout))) return code;
    return complain(EXIT_FAILED, "standard output: cannot be written: %s", strerror(errno));
}
