/* The program: the first word may name a command, otherwise a scene is rendered. */
#include <string.h>

#include "cli/converge.h"
#include "cli/points.h"
#include "cli/predict.h"
#include "cli/render.h"
#include "cli/slice.h"
#include "cli/spectrum.h"

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        int (*run)(int argc, char **argv);
    } commands[] = {{"points", cli_points},
                    {"spectrum", cli_spectrum},
                    {"converge", cli_converge},
                    {"predict", cli_predict},
                    {"slice", cli_slice_run}};
    for (size_t i = 0; argc > 1 && i < sizeof commands / sizeof *commands; i++)
        if (strcmp(argv[1], commands[i].name) == 0) return commands[i].run(argc - 1, argv + 1);
    return cli_render(argc, argv);
}
