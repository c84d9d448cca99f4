#ifndef CS_CLI_SPECTRUM_H
#define CS_CLI_SPECTRUM_H

/* The command `clshear spectrum`; argv[0] is its name. Returns the exit status. */
int cli_spectrum(int argc, char **argv);

#endif
