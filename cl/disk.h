/* The disk of area 1 and its marginal, for round apertures. Shared.
 *
 * The coordinate u of a uniform point of the disk of radius R = 1 / sqrt(pi) has the semicircle
 * distribution. Polynomials below are Chebyshev fits; their errors are absolute. */
#ifndef CS_DISK_H
#define CS_DISK_H

#include "packet.h"

#define CS_DISK_RADIUS 0.564189584f

typedef struct cs_half_circle {
    vfloat distance; /* |u| / R, at most 1 */
    vfloat height;   /* sqrt(1 - distance^2) */
    vfloat angle;    /* acos(distance) */
} cs_half_circle;

/* acos(z) = sqrt(1 - z) * polynomial (form of Abramowitz & Stegun 4.4.46), error 1e-7. */
static inline cs_half_circle cs_half_circle_at(vfloat u)
{
    cs_half_circle at;
    vfloat z = cs_min(cs_abs(u) * (1.0f / CS_DISK_RADIUS), (vfloat)(1.0f));
    vfloat root = cs_sqrt(1.0f - z);
    vfloat p = (vfloat)(-0.0012236934f);
    p = p * z + 0.006510858f;
    p = p * z - 0.0168304377f;
    p = p * z + 0.0306826362f;
    p = p * z - 0.0500848688f;
    p = p * z + 0.0889598178f;
    p = p * z - 0.21459706f;
    p = p * z + 1.57079626f;
    at.distance = z;
    at.height = root * cs_sqrt(1.0f + z);
    at.angle = root * p;
    return at;
}

static inline vfloat cs_half_circle_cdf(cs_half_circle at, vfloat u)
{
    vfloat tail = (at.angle - at.distance * at.height) * CS_INVERSE_PI;
    return u < 0.0f ? tail : 1.0f - tail;
}

/* P(U < u): 1/2 + (z sqrt(1 - z^2) + asin z) / pi with z = u / R. */
static inline vfloat cs_disk_cdf(vfloat u)
{
    return cs_half_circle_cdf(cs_half_circle_at(u), u);
}

/* E[max(u - U, 0)] - max(u, 0): the antiderivative of the distribution less its asymptotes. Even,
 * and zero outside the disk, so differences of it lose no digits when the disk is small. */
static inline vfloat cs_half_circle_excess(cs_half_circle at)
{
    vfloat h = at.height;
    return (CS_DISK_RADIUS * CS_INVERSE_PI) *
           (h - h * h * h * (1.0f / 3.0f) - at.distance * at.angle);
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
    vfloat tail = cs_max(cs_min(mass, 1.0f - mass), (vfloat)(0.0f));
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

/* First guess for cs_disk_fibre, for mass in [0, 1/2]: the trapezoid of a square aperture with the
 * disk's variance, or for wide blurs, where the pixel matters little, the disk itself. */
static inline vfloat cs_disk_fibre_guess(vfloat mass, f32 blur)
{
    if (blur > 6.0f) return blur * cs_disk_quantile(mass);
    f32 side = 0.9772f * blur; /* sqrt(3) R blur */
    f32 narrow = side < 1.0f ? side : 1.0f;
    f32 wide = side < 1.0f ? 1.0f : side;
    f32 ramp = 0.5f * narrow / wide;
    vfloat rising = cs_sqrt(2.0f * narrow * wide * mass);
    vfloat flat = narrow + (mass - ramp) * wide;
    return (mass < ramp ? rising : flat) - 0.5f * (1.0f + side);
}

/* The t with P(X + blur * U < t) = across, X uniform in [-1/2, 1/2] and U the disk's marginal.
 *
 * F(t) = clamp(t + 1/2, 0, 1) + blur * (E((t + 1/2) / blur) - E((t - 1/2) / blur)), E the excess
 * above. Newton on sqrt(F), which is nearly linear in the tails too; three steps leave an error
 * of F below 4e-7, and below 4e-8 * blur for very wide blurs. */
static inline vfloat cs_disk_fibre(vfloat across, f32 blur)
{
    vfloat mass = cs_max(cs_min(across, 1.0f - across), (vfloat)(1e-9f));
    vfloat root = cs_sqrt(mass);
    vfloat t = cs_disk_fibre_guess(mass, blur);
    f32 inverse = 1.0f / blur;
    f32 least = -0.5f - blur * CS_DISK_RADIUS;
    for (int step = 0; step < 3; step++) {
        vfloat right = (t + 0.5f) * inverse;
        vfloat left = (t - 0.5f) * inverse;
        cs_half_circle at_right = cs_half_circle_at(right);
        cs_half_circle at_left = cs_half_circle_at(left);
        vfloat linear = cs_min(cs_max(t + 0.5f, (vfloat)(0.0f)), (vfloat)(1.0f));
        vfloat excess = cs_half_circle_excess(at_right) - cs_half_circle_excess(at_left);
        vfloat value = cs_max(linear + blur * excess, (vfloat)(1e-12f));
        vfloat density = cs_half_circle_cdf(at_right, right) - cs_half_circle_cdf(at_left, left);
        vfloat value_root = cs_sqrt(value);
        t -= 2.0f * value_root * (value_root - root) / cs_max(density, (vfloat)(1e-6f));
        t = cs_min(cs_max(t, (vfloat)(least)), (vfloat)(0.0f));
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
