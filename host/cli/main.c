/* The program: the first word may name a command, otherwise a scene is rendered. */
#include <string.h>

#include "cli/points.h"
#include "cli/render.h"

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "points") == 0) return cli_points(argc - 1, argv + 1);
    return cli_render(argc, argv);
}
