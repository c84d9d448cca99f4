#ifndef CS_CLI_PREDICT_H
#define CS_CLI_PREDICT_H

/* The command `clshear predict`; argv[0] is its name. Returns the exit status. */
int cli_predict(int argc, char **argv);

#endif
