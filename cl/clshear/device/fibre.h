/* Fibres through any filter and a lens that is a square or an image: one axis of the equal-area
 * shear.
 *
 * The fibre coordinate is t = X + blur * U, X distributed as the pixel filter, U as the marginal.
 * The filter is constant on steps [x_k, x_k+1] with density f_k, so with C the mass of the marginal
 * and H its integral P(T < t) = sum of f_k * blur * (H((t - x_k) / blur) - H((t - x_k+1) / blur)),
 * and the density at t is the sum of f_k * (C((t - x_k) / blur) - C((t - x_k+1) / blur)). */
#ifndef CLSHEAR_DEVICE_FIBRE_H
#define CLSHEAR_DEVICE_FIBRE_H

#include "marginal.h"

#include "fp_contract_off.h"

/* A place on the film, distributed as the pixel filter. */
typedef struct cs_filter_place {
    cs_vfloat x;       /* pixels from the pixel's centre */
    cs_vfloat density; /* of the filter there, per pixel */
} cs_filter_place;

/* The place with P(X < x) = mass, for X distributed as the pixel filter, which is symmetrical, and
 * mass in [0, 1]. */
CS_INLINED cs_filter_place cs_filter_place_of(const cs_optics *optics, cs_optics_table table,
                                              cs_vfloat mass)
{
    cs_f32 step = optics->filter_width / (cs_f32)optics->filter_steps;
    cs_f32 below = 0.0f;
    cs_vfloat tail = cs_min(mass, 1.0f - mass);
    cs_vfloat rest = tail, start = (cs_vfloat)(-0.5f * optics->filter_width);
    cs_filter_place place;
    place.density = (cs_vfloat)(table[0]);
    for (cs_u32 k = 1u; k < optics->filter_steps / 2u; k++) {
        below += table[k - 1u] * step;
        cs_vint right = tail >= below;
        rest = right ? tail - below : rest;
        place.density = right ? (cs_vfloat)(table[k]) : place.density;
        start = right ? (cs_vfloat)((cs_f32)k * step - 0.5f * optics->filter_width) : start;
    }
    cs_vfloat x = start + cs_min(rest / place.density, (cs_vfloat)(step));
    place.x = mass > 0.5f ? -x : x;
    return place;
}

/* The place x alone. */
CS_INLINED cs_vfloat cs_filter_quantile(const cs_optics *optics, cs_optics_table table,
                                        cs_vfloat mass)
{
    return cs_filter_place_of(optics, table, mass).x;
}

/* One axis of film and lens. */
typedef struct cs_fibre_axis {
    const cs_optics *optics;     /* whose filter X has */
    cs_optics_table table;       /* the lens table of the optics */
    const cs_marginal *marginal; /* distribution of U */
    cs_vfloat blur;              /* pixels per unit of U, CS_LEAST_BLUR or more */
    cs_vfloat inverse;           /* 1 / blur */
} cs_fibre_axis;

/* The distribution of T at a place t. */
typedef struct cs_fibre_mass {
    cs_vfloat below;   /* P(T < t) */
    cs_vfloat density; /* per pixel */
    cs_vfloat slope;   /* derivative of the density */
} cs_fibre_mass;

/* The distribution of T at any t. */
CS_INLINED cs_fibre_mass cs_fibre_at(const cs_fibre_axis *axis, cs_vfloat t)
{
    const cs_optics *optics = axis->optics;
    cs_f32 step = optics->filter_width / (cs_f32)optics->filter_steps;
    cs_vfloat edge = t + 0.5f * optics->filter_width;
    cs_marginal_value right = cs_marginal_at(axis->marginal, edge * axis->inverse);
    cs_fibre_mass mass;
    mass.below = (cs_vfloat)(0.0f);
    mass.density = (cs_vfloat)(0.0f);
    mass.slope = (cs_vfloat)(0.0f);
    for (cs_u32 k = 0u; k < optics->filter_steps; k++) {
        edge -= step;
        cs_marginal_value left = cs_marginal_at(axis->marginal, edge * axis->inverse);
        mass.below += axis->table[k] * (right.integral - left.integral);
        mass.density += axis->table[k] * (right.below - left.below);
        mass.slope += axis->table[k] * (right.density - left.density);
        right = left;
    }
    mass.below *= axis->blur;
    mass.slope *= axis->inverse;
    return mass;
}

/* Where the quantile of T must lie. */
typedef struct cs_fibre_guess {
    cs_vfloat low;  /* lower bound, from the bounds of film and lens */
    cs_vfloat high; /* upper bound */
    cs_vfloat t;    /* a guess that would be exact for normal distributions */
} cs_fibre_guess;

/* The bounds and the guess of the t with P(T < t) = mass, for mass in [0, 1]. */
CS_INLINED cs_fibre_guess cs_fibre_guess_at(const cs_fibre_axis *axis, cs_vfloat mass)
{
    const cs_optics *optics = axis->optics;
    const cs_marginal *marginal = axis->marginal;
    cs_vfloat lens = axis->blur * cs_marginal_quantile(marginal, mass);
    cs_vfloat film = cs_filter_quantile(optics, axis->table, mass);
    cs_f32 half_width = 0.5f * optics->filter_width;
    cs_vfloat spread = axis->blur * marginal->deviation;
    cs_vfloat both = cs_sqrt(spread * spread + optics->filter_deviation * optics->filter_deviation);
    cs_fibre_guess guess;
    guess.low = cs_max(lens - half_width, film + axis->blur * marginal->low);
    guess.high = cs_min(lens + half_width, film + axis->blur * marginal->high);
    guess.t =
        cs_clamp((optics->filter_deviation * film + spread * lens) / both, guess.low, guess.high);
    return guess;
}

/* The t with P(T < t) = mass where the density has one hump, as a square's has: Halley's steps from
 * the side of the smaller tail. A smooth filter takes one, in the tails two, a box two: errors of
 * the mass are 1e-6 on average, 3e-4 at most. */
CS_INLINED cs_vfloat cs_fibre_quantile_unimodal(const cs_fibre_axis *axis, cs_vfloat mass)
{
    cs_fibre_guess guess = cs_fibre_guess_at(axis, mass);
    cs_vint right = mass > 0.5f;
    cs_vfloat root = cs_sqrt(cs_max(right ? 1.0f - mass : mass, (cs_vfloat)(1e-9f)));
    cs_vint tail = cs_abs(mass - 0.5f) > (axis->optics->filter_steps > 1u ? 0.4375f : -1.0f);
    cs_vfloat t = guess.t;
    for (int step = 0; step < 2 && (step == 0 || cs_any(tail)); step++) {
        cs_fibre_mass at = cs_fibre_at(axis, t);
        cs_vfloat move = cs_root_step_of(root, right ? 1.0f - at.below : at.below, at.density,
                                         right ? -at.slope : at.slope)
                             .back;
        cs_vfloat next = cs_clamp(right ? t + move : t - move, guess.low, guess.high);
        if (step == 0)
            t = next;
        else
            t = tail ? next : t;
    }
    return t;
}

/* Quantile of t for any density: the t at which P(T < t) is `mass`. Newton's steps in brackets end
 * when the error of the mass is below 1e-6 + 1e-7 * blur / filter width; the second term is the
 * rounding error of the integrals. */
CS_INLINED cs_vfloat cs_fibre_quantile_any(const cs_fibre_axis *axis, cs_vfloat mass)
{
    cs_fibre_guess guess = cs_fibre_guess_at(axis, mass);
    cs_vfloat tolerance = 1e-6f + (1e-7f / axis->optics->filter_width) * axis->blur;
    for (int step = 0; step < 16; step++) {
        cs_fibre_mass at = cs_fibre_at(axis, guess.t);
        cs_vfloat excess = at.below - mass;
        cs_vint wrong = cs_abs(excess) > tolerance;
        if (!cs_any(wrong)) break;
        guess.high = excess > 0.0f ? guess.t : guess.high;
        guess.low = excess > 0.0f ? guess.low : guess.t;
        cs_vfloat next = guess.t - excess / cs_max(at.density, (cs_vfloat)(1e-9f));
        cs_vfloat middle = 0.5f * (guess.low + guess.high);
        cs_vint inside = (next > guess.low) & (next < guess.high);
        next = inside ? next : middle;
        guess.t = wrong ? next : guess.t; /* whatever the other lanes of the packet need */
    }
    return guess.t;
}

/* The place on fibre t that `along`, in [0, 1), chooses: first the filter's step, then the place on
 * it. Returns the lens coordinate; `x` receives the film's, in pixels from the pixel's centre. */
CS_INLINED cs_vfloat cs_fibre_place(const cs_fibre_axis *axis, cs_vfloat t, cs_vfloat along,
                                    cs_vfloat *x)
{
    const cs_optics *optics = axis->optics;
    const cs_marginal *marginal = axis->marginal;
    cs_f32 step = optics->filter_width / (cs_f32)optics->filter_steps;
    cs_vfloat edge = t + 0.5f * optics->filter_width; /* t - x_k, going down */
    cs_vfloat rest = along * cs_fibre_at(axis, t).density;
    cs_vfloat wanted = rest, sum = (cs_vfloat)(0.0f), density = (cs_vfloat)(axis->table[0]);
    /* At the very ends no step has any mass in floats: then the outermost. */
    cs_vfloat top = t > 0.0f ? t - 0.5f * optics->filter_width + step : edge;
    cs_vfloat right = cs_marginal_at(marginal, edge * axis->inverse).below;
    for (cs_u32 k = 0u; k < optics->filter_steps; k++) {
        cs_vfloat left = cs_marginal_at(marginal, (edge - step) * axis->inverse).below;
        cs_vfloat mass = axis->table[k] * (right - left);
        cs_vint here = (wanted >= sum) & (mass > 0.0f);
        rest = here ? wanted - sum : rest;
        top = here ? edge : top;
        density = here ? (cs_vfloat)(axis->table[k]) : density;
        edge -= step;
        sum += mass;
        right = left;
    }
    cs_vfloat above = cs_marginal_at(marginal, top * axis->inverse).below;
    cs_vfloat below = cs_marginal_at(marginal, (top - step) * axis->inverse).below;
    cs_vfloat lens = cs_marginal_quantile(marginal, cs_max(above - rest / density, below));
    lens = cs_clamp(lens, (top - step) * axis->inverse, top * axis->inverse);
    lens = cs_clamp(lens, (cs_vfloat)(marginal->low), (cs_vfloat)(marginal->high));
    *x = t - axis->blur * lens;
    *x = cs_clamp(*x, t - top, t - top + step);
    return lens;
}

/* The map for a marginal of this kind. `kind` must be a literal: once this is inlined the compiler
 * knows it in every loop over the filter's steps, and leaves nothing of the other kinds there. */
CS_INLINED cs_vfloat cs_fibre_map_of_kind(cs_fibre_axis axis, const cs_marginal_kind kind,
                                          cs_vfloat across, cs_vfloat along, cs_vfloat *x)
{
    cs_marginal marginal = *axis.marginal;
    marginal.kind = kind;
    axis.marginal = &marginal;
    cs_vfloat t = kind == CS_MARGINAL_IMAGE ? cs_fibre_quantile_any(&axis, across)
                                            : cs_fibre_quantile_unimodal(&axis, across);
    return cs_fibre_place(&axis, t, along, x);
}

/* One axis of the equal-area map, for a uniform marginal or an image's. `across` and `along`, in
 * [0, 1), choose the fibre and the place on it; `negative` is not 0 for a negative shear. Returns
 * the lens coordinate; `x` receives the film's, in pixels from the pixel's centre. */
CS_INLINED cs_vfloat cs_fibre_map(cs_fibre_axis axis, cs_vfloat across, cs_vfloat along,
                                  int negative, cs_vfloat *x)
{
    cs_vfloat lens;
    across = negative ? 1.0f - across : across;
    if (axis.marginal->kind == CS_MARGINAL_UNIFORM)
        lens = cs_fibre_map_of_kind(axis, CS_MARGINAL_UNIFORM, across, along, x);
    else
        lens = cs_fibre_map_of_kind(axis, CS_MARGINAL_IMAGE, across, along, x);
    if (negative) *x = -*x;
    return lens;
}

#include "fp_contract_restore.h"

#endif
