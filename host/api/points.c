/* Public functions of point sets. */
#include "points/points.h"

#include <stdlib.h>

#include "analysis/integrands.h"
#include "api/arguments.h"

CS_HAND_OVER(points)

clshear_status clshear_points_draw(const char *sampler, size_t count, size_t sets, uint32_t seed,
                                   clshear_points **points)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    clshear_points made = {0};
    return hand_over(cs_points_draw(sampler, count, sets, seed, 0, 0, &made), &made, points);
}

clshear_status clshear_points_draw_fresh(const char *sampler, size_t count, size_t sets,
                                         uint32_t seed, clshear_points **points)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    clshear_points made = {0};
    return hand_over(cs_points_draw(sampler, count, sets, seed, 1, 0, &made), &made, points);
}

clshear_status clshear_points_draw_moving(const char *sampler, size_t count, size_t sets,
                                          uint32_t seed, int fresh, clshear_points **points)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    clshear_points made = {0};
    return hand_over(cs_points_draw(sampler, count, sets, seed, fresh, 1, &made), &made, points);
}

clshear_status clshear_points_create(const float *values, size_t sets, size_t count,
                                     const char *names, clshear_points **points)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(values);
    CS_NEEDS(names);
    CS_NEEDS(points);
    clshear_points made = {0};
    return hand_over(cs_points_take(values, sets, count, names, &made), &made, points);
}

clshear_status clshear_points_read(const char *path, clshear_points **points)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS_NAME(path);
    CS_NEEDS(points);
    clshear_points made = {0};
    return hand_over(cs_points_read(path, &made), &made, points);
}

CS_FREES(points)

CS_GETTER(const float *, points, values)
CS_GETTER(size_t, points, sets)
CS_GETTER(size_t, points, count)
CS_GETTER(size_t, points, dimensions)
CS_GETTER(const char *, points, names)

clshear_status clshear_points_shear(clshear_points *points, clshear_shear shear, float shear_px)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    return cs_points_shear(points, shear, shear_px);
}

clshear_status clshear_points_shear_moving(clshear_points *points, clshear_shear shear,
                                           float shear_px, const float velocity_px[2])
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    CS_NEEDS(velocity_px);
    const cs_velocity velocity = {velocity_px[0], velocity_px[1]};
    return cs_points_shear_moving(points, shear, shear_px, velocity);
}

clshear_status clshear_points_select(clshear_points *points, const char *names)
{
    CS_NEEDS(points);
    CS_NEEDS(names);
    return cs_points_select(points, names);
}

clshear_status clshear_points_write(const clshear_points *points, const char *path)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    CS_NEEDS_NAME(path);
    return cs_points_write(points, path);
}

void clshear_points_integrate(const clshear_points *points, const clshear_integrand *integrand,
                              int homogenise, uint32_t seed, double *means)
{
    CS_PLAIN_FLOATS;
    clshear_integrand copy;
    if (points == NULL || integrand == NULL || means == NULL) return;
    if (cs_struct_in(&copy, sizeof copy, integrand, "integrand") == CLSHEAR_OK)
        cs_points_integrate(points, &copy, homogenise, seed, means);
}

clshear_status clshear_points_integrate_4d(const clshear_points *points, clshear_function function,
                                           void *user, int homogenise, uint32_t seed, double *means)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(points);
    CS_NEEDS(function);
    CS_NEEDS(means);
    return cs_points_integrate_4d(points, function, user, homogenise, seed, means);
}
