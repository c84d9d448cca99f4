#include "import/polygon.h"

#include <math.h>
#include <stdlib.h>

/* A polygon in its plane: a ring of corners that are left. */
typedef struct ring {
    double (*points)[2]; /* anticlockwise */
    uint32_t *next;
    uint32_t *before;
    double *budget; /* points that may still be looked at */
} ring;

/* Twice the area of a triangle, positive if it is anticlockwise. */
static double area(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Projects along the largest axis of the area vector, which turns anticlockwise afterwards. */
static void flatten(const double (*positions)[3], const cs_corner *corners, size_t count,
                    double (*points)[2])
{
    double normal[3] = {0, 0, 0};
    const double *origin = positions[corners[0].position];
    for (size_t i = 0; i < count; i++) { /* Newell */
        const double *p = positions[corners[i].position];
        const double *q = positions[corners[(i + 1) % count].position];
        for (int k = 0; k < 3; k++) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            normal[k] +=
                (p[u] - origin[u]) * (q[v] - origin[v]) - (p[v] - origin[v]) * (q[u] - origin[u]);
        }
    }
    int axis = fabs(normal[1]) > fabs(normal[0]) ? 1 : 0;
    if (fabs(normal[2]) > fabs(normal[axis])) axis = 2;
    const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
    for (size_t i = 0; i < count; i++) {
        const double *p = positions[corners[i].position];
        points[i][0] = sign * (p[(axis + 1) % 3] - origin[(axis + 1) % 3]);
        points[i][1] = p[(axis + 2) % 3] - origin[(axis + 2) % 3];
    }
}

static int is_ear(ring *left, uint32_t tip)
{
    const double *a = left->points[left->before[tip]], *b = left->points[tip];
    const double *c = left->points[left->next[tip]];
    if (!(area(a, b, c) > 0.0)) return 0;
    for (uint32_t i = left->next[left->next[tip]]; i != left->before[tip]; i = left->next[i]) {
        const double *p = left->points[i];
        if ((*left->budget)-- < 0.0) return 1;
        const int corner = (p[0] == a[0] && p[1] == a[1]) || (p[0] == b[0] && p[1] == b[1]) ||
                           (p[0] == c[0] && p[1] == c[1]);
        if (!corner && area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0)
            return 0;
    }
    return 1;
}

/* Takes a corner out of the ring and writes the triangle that goes with it. */
static void take(ring *left, uint32_t tip, uint32_t *triangle)
{
    triangle[0] = left->before[tip];
    triangle[1] = tip;
    triangle[2] = left->next[tip];
    left->next[left->before[tip]] = left->next[tip];
    left->before[left->next[tip]] = left->before[tip];
}

static void cut_ears(ring *left, size_t count, uint32_t *triangles)
{
    uint32_t tip = 0;
    for (size_t done = 0; done + 2 < count; done++) {
        size_t tried = 0;
        while (tried < count - done && !is_ear(left, tip)) {
            tip = left->next[tip];
            tried++;
        }
        /* Without an ear the next corner goes: straight ones and crossings. */
        const uint32_t after = left->next[tip];
        take(left, tip, triangles + 3 * done);
        tip = left->next[after];
    }
}

static void cut_fan(size_t count, uint32_t *triangles)
{
    for (size_t i = 0; i + 2 < count; i++) {
        triangles[3 * i] = 0;
        triangles[3 * i + 1] = (uint32_t)i + 1;
        triangles[3 * i + 2] = (uint32_t)i + 2;
    }
}

static int is_convex(const double (*points)[2], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (area(points[i], points[(i + 1) % count], points[(i + 2) % count]) < 0.0) return 0;
    return 1;
}

void cs_polygon_cut(const double (*positions)[3], const cs_corner *corners, size_t count,
                    double *budget, uint32_t *triangles)
{
    cut_fan(count, triangles);
    if (count == 3) return;
    double few_points[8][2];
    uint32_t few_links[16];
    double(*points)[2] = count <= 8 ? few_points : malloc(count * sizeof *points);
    uint32_t *links = count <= 8 ? few_links : malloc(2 * count * sizeof *links);
    if (points != NULL && links != NULL) {
        flatten(positions, corners, count, points);
        if (!is_convex((const double(*)[2])points, count)) {
            ring left = {points, links, links + count, budget};
            for (uint32_t i = 0; i < count; i++) {
                left.next[i] = i + 1 < count ? i + 1 : 0;
                left.before[i] = i > 0 ? i - 1 : (uint32_t)count - 1;
            }
            cut_ears(&left, count, triangles);
        }
    }
    if (points != few_points) free(points);
    if (links != few_links) free(links);
}
