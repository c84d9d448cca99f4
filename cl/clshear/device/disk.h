/* The disk of area 1 and its marginal, for round apertures.
 *
 * The coordinate u of a uniform point of the disk of radius R = 1 / sqrt(pi) has the semicircle
 * distribution. Polynomials below are Chebyshev fits; their errors are absolute. The area of the
 * disk is the unit of areas. */
#ifndef CLSHEAR_DEVICE_DISK_H
#define CLSHEAR_DEVICE_DISK_H

#include "packet.h"

#include "fp_contract_off.h"

#define CS_DISK_RADIUS 0.564189584f

/* Limit of error^3 / mass^2 before a step (cs_root_step_of), below which the step leaves less than
 * 2e-6. */
#define CS_ROOT_TOLERANCE 2e-5f

/* Area between an arc of at most half the circle and its chord, from sine and 1 - cosine of the
 * angle it spans: (angle - sine) / (2 pi), error 6e-8, relative error 7e-7. Both come from the
 * chord's ends without any root. Arcs beyond a right angle are taken from their supplement. */
CS_INLINED cs_vfloat cs_disk_segment(cs_vfloat sine, cs_vfloat versine)
{
    cs_vfloat near = cs_min(versine, 2.0f - versine);
    cs_vfloat square = near * near;
    cs_vfloat first =
        (0.0212246407f * near + 0.0530516161f) + (0.00466286363f * near + 0.00901334397f) * square;
    cs_vfloat rest = (0.00521626568f * near - 0.000439479898f) +
                     (0.00204494766f * near - 0.00392919503f) * square;
    cs_vfloat segment = sine * near * (first + square * square * rest);
    return versine > 1.0f ? (0.5f - CS_INVERSE_PI * sine) - segment : segment;
}

/* The disk at a coordinate u. */
typedef struct cs_half_circle {
    cs_vfloat distance; /* |u| / R, at most 1 */
    cs_vfloat height;   /* sqrt(1 - distance^2) */
    cs_vfloat tail;     /* P(U > |u|) */
} cs_half_circle;

/* The disk at any u; outside of it, its edge. */
CS_INLINED cs_half_circle cs_half_circle_at(cs_vfloat u)
{
    cs_half_circle at;
    at.distance = cs_min(cs_abs(u) * (1.0f / CS_DISK_RADIUS), (cs_vfloat)(1.0f));
    at.height = cs_sqrt((1.0f - at.distance) * (1.0f + at.distance));
    cs_vfloat twice = 2.0f * at.height;
    at.tail = cs_disk_segment(twice * at.distance, twice * at.height);
    return at;
}

/* P(U < u), where `at` is cs_half_circle_at(u). */
CS_INLINED cs_vfloat cs_half_circle_cdf(cs_half_circle at, cs_vfloat u)
{
    return u < 0.0f ? at.tail : 1.0f - at.tail;
}

/* P(U < u) for any u. */
CS_INLINED cs_vfloat cs_disk_cdf(cs_vfloat u)
{
    return cs_half_circle_cdf(cs_half_circle_at(u), u);
}

/* E[max(u - U, 0)] - max(u, 0): the antiderivative of the distribution less its asymptotes. Even,
 * and zero outside the disk, so differences of it lose no digits when the disk is small. */
CS_INLINED cs_vfloat cs_half_circle_excess(cs_half_circle at)
{
    cs_vfloat cube = at.height * at.height * at.height;
    return CS_DISK_RADIUS * ((2.0f / 3.0f * CS_INVERSE_PI) * cube - at.distance * at.tail);
}

/* x^(1/3) for x in [0, 1], relative error 1e-7: an exponent-halving guess and two Halley steps. */
CS_INLINED cs_vfloat cs_cube_root(cs_vfloat x)
{
    cs_vfloat y = cs_as_vfloat(cs_mul_hi(cs_as_vuint(x), 0x55555556u) + 0x2a512ce3u);
    cs_vfloat cube = y * y * y;
    y = y * (cube + 2.0f * x) / (2.0f * cube + x);
    cube = y * y * y;
    return y * (cube + 2.0f * x) / (2.0f * cube + x);
}

/* The u with P(U < u) = mass, for mass in [0, 1], error 2.5e-7. With psi - sin psi = 2 pi mass (psi
 * the angle of the segment left of u), cos(psi / 2) is analytic in mass^(2/3): a fit replaces the
 * iteration. */
CS_INLINED cs_vfloat cs_disk_quantile(cs_vfloat mass)
{
    cs_vfloat tail =
        cs_max(cs_min(mass, 1.0f - mass), (cs_vfloat)(1e-20f)); /* 0 has no such root */
    cs_vfloat root = cs_cube_root(tail);
    cs_vfloat q = root * root;
    cs_vfloat p = (cs_vfloat)(0.30320378f);
    p = p * q - 0.521702511f;
    p = p * q + 0.451781736f;
    p = p * q - 0.164368948f;
    p = p * q + 0.0811297773f;
    p = p * q + 0.0443955787f;
    p = p * q + 0.0877110275f;
    p = p * q + 0.197498453f;
    p = p * q + 1.40539194f;
    cs_vfloat u = CS_DISK_RADIUS * (1.0f - q * p);
    return mass < 0.5f ? -u : u;
}

/* For mass in [0, 1/2], the t <= 0 with P(X + side * Y < t) = mass, X and Y uniform in [-1/2, 1/2]:
 * a first guess for the fibres of round lenses. */
CS_INLINED cs_vfloat cs_trapezoid_fibre(cs_vfloat mass, cs_vfloat side)
{
    cs_vfloat narrow = cs_min(side, (cs_vfloat)(1.0f));
    cs_vfloat wide = cs_max(side, (cs_vfloat)(1.0f));
    cs_vfloat rising = cs_sqrt(2.0f * narrow * wide * mass);
    cs_vfloat flat = 0.5f * narrow + mass * wide;
    return (2.0f * mass * wide < narrow ? rising : flat) - 0.5f * (1.0f + side);
}

/* A step towards a root. */
typedef struct cs_root_step {
    cs_vfloat back; /* the step: the next t is t - back */
    cs_vint rough;  /* mask of the lanes whose result is not good enough */
} cs_root_step;

/* Halley's step from t towards F(t) = mass, given value = F(t), density = F'(t), slope = F''(t). It
 * solves sqrt(F) = sqrt(mass), which is nearly linear in the tails too.
 *
 * An error e of F before the step leaves up to 0.06 e^3 / mass^2 after it for the distributions
 * here, in a few corners up to e^3 / mass^2: where that is too much, lanes are rough. */
CS_INLINED cs_root_step cs_root_step_of(cs_vfloat mass_root, cs_vfloat value, cs_vfloat density,
                                        cs_vfloat slope)
{
    cs_root_step step;
    value = cs_max(value, (cs_vfloat)(1e-12f));
    density = cs_max(density, (cs_vfloat)(1e-6f));
    cs_vfloat root = cs_sqrt(value);
    cs_vfloat excess = root - mass_root;
    cs_vfloat square = density * density;
    cs_vfloat divisor = square * (2.0f * root + excess) - 2.0f * value * excess * slope;
    cs_vfloat mass = mass_root * mass_root;
    cs_vfloat error = cs_abs(value - mass);
    step.back = 4.0f * value * excess * density / cs_max(divisor, root * square);
    step.rough = error * error * error > CS_ROOT_TOLERANCE * (mass * mass);
    return step;
}

/* The next functions find the t <= 0 with P(X + blur * U < t) = mass, for mass in (0, 1/2], X
 * uniform in [-1/2, 1/2] and U the disk's marginal.
 *
 * F(t) = max(t + 1/2, 0) + blur * (E((t + 1/2) / blur) - E((t - 1/2) / blur)), E the excess above.
 * The guess is a square aperture with the disk's variance, or for wide blurs, where the pixel
 * matters little, a disk with the variance of both. One step leaves an error of F below 1e-6 where
 * it does not ask for a second, two leave 3e-7, or 6e-8 * blur for wide blurs. */

/* The mass from which to solve for the fibre that is `across` of all; its t has the other sign
 * where across > 1/2. */
CS_INLINED cs_vfloat cs_disk_fibre_mass(cs_vfloat across)
{
    return cs_max(cs_min(across, 1.0f - across), (cs_vfloat)(1e-9f));
}

/* First guess of that t. `blur` is CS_LEAST_BLUR or more, in pixels per lens unit. */
CS_INLINED cs_vfloat cs_disk_fibre_guess(cs_vfloat mass, cs_f32 blur)
{
    cs_f32 variance = blur * blur + CS_PI / 3.0f; /* in terms of the disk's, 1 / (4 pi) */
    return blur > 3.0f ? cs_sqrt(variance) * cs_disk_quantile(mass)
                       : cs_trapezoid_fibre(mass, (cs_vfloat)(0.9772f * blur));
}

/* A better t; `mass_root` is sqrt(mass). `rough` receives the mask of lanes that want another step.
 */
CS_INLINED cs_vfloat cs_disk_fibre_step(cs_vfloat t, cs_vfloat mass_root, cs_f32 blur,
                                        cs_vint *rough)
{
    cs_f32 inverse = 1.0f / blur;
    cs_f32 least = -0.5f - blur * CS_DISK_RADIUS;
    cs_vfloat right = (t + 0.5f) * inverse;
    cs_vfloat left = (t - 0.5f) * inverse;
    cs_half_circle at_right = cs_half_circle_at(right);
    cs_half_circle at_left = cs_half_circle_at(left);
    cs_vfloat excess = cs_half_circle_excess(at_right) - cs_half_circle_excess(at_left);
    cs_vfloat value = cs_max(t + 0.5f, (cs_vfloat)(0.0f)) + blur * excess;
    cs_vfloat density = cs_half_circle_cdf(at_right, right) - at_left.tail;
    cs_vfloat slope = (2.0f * CS_DISK_RADIUS) * inverse * (at_right.height - at_left.height);
    cs_root_step step = cs_root_step_of(mass_root, value, density, slope);
    *rough = step.rough;
    return cs_clamp(t - step.back, (cs_vfloat)(least), (cs_vfloat)(0.0f));
}

/* From the square [-1/2, 1/2]^2 to the disk of area 1, in place: the concentric map (Shirley & Chiu
 * 1997), which keeps areas. sin and cos on [-pi/4, pi/4] are Taylor polynomials, error 2e-7. */
CS_INLINED void cs_disk_from_square(cs_vfloat *u, cs_vfloat *v)
{
    cs_vint wide = cs_abs(*u) > cs_abs(*v);
    cs_vfloat radius = wide ? *u : *v;
    cs_vfloat other = wide ? *v : *u;
    cs_vfloat divisor = cs_abs(radius) < 1e-9f ? (cs_vfloat)(1e-9f) : radius;
    cs_vfloat angle = (0.25f * CS_PI) * (other / divisor);
    cs_vfloat square = angle * angle;
    cs_vfloat sine =
        angle *
        (1.0f + square * (-0.166666667f + square * (0.00833333333f - square * 0.000198412698f)));
    cs_vfloat cosine =
        1.0f + square * (-0.5f + square * (0.0416666667f +
                                           square * (-0.00138888889f + square * 2.48015873e-5f)));
    radius *= 2.0f * CS_DISK_RADIUS;
    *u = radius * (wide ? cosine : sine);
    *v = radius * (wide ? sine : cosine);
}

#include "fp_contract_restore.h"

#endif
