/* Fibres through a pixel and a round lens, for the equal-area shear of the disk. Shared.
 *
 * Fibre coordinates, centred, are t_x = X + blur * U and t_y = Y + blur * V with (X, Y) uniform on
 * the pixel [-1/2, 1/2]^2 and (U, V) on the disk of area 1. Given t, (U, V) is uniform on the part
 * of the disk inside the square of side 1 / blur about t / blur. All areas below are built from
 * trapezoids and segments of the circle no larger than themselves: differences of antiderivatives
 * would lose their digits when the blur is wide. */
#ifndef CS_DISK_FIBRE_H
#define CS_DISK_FIBRE_H

#include "disk.h"

/* Half the chord at distance `place` from the centre; 0 outside the disk. */
static inline vfloat cs_disk_chord(vfloat place)
{
    vfloat square = (CS_DISK_RADIUS - place) * (CS_DISK_RADIUS + place);
    return cs_sqrt(cs_max(square, (vfloat)(0.0f)));
}

/* The disk between u = low and u = high, with the half-chords there. */
typedef struct cs_disk_slab {
    vfloat low;
    vfloat high;
    vfloat low_chord;
    vfloat high_chord;
} cs_disk_slab;

static inline cs_disk_slab cs_disk_slab_of(vfloat low, vfloat high)
{
    cs_disk_slab slab;
    slab.low = low;
    slab.high = high;
    slab.low_chord = cs_disk_chord(low);
    slab.high_chord = cs_disk_chord(high);
    return slab;
}

/* Segment of the circle on a chord with the given extents in u and v. */
static inline vfloat cs_disk_segment_on(vfloat width, vfloat rise)
{
    vfloat square = (width * width + rise * rise) * (0.25f * CS_PI); /* (chord / 2R)^2 */
    vfloat cosine = cs_sqrt(cs_max(1.0f - square, (vfloat)(0.0f)));
    return cs_disk_segment(cs_sqrt(square), 1.0f - cosine);
}

/* Area of a slab's upper half: a trapezoid and a segment. */
static inline vfloat cs_disk_half_slab(cs_disk_slab slab)
{
    vfloat width = slab.high - slab.low;
    return 0.5f * width * (slab.low_chord + slab.high_chord) +
           cs_disk_segment_on(width, slab.high_chord - slab.low_chord);
}

/* The part of a slab above v = height >= 0, where its half-chord is c(u). */
typedef struct cs_disk_cap {
    vfloat width;  /* length of its lower side */
    vfloat area;   /* integral of max(c - height, 0) du */
    vfloat moment; /* integral of max(c - height, 0)^2 / 2 du */
} cs_disk_cap;

/* The moment of a segment about v = 0 is chord^2 * width / 12. */
static inline cs_disk_cap cs_disk_cap_of(cs_disk_slab slab, vfloat height)
{
    vfloat reach = cs_disk_chord(height);
    vfloat left = cs_max(slab.low_chord - height, (vfloat)(0.0f));
    vfloat right = cs_max(slab.high_chord - height, (vfloat)(0.0f));
    cs_disk_cap cap;
    cap.width = cs_min(slab.high, reach) - cs_max(slab.low, -reach);
    cap.width = cs_max(cap.width, (vfloat)(0.0f));
    vfloat segment = cs_disk_segment_on(cap.width, right - left);
    cap.area = 0.5f * cap.width * (left + right) + segment;
    vfloat square = 0.25f * (left * left + right * right);
    cap.moment = cap.width * (square + (1.0f / 12.0f) * cap.width * cap.width) - height * segment;
    return cap;
}

/* The cap below v = bottom, for fibres with t_y <= 0: bottom <= -1/2 / blur is outside the disk
 * for blurs up to 1/2 / R. */
static inline cs_disk_cap cs_disk_cap_below(cs_disk_slab slab, vfloat bottom, f32 blur)
{
    cs_disk_cap none;
    none.width = (vfloat)(0.0f);
    none.area = (vfloat)(0.0f);
    none.moment = (vfloat)(0.0f);
    return blur > 0.886f ? cs_disk_cap_of(slab, -bottom) : none;
}

/* The t <= 0 with P(Y + blur * V < t) = mass, for mass in (0, 1/2] and (U, V) uniform on a slab
 * whose upper half has area `half_slab`: t_y given t_x.
 *
 * F(t) = max(t + 1/2, 0) + blur * (M((t + 1/2) / blur) - M((t - 1/2) / blur)) / (2 * half_slab),
 * M(q) the moment of the cap above |q|. The guess takes V as uniform with about its variance. Two
 * steps leave an error of F below 3e-7, or 4e-8 * blur for wide blurs, but for one tuple in a
 * thousand, where it is below 6e-6. */
static inline vfloat cs_disk_slab_fibre(vfloat mass, cs_disk_slab slab, vfloat half_slab, f32 blur)
{
    f32 inverse = 1.0f / blur;
    f32 least = -0.5f - blur * CS_DISK_RADIUS;
    vfloat total = 2.0f * half_slab;
    vfloat scale = 1.0f / total;
    vfloat root = cs_sqrt(mass);
    vfloat mean = slab.low * slab.low + slab.low * slab.high + slab.high * slab.high;
    vfloat square = CS_DISK_RADIUS * CS_DISK_RADIUS - (1.0f / 3.0f) * mean;
    vfloat t = cs_trapezoid_fibre(mass, 2.0f * blur * cs_sqrt(cs_max(square, (vfloat)(0.0f))));
    for (int step = 0; step < 2; step++) {
        vfloat top = (t + 0.5f) * inverse;
        cs_disk_cap above = cs_disk_cap_of(slab, cs_abs(top));
        cs_disk_cap below = cs_disk_cap_below(slab, (t - 0.5f) * inverse, blur);
        vfloat linear = cs_max(t + 0.5f, (vfloat)(0.0f));
        vfloat value = linear + scale * blur * (above.moment - below.moment);
        vfloat density = (top < 0.0f ? above.area : total - above.area) - below.area;
        vfloat slope = inverse * (above.width - below.width);
        t -= cs_root_step(root, value, scale * density, scale * slope);
        t = cs_clamp(t, (vfloat)(least), (vfloat)(0.0f));
    }
    return t;
}

/* What is seen of a slab along the fibres at t_y <= 0: bottom < v < top. */
typedef struct cs_disk_window {
    cs_disk_slab slab;
    vfloat bottom;
    vfloat top;
    f32 blur;
} cs_disk_window;

static inline vfloat cs_disk_window_area(cs_disk_window window, vfloat half_slab)
{
    vfloat above = cs_disk_cap_of(window.slab, cs_abs(window.top)).area;
    vfloat below = cs_disk_cap_below(window.slab, window.bottom, window.blur).area;
    return (window.top < 0.0f ? above : 2.0f * half_slab - above) - below;
}

/* Height of the window where the disk's half-chord is `chord`. */
static inline vfloat cs_disk_window_height(cs_disk_window window, vfloat chord)
{
    vfloat height = cs_min(chord, window.top) + cs_min(chord, -window.bottom);
    return cs_max(height, (vfloat)(0.0f));
}

/* First guess for cs_disk_window_place: heights linear between both ends and the middle. */
static inline vfloat cs_disk_window_guess(vfloat mass, cs_disk_window window)
{
    vfloat extent = 0.5f * (window.slab.high - window.slab.low);
    vfloat middle = window.slab.low + extent;
    vfloat first = cs_disk_window_height(window, window.slab.low_chord);
    vfloat second = cs_disk_window_height(window, cs_disk_chord(middle));
    vfloat third = cs_disk_window_height(window, window.slab.high_chord);
    vfloat rest = mass * (first + 2.0f * second + third);
    vint left = rest < first + second;
    vfloat start = left ? first : second;
    vfloat rise = (left ? second : third) - start;
    rest = left ? rest : rest - (first + second);
    vfloat root = cs_sqrt(cs_max(start * start + rise * rest, (vfloat)(1e-20f)));
    return (left ? window.slab.low : middle) + extent * rest / (start + root);
}

/* The u with the share `mass` <= 1/2 of the window's area on its left; in the area's second
 * derivative those of the window's two sides count that are arcs. Two steps leave an error of the
 * share below 5e-6, but for one tuple in a thousand, mostly in corners cut by the disk's edge,
 * where it is below 2e-4. */
static inline vfloat cs_disk_window_place(vfloat mass, cs_disk_window window, vfloat area)
{
    vfloat first = window.slab.low;
    vfloat last = window.slab.high;
    vfloat root = cs_sqrt(mass);
    vfloat scale = 1.0f / cs_max(area, (vfloat)(1e-12f));
    vfloat u = cs_disk_window_guess(mass, window);
    for (int step = 0; step < 2; step++) {
        vfloat chord = cs_disk_chord(u);
        window.slab.high = u;
        window.slab.high_chord = chord;
        vfloat value = scale * cs_disk_window_area(window, cs_disk_half_slab(window.slab));
        vfloat density = scale * cs_disk_window_height(window, chord);
        vfloat turn = -scale * u / cs_max(chord, (vfloat)(1e-6f));
        vfloat upper = chord < window.top ? turn : (vfloat)(0.0f);
        vfloat lower = chord < -window.bottom ? turn : (vfloat)(0.0f);
        u = cs_clamp(u - cs_root_step(root, value, density, upper + lower), first, last);
    }
    return u;
}

#endif
