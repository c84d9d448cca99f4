/* Triangles as points see them: their solid angle, and uniform directions within it. Shared.
 *
 * Everything is in the cosines between the directions of the corners and in their triple product
 * (Van Oosterom & Strackee 1983). A direction is drawn as by Arvo 1995, in two steps: the third
 * corner moves along its edge until the triangle that is left has its part of the solid angle, then
 * a point is taken from the arc to it. Half vectors make the first step linear (Peters 2021), and
 * the result is a weighted sum of the corners, so that it keeps its digits in the smallest triangle
 * and never leaves it. */
#ifndef CS_LIGHT_SEEN_TRIANGLE_H
#define CS_LIGHT_SEEN_TRIANGLE_H

#include "clshear/device/sampler/grid.h"
#include "kernels/trigonometry.h"
#include "kernels/vector.h"

typedef struct cs_seen_triangle {
    cs_vfloat inverse[3];  /* of the distances of the corners; per unit of length */
    cs_vfloat cosine[3];   /* between corners 0 and 1, 1 and 2, 2 and 0 */
    cs_vfloat triple;      /* product of their directions, at least 0 */
    cs_vfloat solid_angle; /* steradians, 0 to 2 pi */
} cs_seen_triangle;

/* corner: from the point to the first corner; the edges lead from there to the others. */
static inline cs_seen_triangle cs_see_triangle(const cs_vfloat *corner, const cs_vfloat *edge1,
                                               const cs_vfloat *edge2)
{
    cs_seen_triangle seen;
    cs_vfloat to[3][3], volume = (cs_vfloat)(0.0f);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        to[0][i] = corner[i];
        to[1][i] = corner[i] + edge1[i];
        to[2][i] = corner[i] + edge2[i];
        volume += corner[i] * (edge1[j] * edge2[k] - edge1[k] * edge2[j]);
    }
    for (int i = 0; i < 3; i++)
        seen.inverse[i] = 1.0f / cs_sqrt(cs_max(cs_dot(to[i], to[i]), (cs_vfloat)(1e-30f)));
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        seen.cosine[i] = cs_dot(to[i], to[j]) * seen.inverse[i] * seen.inverse[j];
    }
    seen.triple = cs_abs(volume) * seen.inverse[0] * seen.inverse[1] * seen.inverse[2];
    seen.solid_angle =
        2.0f * cs_angle_to(seen.triple, 1.0f + seen.cosine[0] + seen.cosine[1] + seen.cosine[2]);
    return seen;
}

/* A uniform direction in the solid angle by a point of the unit square; `place` becomes the parts
 * of the first and the second edge that lead to where it meets the triangle. */
static inline void cs_draw_in_triangle(const cs_seen_triangle *seen, cs_pair pair, cs_vfloat *place)
{
    const cs_vfloat *cosine = seen->cosine;
    cs_vfloat half_angle = 0.5f * seen->solid_angle * pair.x;
    cs_vfloat sine, along_first;
    cs_sine_cosine(half_angle, &sine, &along_first);
    /* The half vector between corner 0 and the moved one, as parts of corners 0 and 2. */
    cs_vfloat first = seen->triple * along_first - (cosine[2] + cosine[1]) * sine;
    cs_vfloat third = (1.0f + cosine[0]) * sine;
    cs_vfloat part = third / cs_max(first + third, (cs_vfloat)(1e-37f));
    cs_vfloat apart = 1.0f - cosine[2];
    cs_vfloat scale = 2.0f * (1.0f - part * apart) / (1.0f - 2.0f * part * (1.0f - part) * apart);
    cs_vfloat moved0 = scale * (1.0f - part) - 1.0f, moved2 = scale * part;
    /* One less the cosine of the arc from corner 1. */
    cs_vfloat fall = 1.0f - moved0 * cosine[0] - moved2 * cosine[1];
    cs_vfloat along = pair.y * fall;
    cs_vfloat end = cs_sqrt(pair.y * (2.0f - along) / cs_max(2.0f - fall, (cs_vfloat)(1e-6f)));
    cs_vfloat weight0 = cs_max(end * moved0, (cs_vfloat)(0.0f)) * seen->inverse[0];
    cs_vfloat weight1 = cs_max(1.0f - along - end * (1.0f - fall), (cs_vfloat)(0.0f));
    cs_vfloat weight2 = end * moved2 * seen->inverse[2];
    weight1 *= seen->inverse[1];
    cs_vfloat all = 1.0f / cs_max(weight0 + weight1 + weight2, (cs_vfloat)(1e-37f));
    place[0] = weight1 * all;
    place[1] = weight2 * all;
}

#endif
