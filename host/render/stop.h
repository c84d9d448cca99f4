/* Rules that end a render when it is good enough, or when its time is over. Which samples are drawn
 * next depends on the picture as a whole and never on a pixel, so that the samples of a pixel stay
 * those of its pattern. */
#ifndef CS_RENDER_STOP_H
#define CS_RENDER_STOP_H

#include "clshear/device/dialect.h"
#include "settings/settings.h"

/* What was seen when the render was looked at. */
typedef struct cs_look {
    double samples; /* of a pattern, or patterns; 0: there was no look */
    double noise;   /* cs_noise_of_picture */
    double pixels;  /* cs_noise_of_pixels */
} cs_look;

typedef enum cs_stop_reason {
    CS_STOP_SAMPLES, /* all samples are drawn */
    CS_STOP_NOISE,
    CS_STOP_PIXELS,
    CS_STOP_TIME
} cs_stop_reason;

typedef struct cs_stop {
    double noise; /* what is promised; 0: nothing */
    double pixels;
    double time_s;
    cs_look last;
    cs_look before; /* the look before that */
    cs_stop_reason reason;
} cs_stop;

/* The work that may be stopped, in samples of a pattern or in patterns. */
typedef struct cs_work {
    cs_u32 done;
    cs_u32 first; /* size of the first round */
    cs_u32 grain; /* rounds are multiples of this */
    cs_u32 most;
    double left_s;      /* time that is left; not read where no time is set */
    double units_per_s; /* 0: unknown */
} cs_work;

cs_stop cs_stop_of(const clshear_settings *settings);
int cs_stop_has_rules(const cs_stop *stop);

/* Notes a look, and whether a promise is kept: sets the reason, and returns 1, or 0. */
int cs_stop_look(cs_stop *stop, const cs_look *look);

/* The work after which to look again; as much as is done if the time is over, which sets the
 * reason. At most a doubling. Less where the slope between the last looks says that a promise will
 * be kept before, and where the time ends before. */
cs_u32 cs_stop_next(cs_stop *stop, const cs_work *work);

/* The work at which a promise will be kept, by that slope; infinite if nothing tells. */
double cs_stop_expected(const cs_stop *stop);

const char *cs_stop_words(cs_stop_reason reason);

#endif
