/* Plots, by gnuplot. */
#ifndef CS_PROGRAM_REPORT_PLOT_H
#define CS_PROGRAM_REPORT_PLOT_H

#include <stdio.h>

typedef struct plot_files {
    const char *path; /* .png or .svg; NULL: no plot */
    int keep;         /* leave data and script beside the plot, as PATH.dat and PATH.gp */
} plot_files;

/* Draws: `write_data` writes the data file, `write_curves` a gnuplot script that plots the file
 * called by the string variable `data`, without terminal and output. Without gnuplot one line says
 * so, and only what `keep` leaves is written. Returns EXIT_DONE or
 * EXIT_FAILED. */
int plot_draw(const plot_files *plot, void (*write_data)(FILE *stream, const void *user),
              void (*write_curves)(FILE *stream, const void *user), const void *user);

/* Gnuplot style of curve number `index`: colours that the colour-blind tell apart (Okabe & Ito
 * 2008). */
const char *plot_colour(int index);

#endif
