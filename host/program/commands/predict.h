/* What `clshear predict` is asked: of an integrand of the unit square, or of a pixel of a scene. */
#ifndef CS_PROGRAM_COMMANDS_PREDICT_H
#define CS_PROGRAM_COMMANDS_PREDICT_H

#include "commands/point_source.h"

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
} predict_job;

/* A variance that was measured. */
typedef struct measurement {
    double variance;
    double error;
} measurement;

/* Of a pixel. Returns the exit status. */
int predict_pixel(predict_job *job);

#endif
