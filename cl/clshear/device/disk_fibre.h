/* Fibres through a pixel and a round lens, for the equal-area shear of the disk.
 *
 * Fibre coordinates, centred, are t_x = X + blur * U and t_y = Y + blur * V with (X, Y) uniform on
 * the pixel [-1/2, 1/2]^2 and (U, V) on the disk of area 1. Given t, (U, V) is uniform on the part
 * of the disk inside the square of side 1 / blur about t / blur. All areas below are built from
 * trapezoids and segments of the circle no larger than themselves: differences of antiderivatives
 * would lose their digits when the blur is wide. */
#ifndef CLSHEAR_DEVICE_DISK_FIBRE_H
#define CLSHEAR_DEVICE_DISK_FIBRE_H

#include "disk.h"

#include "fp_contract_off.h"

/* Half the chord at signed distance `place` from the centre; 0 outside the disk. */
CS_INLINED cs_vfloat cs_disk_chord(cs_vfloat place)
{
    cs_vfloat square = (CS_DISK_RADIUS - place) * (CS_DISK_RADIUS + place);
    return cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
}

/* The part of the disk between two values of u. */
typedef struct cs_disk_slab {
    cs_vfloat low;        /* smaller u */
    cs_vfloat high;       /* larger u */
    cs_vfloat low_chord;  /* half the chord at `low` */
    cs_vfloat high_chord; /* half the chord at `high` */
} cs_disk_slab;

/* The slab from `low` to `high`, both in the disk, low <= high. */
CS_INLINED cs_disk_slab cs_disk_slab_of(cs_vfloat low, cs_vfloat high)
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
CS_INLINED cs_vfloat cs_disk_segment_on(cs_vfloat u, cs_vfloat v, cs_vfloat width, cs_vfloat rise)
{
    cs_vfloat sine = cs_max(width * v - u * rise, (cs_vfloat)(0.0f)) * CS_PI;
    cs_vfloat versine = (width * width + rise * rise) * (0.5f * CS_PI);
    return cs_disk_segment(sine, cs_min(versine, (cs_vfloat)(2.0f)));
}

/* Area of a slab's upper half: a trapezoid and a segment. */
CS_INLINED cs_vfloat cs_disk_half_slab(cs_disk_slab slab)
{
    cs_vfloat width = slab.high - slab.low;
    return 0.5f * width * (slab.low_chord + slab.high_chord) +
           cs_disk_segment_on(slab.low, slab.low_chord, width, slab.high_chord - slab.low_chord);
}

/* The part of a slab above v = height >= 0, where its half-chord is c(u). */
typedef struct cs_disk_cap {
    cs_vfloat width;  /* length of its lower side */
    cs_vfloat area;   /* integral of max(c - height, 0) du */
    cs_vfloat moment; /* integral of max(c - height, 0)^2 / 2 du */
} cs_disk_cap;

/* The cap of a slab above `height`. The moment of a segment about v = 0 is chord^2 * width / 12. */
CS_INLINED cs_disk_cap cs_disk_cap_of(cs_disk_slab slab, cs_vfloat height)
{
    cs_vfloat reach = cs_disk_chord(height);
    cs_vfloat left = cs_max(slab.low_chord - height, (cs_vfloat)(0.0f));
    cs_vfloat right = cs_max(slab.high_chord - height, (cs_vfloat)(0.0f));
    cs_disk_cap cap;
    cs_vfloat first = cs_max(slab.low, -reach);
    cap.width = cs_max(cs_min(slab.high, reach) - first, (cs_vfloat)(0.0f));
    cs_vfloat segment = cs_disk_segment_on(first, height + left, cap.width, right - left);
    cap.area = 0.5f * cap.width * (left + right) + segment;
    cs_vfloat square = 0.25f * (left * left + right * right);
    cap.moment = cap.width * (square + (1.0f / 12.0f) * cap.width * cap.width) - height * segment;
    return cap;
}

/* The cap below v = bottom, for fibres with t_y <= 0: bottom <= -1/2 / blur is outside the disk
 * for blurs up to 1/2 / R. */
CS_INLINED cs_disk_cap cs_disk_cap_below(cs_disk_slab slab, cs_vfloat bottom, cs_f32 blur)
{
    cs_disk_cap none;
    none.width = (cs_vfloat)(0.0f);
    none.area = (cs_vfloat)(0.0f);
    none.moment = (cs_vfloat)(0.0f);
    return blur > 0.886f ? cs_disk_cap_of(slab, -bottom) : none;
}

/* The next functions find t_y for a given t_x: the t <= 0 with P(Y + blur * V < t) = mass, for mass
 * in (0, 1/2] and (U, V) uniform on a slab whose upper half has area `half_slab`.
 *
 * F(t) = max(t + 1/2, 0) + blur * (M((t + 1/2) / blur) - M((t - 1/2) / blur)) / (2 * half_slab),
 * M(q) the moment of the cap above |q|. The guess takes V as uniform with about its variance. One
 * step leaves an error of F below 2e-6 where it does not ask for a second, two leave 3e-7, or 4e-8
 * * blur for wide blurs, but for one tuple in a thousand, where it is below 6e-6. */
CS_INLINED cs_vfloat cs_disk_slab_guess(cs_vfloat mass, cs_disk_slab slab, cs_f32 blur)
{
    cs_vfloat mean = slab.low * slab.low + slab.low * slab.high + slab.high * slab.high;
    cs_vfloat square = CS_DISK_RADIUS * CS_DISK_RADIUS - (1.0f / 3.0f) * mean;
    cs_vfloat side = 2.0f * blur * cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    return cs_trapezoid_fibre(mass, side);
}

/* A better t; `mass_root` is sqrt(mass), `half_slab` the area of the slab's upper half. `rough`
 * receives the mask of lanes that want another step. */
CS_INLINED cs_vfloat cs_disk_slab_step(cs_vfloat t, cs_vfloat mass_root, cs_disk_slab slab,
                                       cs_vfloat half_slab, cs_f32 blur, cs_vint *rough)
{
    cs_f32 inverse = 1.0f / blur;
    cs_f32 least = -0.5f - blur * CS_DISK_RADIUS;
    cs_vfloat total = 2.0f * half_slab;
    cs_vfloat scale = 1.0f / total;
    cs_vfloat top = (t + 0.5f) * inverse;
    cs_disk_cap above = cs_disk_cap_of(slab, cs_abs(top));
    cs_disk_cap below = cs_disk_cap_below(slab, (t - 0.5f) * inverse, blur);
    cs_vfloat linear = cs_max(t + 0.5f, (cs_vfloat)(0.0f));
    cs_vfloat value = linear + scale * blur * (above.moment - below.moment);
    cs_vfloat density = (top < 0.0f ? above.area : total - above.area) - below.area;
    cs_vfloat slope = inverse * (above.width - below.width);
    cs_root_step step = cs_root_step_of(mass_root, value, scale * density, scale * slope);
    *rough = step.rough;
    return cs_clamp(t - step.back, (cs_vfloat)(least), (cs_vfloat)(0.0f));
}

/* The part of a slab that fibres at one t_y <= 0 see: bottom < v < top. */
typedef struct cs_disk_window {
    cs_disk_slab slab;
    cs_vfloat bottom; /* (t_y - 1/2) / blur */
    cs_vfloat top;    /* (t_y + 1/2) / blur */
    cs_f32 blur;      /* pixels per lens unit */
} cs_disk_window;

/* Area of the window; `half_slab` is the area of the slab's upper half. */
CS_INLINED cs_vfloat cs_disk_window_area(cs_disk_window window, cs_vfloat half_slab)
{
    cs_vfloat above = cs_disk_cap_of(window.slab, cs_abs(window.top)).area;
    cs_vfloat below = cs_disk_cap_below(window.slab, window.bottom, window.blur).area;
    return (window.top < 0.0f ? above : 2.0f * half_slab - above) - below;
}

/* Height of the window where the disk's half-chord is `chord`. */
CS_INLINED cs_vfloat cs_disk_window_height(cs_disk_window window, cs_vfloat chord)
{
    cs_vfloat height = cs_min(chord, window.top) + cs_min(chord, -window.bottom);
    return cs_max(height, (cs_vfloat)(0.0f));
}

/* The next functions find the u that has the share `mass`, at most 1/2, of the window's area on its
 * left. A side of the window adds to the area's second derivative only where it is an arc.
 * Two steps leave an error of the share below 5e-6, but for one tuple in a thousand, mostly in
 * corners cut by the disk's edge, where it is below 2e-4. */

/* First guess of that u: the height as linear between both ends and the middle. */
CS_INLINED cs_vfloat cs_disk_window_guess(cs_vfloat mass, cs_disk_window window)
{
    cs_vfloat extent = 0.5f * (window.slab.high - window.slab.low);
    cs_vfloat middle = window.slab.low + extent;
    cs_vfloat first = cs_disk_window_height(window, window.slab.low_chord);
    cs_vfloat second = cs_disk_window_height(window, cs_disk_chord(middle));
    cs_vfloat third = cs_disk_window_height(window, window.slab.high_chord);
    cs_vfloat rest = mass * (first + 2.0f * second + third);
    cs_vint left = rest < first + second;
    cs_vfloat start = left ? first : second;
    cs_vfloat rise = (left ? second : third) - start;
    rest = left ? rest : rest - (first + second);
    cs_vfloat root = cs_sqrt(cs_max(start * start + rise * rest, (cs_vfloat)(1e-20f)));
    return (left ? window.slab.low : middle) + extent * rest / (start + root);
}

/* A better u; `mass_root` is sqrt(mass), `area` the window's. `rough` receives the mask of lanes
 * that want another step. */
CS_INLINED cs_vfloat cs_disk_window_step(cs_vfloat u, cs_vfloat mass_root, cs_disk_window window,
                                         cs_vfloat area, cs_vint *rough)
{
    cs_vfloat first = window.slab.low;
    cs_vfloat last = window.slab.high;
    cs_vfloat scale = 1.0f / area;
    cs_vfloat chord = cs_disk_chord(u);
    window.slab.high = u;
    window.slab.high_chord = chord;
    cs_vfloat value = scale * cs_disk_window_area(window, cs_disk_half_slab(window.slab));
    cs_vfloat density = scale * cs_disk_window_height(window, chord);
    cs_vfloat turn = -scale * u / cs_max(chord, (cs_vfloat)(1e-6f));
    cs_vfloat upper = chord < window.top ? turn : (cs_vfloat)(0.0f);
    cs_vfloat lower = chord < -window.bottom ? turn : (cs_vfloat)(0.0f);
    cs_root_step step = cs_root_step_of(mass_root, value, density, upper + lower);
    *rough = step.rough;
    return cs_clamp(u - step.back, first, last);
}

#include "fp_contract_restore.h"

#endif
