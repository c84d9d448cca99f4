/* Prints the table of albedos (microfacet.h) as the elements of a C array: a program of the build,
 * since the numbers take some tenths of a second and never change. */
#include <math.h>
#include <stdio.h>

#include "kernels/bsdf/bsdf.h"

enum {
    POINTS = 2584, /* of a Fibonacci lattice, and its generator (Sloan & Joe 1994, section 4.2) */
    GENERATOR = 1597
};

/* Albedos for one cosine and roughness, by a lattice: facets by visible normals, each of which
 * counts with shadowing over masking; sheen by directions that crowd at the horizon, where it
 * shines: their height is a square. */
static void integrate(float cosine, float roughness, double *albedo, double *sheen)
{
    const float width = cs_facet_width(roughness);
    const float out[3] = {sqrtf(1.0f - cosine * cosine), 0.0f, cosine};
    const float slant = cs_facet_slant(cosine, width);
    *sheen = 0.0;
    for (int p = 0; p < CS_ALBEDO_PLANES; p++)
        albedo[p] = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const cs_pair pair = {((float)i + 0.5f) / POINTS,
                              ((float)(i * GENERATOR % POINTS) + 0.5f) / POINTS};
        float facet[3];
        cs_visible_facet(out, width, pair, facet);
        const float along = cs_inner(out, facet), up = 2.0f * along * facet[2] - cosine;
        if (up > 0.0f) {
            const float part =
                up * (cosine + slant) / (up * slant + cosine * cs_facet_slant(up, width));
            albedo[CS_ALBEDO_ALL] += (double)part;
            albedo[CS_ALBEDO_SCHLICK] += (double)(part * cs_schlick(along));
        }
        const float height = pair.y * pair.y, sine = sqrtf(1.0f - height * height);
        const float in[3] = {sine * cosf(2.0f * CS_PI * pair.x), sine * sinf(2.0f * CS_PI * pair.x),
                             height};
        float half_way[3];
        cs_half_way(out, in, half_way);
        *sheen += (double)(4.0f * CS_PI * pair.y * height *
                           cs_sheen(half_way[2], cosine, height, roughness));
    }
    *sheen /= POINTS;
    for (int p = 0; p < CS_ALBEDO_PLANES; p++)
        albedo[p] /= POINTS;
}

/* 2 int E(c) c dc of the linear pieces between every `stride`-th value; Simpson's rule is exact for
 * them. */
static float average_of(const float *values, int stride)
{
    double sum = 0.0;
    const double step = 1.0 / (CS_ALBEDO_COSINES - 1);
    for (int i = 0; i + 1 < CS_ALBEDO_COSINES; i++) {
        const double a = (double)values[i * stride], b = (double)values[(i + 1) * stride];
        const double c = i * step;
        sum += (a * c + 4.0 * 0.5 * (a + b) * (c + 0.5 * step) + b * (c + step)) * step / 6.0;
    }
    return (float)(2.0 * sum);
}

static void make_row(float roughness, float *row)
{
    for (int c = 0; c < CS_ALBEDO_COSINES; c++) {
        double albedo[CS_ALBEDO_PLANES], sheen;
        const float cosine = (float)c / (CS_ALBEDO_COSINES - 1);
        integrate(cosine > 1e-3f ? cosine : 1e-3f, roughness, albedo, &sheen);
        for (int p = 0; p < CS_ALBEDO_PLANES; p++)
            row[c * CS_ALBEDO_PLANES + p] = (float)albedo[p];
        row[CS_ALBEDO_FIBRES + c] = (float)sheen;
    }
    for (int p = 0; p < CS_ALBEDO_PLANES; p++)
        row[CS_ALBEDO_COSINES * CS_ALBEDO_PLANES + p] = average_of(row + p, CS_ALBEDO_PLANES);
}

int main(void)
{
    for (int r = 0; r < CS_ALBEDO_ROUGHNESSES; r++) {
        float row[CS_ALBEDO_ROW] = {0.0f};
        make_row((float)r / (CS_ALBEDO_ROUGHNESSES - 1), row);
        for (int i = 0; i < CS_ALBEDO_ROW; i++)
            printf("%af,\n", (double)row[i]);
    }
    return fflush(stdout) == 0 && ferror(stdout) == 0 ? 0 : 1;
}
