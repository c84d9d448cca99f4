/* Plots, by gnuplot. */
#ifndef CS_CLI_PLOT_H
#define CS_CLI_PLOT_H

#include <stdio.h>

typedef struct cli_plot {
    const char *path; /* .png or .svg; NULL: no plot */
    int keep;         /* leave data and script beside the plot, as PATH.dat and PATH.gp */
} cli_plot;

/* For store functions: NULL, or what the name should have been. */
const char *cli_read_plot_path(const char *value, const char **path);

/* Draws: `write_data` writes the data file, `write_curves` a gnuplot script that plots the file
 * called by the string variable `data`, without terminal and output. Without gnuplot one line says
 * so, and only what `keep` leaves is written. Returns CLI_DONE or CLI_FAILED. */
int cli_plot_draw(const cli_plot *plot, void (*write_data)(FILE *stream, const void *user),
                  void (*write_curves)(FILE *stream, const void *user), const void *user);

/* Gnuplot style of curve number `index`: colours that the colour-blind tell apart (Okabe & Ito
 * 2008). */
const char *cli_plot_colour(int index);

#endif
