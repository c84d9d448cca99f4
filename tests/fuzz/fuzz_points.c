/* The bytes as a file of point sets: what is read comes back from a file that it is written to. */
#include <stdlib.h>
#include <string.h>

#include "points/points.h"
#include "targets.h"

void cs_fuzz_points(const uint8_t *data, size_t size)
{
    clshear_points points = {0}, again = {0};
    if (cs_points_read(cs_fuzz_file("x.txt", data, size), &points) != CLSHEAR_OK) return;
    const char *copy = cs_fuzz_path(size % 2 == 0 ? "copy.txt" : "copy.csv");
    if (cs_points_write(&points, copy) != CLSHEAR_OK) abort();
    if (cs_points_read(copy, &again) != CLSHEAR_OK) abort();
    if (again.sets != points.sets || again.count != points.count ||
        again.dimensions != points.dimensions ||
        memcmp(again.values, points.values,
               points.sets * points.count * points.dimensions * sizeof(float)) != 0)
        abort();
    cs_points_free(&points);
    cs_points_free(&again);
}
