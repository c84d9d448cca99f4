/* clshear points: point sets in and out. */
#ifndef CS_CLI_POINTS_H
#define CS_CLI_POINTS_H

/* Makes the point sets that the words ask for; argv[0] is the command's name. Returns the exit
 * code. */
int cli_points(int argc, char **argv);

#endif
