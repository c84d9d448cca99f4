/* What a command writes, against what it reads. */
#ifndef CS_PROGRAM_COMMANDS_OUTPUTS_H
#define CS_PROGRAM_COMMANDS_OUTPUTS_H

#include "options/options.h"
#include "report/output.h"

enum {
    SETTING_TEXT = 4096 /* bytes, for the text of a setting with its end */
};

/* Finds out before long work whether the outputs can be written, are different files, and replace
 * neither the scene nor a file that a flag names to be read. Settings do not keep the path of an
 * aperture's image: it is known from the command line only, not from a settings file. Returns an
 * exit status, with a line printed if it is not EXIT_DONE. */
int check_outputs(const program_options *options, const output_files *files);

/* The text of a setting in `text`; NULL if it is not set. */
const char *setting_text(const clshear_settings *settings, clshear_setting setting,
                         char text[SETTING_TEXT]);

/* What the command line gives a flag, the last time; NULL where it does not. */
const char *value_on_line(const program_options *options, const char *name);

#endif
