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
CS_INLINED vfloat cs_disk_chord(vfloat place)
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

CS_INLINED cs_disk_slab cs_disk_slab_of(vfloat low, vfloat high)
{
    cs_disk_slab slab;
    slab.low = low;
    slab.high = high;
    slab.low_chord = cs_disk_chord(low);
    slab.high_chord = cs_disk_chord(high);
    return slab;
}

/* Segment of the circle on the chord from (u, v) to (u + width, v + rise), v >= 0: the ends' cross
 * product and the chord's square are R^2 times sine and 2 (1 - cosine) of the angle. */
CS_INLINED vfloat cs_disk_segment_on(vfloat u, vfloat v, vfloat width, vfloat rise)
{
    vfloat sine = cs_max(width * v - u * rise, (vfloat)(0.0f)) * CS_PI;
    vfloat versine = (width * width + rise * rise) * (0.5f * CS_PI);
    return cs_disk_segment(sine, cs_min(versine, (vfloat)(2.0f)));
}

/* Area of a slab's upper half: a trapezoid and a segment. */
CS_INLINED vfloat cs_disk_half_slab(cs_disk_slab slab)
{
    vfloat width = slab.high - slab.low;
    return 0.5f * width * (slab.low_chord + slab.high_chord) +
           cs_disk_segment_on(slab.low, slab.low_chord, width, slab.high_chord - slab.low_chord);
}

/* The part of a slab above v = height >= 0, where its half-chord is c(u). */
typedef struct cs_disk_cap {
    vfloat width;  /* length of its lower side */
    vfloat area;   /* integral of max(c - height, 0) du */
    vfloat moment; /* integral of max(c - height, 0)^2 / 2 du */
} cs_disk_cap;

/* The moment of a segment about v = 0 is chord^2 * width / 12. */
CS_INLINED cs_disk_cap cs_disk_cap_of(cs_disk_slab slab, vfloat height)
{
    vfloat reach = cs_disk_chord(height);
    vfloat left = cs_max(slab.low_chord - height, (vfloat)(0.0f));
    vfloat right = cs_max(slab.high_chord - height, (vfloat)(0.0f));
    cs_disk_cap cap;
    vfloat first = cs_max(slab.low, -reach);
    cap.width = cs_max(cs_min(slab.high, reach) - first, (vfloat)(0.0f));
    vfloat segment = cs_disk_segment_on(first, height + left, cap.width, right - left);
    cap.area = 0.5f * cap.width * (left + right) + segment;
    vfloat square = 0.25f * (left * left + right * right);
    cap.moment = cap.width * (square + (1.0f / 12.0f) * cap.width * cap.width) - height * segment;
    return cap;
}

/* The cap below v = bottom, for fibres with t_y <= 0: bottom <= -1/2 / blur is outside the disk
 * for blurs up to 1/2 / R. */
CS_INLINED cs_disk_cap cs_disk_cap_below(cs_disk_slab slab, vfloat bottom, f32 blur)
{
    cs_disk_cap none;
    none.width = (vfloat)(0.0f);
    none.area = (vfloat)(0.0f);
    none.moment = (vfloat)(0.0f);
    return blur > 0.886f ? cs_disk_cap_of(slab, -bottom) : none;
}

/* Below: the t <= 0 with P(Y + blur * V < t) = mass, for mass in (0, 1/2] and (U, V) uniform on a
 * slab whose upper half has area `half_slab`: t_y given t_x.
 *
 * F(t) = max(t + 1/2, 0) + blur * (M((t + 1/2) / blur) - M((t - 1/2) / blur)) / (2 * half_slab),
 * M(q) the moment of the cap above |q|. The guess takes V as uniform with about its variance. One
 * step leaves an error of F below 2e-6 where it does not ask for a second, two leave 3e-7, or 4e-8
 * * blur for wide blurs, but for one tuple in a thousand, where it is below 6e-6. */
CS_INLINED vfloat cs_disk_slab_guess(vfloat mass, cs_disk_slab slab, f32 blur)
{
    vfloat mean = slab.low * slab.low + slab.low * slab.high + slab.high * slab.high;
    vfloat square = CS_DISK_RADIUS * CS_DISK_RADIUS - (1.0f / 3.0f) * mean;
    vfloat side = 2.0f * blur * cs_sqrt(cs_max(square, (vfloat)(0.0f)));
    return cs_trapezoid_fibre(mass, side);
}

CS_INLINED vfloat cs_disk_slab_step(vfloat t, vfloat mass_root, cs_disk_slab slab, vfloat half_slab,
                                    f32 blur, vint *rough)
{
    f32 inverse = 1.0f / blur;
    f32 least = -0.5f - blur * CS_DISK_RADIUS;
    vfloat total = 2.0f * half_slab;
    vfloat scale = 1.0f / total;
    vfloat top = (t + 0.5f) * inverse;
    cs_disk_cap above = cs_disk_cap_of(slab, cs_abs(top));
    cs_disk_cap below = cs_disk_cap_below(slab, (t - 0.5f) * inverse, blur);
    vfloat linear = cs_max(t + 0.5f, (vfloat)(0.0f));
    vfloat value = linear + scale * blur * (above.moment - below.moment);
    vfloat density = (top < 0.0f ? above.area : total - above.area) - below.area;
    vfloat slope = inverse * (above.width - below.width);
    cs_root_step step = cs_root_step_of(mass_root, value, scale * density, scale * slope);
    *rough = step.rough;
    return cs_clamp(t - step.back, (vfloat)(least), (vfloat)(0.0f));
}

/* What is seen of a slab along the fibres at t_y <= 0: bottom < v < top. */
typedef struct cs_disk_window {
    cs_disk_slab slab;
    vfloat bottom;
    vfloat top;
    f32 blur;
} cs_disk_window;

CS_INLINED vfloat cs_disk_window_area(cs_disk_window window, vfloat half_slab)
{
    vfloat above = cs_disk_cap_of(window.slab, cs_abs(window.top)).area;
    vfloat below = cs_disk_cap_below(window.slab, window.bottom, window.blur).area;
    return (window.top < 0.0f ? above : 2.0f * half_slab - above) - below;
}

/* Height of the window where the disk's half-chord is `chord`. */
CS_INLINED vfloat cs_disk_window_height(cs_disk_window window, vfloat chord)
{
    vfloat height = cs_min(chord, window.top) + cs_min(chord, -window.bottom);
    return cs_max(height, (vfloat)(0.0f));
}

/* Below: the u with the share `mass` <= 1/2 of the window's area on its left; in the area's second
 * derivative those of the window's two sides count that are arcs. Two steps leave an error of the
 * share below 5e-6, but for one tuple in a thousand, mostly in corners cut by the disk's edge,
 * where it is below 2e-4. */

/* Heights linear between both ends and the middle. */
CS_INLINED vfloat cs_disk_window_guess(vfloat mass, cs_disk_window window)
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

CS_INLINED vfloat cs_disk_window_step(vfloat u, vfloat mass_root, cs_disk_window window,
                                      vfloat area, vint *rough)
{
    vfloat first = window.slab.low;
    vfloat last = window.slab.high;
    vfloat scale = 1.0f / area;
    vfloat chord = cs_disk_chord(u);
    window.slab.high = u;
    window.slab.high_chord = chord;
    vfloat value = scale * cs_disk_window_area(window, cs_disk_half_slab(window.slab));
    vfloat density = scale * cs_disk_window_height(window, chord);
    vfloat turn = -scale * u / cs_max(chord, (vfloat)(1e-6f));
    vfloat upper = chord < window.top ? turn : (vfloat)(0.0f);
    vfloat lower = chord < -window.bottom ? turn : (vfloat)(0.0f);
    cs_root_step step = cs_root_step_of(mass_root, value, density, upper + lower);
    *rough = step.rough;
    return cs_clamp(u - step.back, first, last);
}

#endif
