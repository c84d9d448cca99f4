/* Slices of integrands as pictures and data. */
#ifndef CS_PROGRAM_REPORT_SLICE_FILES_H
#define CS_PROGRAM_REPORT_SLICE_FILES_H

#include <stddef.h>

/* What a slice shows. */
typedef struct slice_values {
    int width;
    int height;
    size_t count; /* of points: width * height, or of all four dimensions */
    float *rgb;   /* 3 floats a point */
    /* Along the fibres of the oracle's depth the first coordinate changes by -slope when the second
     * changes by 1; 0: no line is drawn. */
    double slope;
} slice_values;

/* All return EXIT_DONE, or EXIT_FAILED with a line printed. Pictures show the direction of the
 * fibres as a line. */
int slice_write_image(const slice_values *slice, const char *path);
int slice_write_npy(const slice_values *slice, const char *path);

/* The power spectrum of the means of R, G and B. */
int slice_write_spectrum(const slice_values *slice, const char *path);

#endif
