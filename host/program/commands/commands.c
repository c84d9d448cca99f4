#include "commands/commands.h"

#include <stdlib.h>

#include "commands/help.h"
#include "report/failure.h"

const program_command *const all_commands[] = {
    &render_command,  &points_command,   &spectrum_command, &slice_command,
    &predict_command, &converge_command, &merge_command,    NULL};

int command_run(const program_command *command, int argc, char **argv)
{
    program_options *options = calloc(1, command->job_size);
    if (options == NULL) return complain(EXIT_FAILED, "out of memory");
    int code = options_parse(command, &render_command, argc, argv, options);
    if (code == EXIT_DONE && options->help)
        print_help(command);
    else if (code == EXIT_DONE)
        code = command->run(options);
    options_free(options);
    free(options);
    return code;
}
