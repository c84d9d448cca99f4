/* The disk of area 1 and its marginal, for round apertures. Shared.
 *
 * The coordinate u of a uniform point of the disk of radius R = 1 / sqrt(pi) has the semicircle
 * distribution. Polynomials below are Chebyshev fits; their errors are absolute. The area of the
 * disk is the unit of areas. */
#ifndef CS_DISK_H
#define CS_DISK_H

#include "packet.h"

#define CS_DISK_RADIUS 0.564189584f

/* Area between an arc of the circle and its chord, from sine and 1 - cosine of half the angle it
 * spans (at most half the circle): (angle - sine cosine) / pi, error 2e-8, relative error 2e-6 for
 * short arcs. */
static inline vfloat cs_disk_segment(vfloat sine, vfloat versine)
{
    vfloat above = (0.0459059872f * versine - 0.287248532f) * versine + 0.424413944f;
    vfloat below = (0.142940408f * versine - 0.776797601f) * versine + 1.0f;
    return sine * versine * above / below;
}

typedef struct cs_half_circle {
    vfloat distance; /* |u| / R, at most 1 */
    vfloat height;   /* sqrt(1 - distance^2) */
    vfloat tail;     /* P(U > |u|) */
} cs_half_circle;

static inline cs_half_circle cs_half_circle_at(vfloat u)
{
    cs_half_circle at;
    at.distance = cs_min(cs_abs(u) * (1.0f / CS_DISK_RADIUS), (vfloat)(1.0f));
    at.height = cs_sqrt((1.0f - at.distance) * (1.0f + at.distance));
    at.tail = cs_disk_segment(at.height, 1.0f - at.distance);
    return at;
}

static inline vfloat cs_half_circle_cdf(cs_half_circle at, vfloat u)
{
    return u < 0.0f ? at.tail : 1.0f - at.tail;
}

/* P(U < u). */
static inline vfloat cs_disk_cdf(vfloat u)
{
    return cs_half_circle_cdf(cs_half_circle_at(u), u);
}

/* E[max(u - U, 0)] - max(u, 0): the antiderivative of the distribution less its asymptotes. Even,
 * and zero outside the disk, so differences of it lose no digits when the disk is small. */
static inline vfloat cs_half_circle_excess(cs_half_circle at)
{
    vfloat cube = at.height * at.height * at.height;
    return CS_DISK_RADIUS * ((2.0f / 3.0f * CS_INVERSE_PI) * cube - at.distance * at.tail);
}

/* x^(1/3) for x in [0, 1], relative error 1e-7: an exponent-halving guess and two Halley steps. */
static inline vfloat cs_cube_root(vfloat x)
{
    vfloat y = cs_as_vfloat(cs_mul_hi(cs_as_vuint(x), 0x55555556u) + 0x2a512ce3u);
    vfloat cube = y * y * y;
    y = y * (cube + 2.0f * x) / (2.0f * cube + x);
    cube = y * y * y;
    return y * (cube + 2.0f * x) / (2.0f * cube + x);
}

/* The u with P(U < u) = mass, error 2.5e-7. With psi - sin psi = 2 pi mass (psi the angle of the
 * segment left of u), cos(psi / 2) is analytic in mass^(2/3): a fit replaces the iteration. */
static inline vfloat cs_disk_quantile(vfloat mass)
{
    vfloat tail = cs_max(cs_min(mass, 1.0f - mass), (vfloat)(1e-20f)); /* 0 has no such root */
    vfloat root = cs_cube_root(tail);
    vfloat q = root * root;
    vfloat p = (vfloat)(0.30320378f);
    p = p * q - 0.521702511f;
    p = p * q + 0.451781736f;
    p = p * q - 0.164368948f;
    p = p * q + 0.0811297773f;
    p = p * q + 0.0443955787f;
    p = p * q + 0.0877110275f;
    p = p * q + 0.197498453f;
    p = p * q + 1.40539194f;
    vfloat u = CS_DISK_RADIUS * (1.0f - q * p);
    return mass < 0.5f ? -u : u;
}

/* For mass in [0, 1/2], the t <= 0 with P(X + side * Y < t) = mass, X and Y uniform in [-1/2, 1/2]:
 * a first guess for the fibres of round lenses. */
static inline vfloat cs_trapezoid_fibre(vfloat mass, vfloat side)
{
    vfloat narrow = cs_min(side, (vfloat)(1.0f));
    vfloat wide = cs_max(side, (vfloat)(1.0f));
    vfloat rising = cs_sqrt(2.0f * narrow * wide * mass);
    vfloat flat = 0.5f * narrow + mass * wide;
    return (2.0f * mass * wide < narrow ? rising : flat) - 0.5f * (1.0f + side);
}

/* Halley's step from t towards F(t) = mass, given value = F(t), density = F'(t), slope = F''(t); to
 * be subtracted from t. It solves sqrt(F) = sqrt(mass), which is nearly linear in the tails too. */
static inline vfloat cs_root_step(vfloat mass_root, vfloat value, vfloat density, vfloat slope)
{
    value = cs_max(value, (vfloat)(1e-12f));
    density = cs_max(density, (vfloat)(1e-6f));
    vfloat root = cs_sqrt(value);
    vfloat excess = root - mass_root;
    vfloat square = density * density;
    vfloat divisor = square * (2.0f * root + excess) - 2.0f * value * excess * slope;
    return 4.0f * value * excess * density / cs_max(divisor, root * square);
}

/* The t with P(X + blur * U < t) = across, X uniform in [-1/2, 1/2] and U the disk's marginal.
 *
 * F(t) = clamp(t + 1/2, 0, 1) + blur * (E((t + 1/2) / blur) - E((t - 1/2) / blur)), E the excess
 * above. The guess is a square aperture with the disk's variance, or for wide blurs, where the
 * pixel matters little, the disk itself. Two steps leave an error of F below 3e-7, and
 * below 6e-8 * blur for wide blurs. */
static inline vfloat cs_disk_fibre(vfloat across, f32 blur)
{
    vfloat mass = cs_max(cs_min(across, 1.0f - across), (vfloat)(1e-9f));
    vfloat root = cs_sqrt(mass);
    vfloat t = blur > 6.0f ? blur * cs_disk_quantile(mass)
                           : cs_trapezoid_fibre(mass, (vfloat)(0.9772f * blur));
    f32 inverse = 1.0f / blur;
    f32 least = -0.5f - blur * CS_DISK_RADIUS;
    for (int step = 0; step < 2; step++) {
        vfloat right = (t + 0.5f) * inverse;
        vfloat left = (t - 0.5f) * inverse;
        cs_half_circle at_right = cs_half_circle_at(right);
        cs_half_circle at_left = cs_half_circle_at(left);
        vfloat excess = cs_half_circle_excess(at_right) - cs_half_circle_excess(at_left);
        vfloat value = cs_max(t + 0.5f, (vfloat)(0.0f)) + blur * excess;
        vfloat density = cs_half_circle_cdf(at_right, right) - at_left.tail;
        vfloat slope = (2.0f * CS_DISK_RADIUS) * inverse * (at_right.height - at_left.height);
        t -= cs_root_step(root, value, density, slope);
        t = cs_clamp(t, (vfloat)(least), (vfloat)(0.0f));
    }
    return across > 0.5f ? -t : t;
}

/* From the unit square, centred, to the disk of area 1: the concentric map (Shirley & Chiu 1997),
 * which keeps areas. sin and cos on [-pi/4, pi/4] are Taylor polynomials, error 2e-7. */
static inline void cs_disk_from_square(vfloat *u, vfloat *v)
{
    vint wide = cs_abs(*u) > cs_abs(*v);
    vfloat radius = wide ? *u : *v;
    vfloat other = wide ? *v : *u;
    vfloat divisor = cs_abs(radius) < 1e-9f ? (vfloat)(1e-9f) : radius;
    vfloat angle = (0.25f * CS_PI) * (other / divisor);
    vfloat square = angle * angle;
    vfloat sine =
        angle *
        (1.0f + square * (-0.166666667f + square * (0.00833333333f - square * 0.000198412698f)));
    vfloat cosine =
        1.0f + square * (-0.5f + square * (0.0416666667f +
                                           square * (-0.00138888889f + square * 2.48015873e-5f)));
    radius *= 2.0f * CS_DISK_RADIUS;
    *u = radius * (wide ? cosine : sine);
    *v = radius * (wide ? sine : cosine);
}

#endif
