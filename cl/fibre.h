/* Fibres through any filter and any profile of the lens: one axis of the equal-area shear. Shared.
 *
 * The fibre coordinate is t = X + blur * U, X distributed as the pixel filter, U as the profile.
 * The filter is constant on steps [x_k, x_k+1] with density f_k, so with C the mass of the profile
 * and H its integral P(T < t) = sum of f_k * blur * (H((t - x_k) / blur) - H((t - x_k+1) / blur)),
 * and what the steps have of the density at t are f_k * (C((t - x_k) / blur) - C((t - x_k+1) /
 * blur)). */
#ifndef CS_FIBRE_H
#define CS_FIBRE_H

#include "profile.h"

/* The x with P(X < x) = mass, centred. */
CS_INLINED vfloat cs_filter_quantile(const cs_optics *optics, cs_optics_table table, vfloat mass)
{
    f32 step = optics->filter_width / (f32)optics->filter_steps;
    f32 below = 0.0f;
    vfloat rest = mass, density = (vfloat)(table[0]),
           start = (vfloat)(-0.5f * optics->filter_width);
    for (u32 k = 1u; k < optics->filter_steps; k++) {
        below += table[k - 1u] * step;
        vint right = mass >= below;
        rest = right ? mass - below : rest;
        density = right ? (vfloat)(table[k]) : density;
        start = right ? (vfloat)((f32)k * step - 0.5f * optics->filter_width) : start;
    }
    return start + cs_min(rest / density, (vfloat)(step));
}

typedef struct cs_fibre_axis {
    const cs_optics *optics;
    cs_optics_table table;
    const cs_profile *profile;
    vfloat blur; /* above 0 */
    vfloat inverse;
} cs_fibre_axis;

typedef struct cs_fibre_mass {
    vfloat below; /* P(T < t) */
    vfloat density;
    vfloat slope; /* of the density */
} cs_fibre_mass;

CS_INLINED cs_fibre_mass cs_fibre_at(const cs_fibre_axis *axis, vfloat t)
{
    const cs_optics *optics = axis->optics;
    f32 step = optics->filter_width / (f32)optics->filter_steps;
    vfloat edge = t + 0.5f * optics->filter_width;
    cs_profile_mass right = cs_profile_at(axis->profile, edge * axis->inverse);
    cs_fibre_mass mass;
    mass.below = (vfloat)(0.0f);
    mass.density = (vfloat)(0.0f);
    mass.slope = (vfloat)(0.0f);
    for (u32 k = 0u; k < optics->filter_steps; k++) {
        edge -= step;
        cs_profile_mass left = cs_profile_at(axis->profile, edge * axis->inverse);
        mass.below += axis->table[k] * (right.integral - left.integral);
        mass.density += axis->table[k] * (right.below - left.below);
        mass.slope += axis->table[k] * (right.density - left.density);
        right = left;
    }
    mass.below *= axis->blur;
    mass.slope *= axis->inverse;
    return mass;
}

/* What the quantiles of film and lens allow for that of their sum, and a guess that would be exact
 * for normal distributions. */
typedef struct cs_fibre_guess {
    vfloat low;
    vfloat high;
    vfloat t;
} cs_fibre_guess;

CS_INLINED cs_fibre_guess cs_fibre_guess_at(const cs_fibre_axis *axis, vfloat mass)
{
    const cs_optics *optics = axis->optics;
    const cs_profile *profile = axis->profile;
    vfloat lens = axis->blur * cs_profile_quantile(profile, mass);
    vfloat film = cs_filter_quantile(optics, axis->table, mass);
    f32 half_width = 0.5f * optics->filter_width;
    vfloat spread = axis->blur * profile->deviation;
    vfloat both = cs_sqrt(spread * spread + optics->filter_deviation * optics->filter_deviation);
    cs_fibre_guess guess;
    guess.low = cs_max(lens - half_width, film + axis->blur * profile->low);
    guess.high = cs_min(lens + half_width, film + axis->blur * profile->high);
    guess.t =
        cs_clamp((optics->filter_deviation * film + spread * lens) / both, guess.low, guess.high);
    return guess;
}

/* The t with P(T < t) = mass where the density has one hump: Halley's steps from the side of the
 * smaller tail. A smooth filter takes one, in the tails two, a box two: errors of the mass are 1e-6
 * on average, 3e-4 at most, and 1e-3 in a few places of unsymmetric polygons. */
CS_INLINED vfloat cs_fibre_quantile_of_hump(const cs_fibre_axis *axis, vfloat mass)
{
    cs_fibre_guess guess = cs_fibre_guess_at(axis, mass);
    vint right = mass > 0.5f;
    vfloat root = cs_sqrt(cs_max(right ? 1.0f - mass : mass, (vfloat)(1e-9f)));
    vint tail = cs_abs(mass - 0.5f) > (axis->optics->filter_steps > 1u ? 0.4375f : -1.0f);
    vfloat t = guess.t;
    for (int step = 0; step < 2 && (step == 0 || cs_any(tail)); step++) {
        cs_fibre_mass at = cs_fibre_at(axis, t);
        vfloat move = cs_root_step_of(root, right ? 1.0f - at.below : at.below, at.density,
                                      right ? -at.slope : at.slope)
                          .back;
        vfloat next = cs_clamp(right ? t + move : t - move, guess.low, guess.high);
        if (step == 0)
            t = next;
        else
            t = tail ? next : t;
    }
    return t;
}

/* The same for any density: Newton's steps in brackets, until the mass is right by 1e-6 and what
 * the integrals lose in rounding, 1e-7 * blur / filter width. */
CS_INLINED vfloat cs_fibre_quantile_of_any(const cs_fibre_axis *axis, vfloat mass)
{
    cs_fibre_guess guess = cs_fibre_guess_at(axis, mass);
    vfloat tolerance = 1e-6f + (1e-7f / axis->optics->filter_width) * axis->blur;
    for (int step = 0; step < 16; step++) {
        cs_fibre_mass at = cs_fibre_at(axis, guess.t);
        vfloat excess = at.below - mass;
        vint wrong = cs_abs(excess) > tolerance;
        if (!cs_any(wrong)) break;
        guess.high = excess > 0.0f ? guess.t : guess.high;
        guess.low = excess > 0.0f ? guess.low : guess.t;
        vfloat next = guess.t - excess / cs_max(at.density, (vfloat)(1e-9f));
        vfloat middle = 0.5f * (guess.low + guess.high);
        vint inside = (next > guess.low) & (next < guess.high);
        next = inside ? next : middle;
        guess.t = wrong ? next : guess.t; /* whatever the other lanes of the packet need */
    }
    return guess.t;
}

/* Where on the fibre t: returns the lens coordinate, and x through `x`. `along` in [0, 1) chooses
 * the filter's step and then the place on it. */
CS_INLINED vfloat cs_fibre_place(const cs_fibre_axis *axis, vfloat t, vfloat along, vfloat *x)
{
    const cs_optics *optics = axis->optics;
    const cs_profile *profile = axis->profile;
    f32 step = optics->filter_width / (f32)optics->filter_steps;
    vfloat edge = t + 0.5f * optics->filter_width; /* t - x_k, going down */
    vfloat rest = along * cs_fibre_at(axis, t).density;
    vfloat wanted = rest, sum = (vfloat)(0.0f), density = (vfloat)(axis->table[0]);
    /* At the very ends no step has any mass in floats: then the outermost. */
    vfloat top = t > 0.0f ? t - 0.5f * optics->filter_width + step : edge;
    vfloat right = cs_profile_at(profile, edge * axis->inverse).below;
    for (u32 k = 0u; k < optics->filter_steps; k++) {
        vfloat left = cs_profile_at(profile, (edge - step) * axis->inverse).below;
        vfloat mass = axis->table[k] * (right - left);
        vint here = (wanted >= sum) & (mass > 0.0f);
        rest = here ? wanted - sum : rest;
        top = here ? edge : top;
        density = here ? (vfloat)(axis->table[k]) : density;
        edge -= step;
        sum += mass;
        right = left;
    }
    vfloat above = cs_profile_at(profile, top * axis->inverse).below;
    vfloat below = cs_profile_at(profile, (top - step) * axis->inverse).below;
    vfloat lens = cs_profile_quantile(profile, cs_max(above - rest / density, below));
    lens = cs_clamp(lens, (top - step) * axis->inverse, top * axis->inverse);
    lens = cs_clamp(lens, (vfloat)(profile->low), (vfloat)(profile->high));
    *x = t - axis->blur * lens;
    *x = cs_clamp(*x, t - top, t - top + step);
    return lens;
}

CS_INLINED vfloat cs_fibre_map_known(const cs_fibre_axis *axis, vfloat across, vfloat along,
                                     vfloat *x)
{
    vfloat t = axis->profile->kind == CS_PROFILE_IMAGE ? cs_fibre_quantile_of_any(axis, across)
                                                       : cs_fibre_quantile_of_hump(axis, across);
    return cs_fibre_place(axis, t, along, x);
}

/* One axis of the map for a signed shear. Loops over the filter's steps are compiled for each kind
 * of profile by itself. */
CS_INLINED vfloat cs_fibre_map(cs_fibre_axis axis, vfloat across, vfloat along, int negative,
                               vfloat *x)
{
    cs_profile profile = *axis.profile;
    vfloat lens;
    axis.profile = &profile;
    across = negative ? 1.0f - across : across;
    if (profile.kind == CS_PROFILE_UNIFORM) {
        profile.kind = CS_PROFILE_UNIFORM;
        lens = cs_fibre_map_known(&axis, across, along, x);
    } else if (profile.kind == CS_PROFILE_DISK) {
        profile.kind = CS_PROFILE_DISK;
        lens = cs_fibre_map_known(&axis, across, along, x);
    } else if (profile.kind == CS_PROFILE_POLYGON) {
        profile.kind = CS_PROFILE_POLYGON;
        lens = cs_fibre_map_known(&axis, across, along, x);
    } else {
        profile.kind = CS_PROFILE_IMAGE;
        lens = cs_fibre_map_known(&axis, across, along, x);
    }
    if (negative) *x = -*x;
    return lens;
}

#endif
