/* What `clshear predict` is asked: of an integrand of the unit square, or of a pixel of a scene. */
#ifndef CS_PROGRAM_COMMANDS_PREDICT_H
#define CS_PROGRAM_COMMANDS_PREDICT_H

#include "commands/point_source.h"
#include "commands/scene_view.h"

typedef struct predict_job {
    point_source source;
    text_list integrand;
    number_list angle;
    number_list size;
    number_list pixel; /* given: a pixel */
    number_list resolution;
    number_list block;
    number_list measure; /* sets to measure with; not given: not measured */
    text_list out;
    text_list map;  /* of a whole image */
    text_list plot; /* the same, as a scatter plot */
    int keep;
} predict_job;

/* A variance that was measured. */
typedef struct measurement {
    double variance;
    double error;
} measurement;

/* A pixel of an open scene, as a function of what a sampler draws. */
typedef struct pixel_view {
    scene_view view;
    const clshear_settings *settings;
    int x;
    int y;
    float shear_px;
    float velocity_px[2];
    int moves;  /* whether the time is a coordinate too */
    float *rgb; /* radiance on its way */
} pixel_view;

/* Predicted and measured variance of a pixel. */
typedef struct pixel_result {
    clshear_prediction *prediction; /* owned */
    size_t count;                   /* samples in a set */
    int is_measured;
    measurement shifted;  /* as predicted */
    measurement rendered; /* as samples come */
} pixel_result;

/* Opens the scene; closed by pixel_view_close in any case. Both this and the next function return
 * the exit status, with a line printed unless it is EXIT_DONE. */
int pixel_view_open(predict_job *job, pixel_view *view);
void pixel_view_close(pixel_view *view);

/* Finds the shear of pixel (x, y) of the view, predicts, and measures if asked for. `points` is
 * that of clshear_reach. */
int pixel_view_predict(const predict_job *job, pixel_view *view, size_t points,
                       pixel_result *result);

/* Of a pixel, and of all pixels of an image. Return the exit status. */
int predict_pixel(predict_job *job);
int predict_image(predict_job *job);

#endif
