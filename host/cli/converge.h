#ifndef CS_CLI_CONVERGE_H
#define CS_CLI_CONVERGE_H

#include "cli/flags.h"
#include "cli/job.h"
#include "cli/series.h"

enum {
    CLI_MOST_NAMES = 16,
    CLI_MOST_PIXELS = 16
};

/* Begins with a cli_job: the flags of rendering write there. */
typedef struct cli_converge_job {
    cli_job render;
    clshear_integrand integrand;
    const char *integrand_name; /* NULL: pixels of a scene */
    double size;
    int size_given;
    int pixels[CLI_MOST_PIXELS][2];
    int pixel_count;
    char *samplers[CLI_MOST_NAMES];
    int sampler_count;
    clshear_shear shears[3];
    char *shear_names[3]; /* these two live as long as the process */
    int shear_count;
    uint32_t counts[CLI_MOST_SIZES];
    int size_count;
    uint32_t replicates;
    double reference;
    int has_reference;
    const char *reference_image; /* NULL: a number */
    const char *outputs[CLI_MAX_OUTPUTS];
    int output_count;
    cli_plot plot;
} cli_converge_job;

/* What the command takes, with the flags of rendering. `flags`: room for CLI_MOST_FLAGS. */
cli_command cli_converge_command(cli_flag *flags);

/* Its help, with its own flags only. */
extern const cli_command cli_converge_help;

/* The command `clshear converge`; argv[0] is its name. Returns the exit status. */
int cli_converge(int argc, char **argv);

#endif
