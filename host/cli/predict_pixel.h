/* The command `clshear predict SCENE --pixel X,Y`. */
#ifndef CS_CLI_PREDICT_PIXEL_H
#define CS_CLI_PREDICT_PIXEL_H

/* argv[0] is the command's name. Returns the exit status. */
int cli_predict_pixel(int argc, char **argv);

#endif
