#include "render/stop.h"

#include <math.h>

/* The last part of a time is left unused where it is too short to be worth a round. */
static const double least_round = 0.05, time_reserve = 0.97;

cs_stop cs_stop_of(const clshear_settings *settings)
{
    /* Those that are not set are zero. */
    return (cs_stop){.noise = cs_number(settings, NOISE),
                     .pixels = cs_number(settings, NOISE_PIXEL),
                     .time_s = cs_number(settings, TIME)};
}

int cs_stop_has_rules(const cs_stop *stop)
{
    return stop->noise > 0.0 || stop->pixels > 0.0 || stop->time_s > 0.0;
}

int cs_stop_look(cs_stop *stop, const cs_look *look)
{
    stop->before = stop->last;
    stop->last = *look;
    if (stop->noise > 0.0 && look->noise <= stop->noise)
        stop->reason = CS_STOP_NOISE;
    else if (stop->pixels > 0.0 && look->pixels <= stop->pixels)
        stop->reason = CS_STOP_PIXELS;
    else
        return 0;
    return 1;
}

/* Where noise that is `last` after `samples`, and was `before`, comes down to `goal`. Noise falls
 * as a power of the samples: between -1/2, independent samples, and -1, stratified ones of smooth
 * pixels; at the first look as independent ones. */
static double expected(double goal, double last, double before, const cs_stop *stop)
{
    double slope = 0.5;
    if (!(goal > 0.0)) return INFINITY;
    if (stop->before.samples > 0.0 && last > 0.0)
        slope = log(before / last) / log(stop->last.samples / stop->before.samples);
    slope = slope > 0.5 ? fmin(slope, 1.0) : 0.5;
    return stop->last.samples * pow(last / goal, 1.0 / slope);
}

double cs_stop_expected(const cs_stop *stop)
{
    if (!(stop->last.samples > 0.0)) return INFINITY;
    return fmin(expected(stop->noise, stop->last.noise, stop->before.noise, stop),
                expected(stop->pixels, stop->last.pixels, stop->before.pixels, stop));
}

cs_u32 cs_stop_next(cs_stop *stop, const cs_work *work)
{
    const double done = work->done;
    double next = work->done == 0 ? work->first : 2.0 * done;
    /* Steps of an eighth at least: each look is one more chance to stop too early. */
    if (work->done > 0) next = fmin(next, fmax(cs_stop_expected(stop), 1.125 * done));
    next = work->grain * ceil(next / work->grain);
    if (stop->time_s > 0.0 && work->units_per_s > 0.0) {
        const double affordable = done + work->grain * floor(time_reserve * work->left_s *
                                                             work->units_per_s / work->grain);
        if (affordable < next) next = affordable;
        if (next < done * (1.0 + least_round) || next <= done) {
            stop->reason = CS_STOP_TIME;
            return work->done;
        }
    }
    return next < work->most ? (cs_u32)next : work->most;
}

const char *cs_stop_words(cs_stop_reason reason)
{
    static const char *const words[] = {"spp", "noise", "noise-pixel", "time"};
    return words[reason];
}
