/* Regular polygons by their chords along v. Between neighbouring corners in u, both ends of the
 * chord are linear in u. */
#include <math.h>
#include <stdlib.h>

#include "base/pi.h"
#include "clshear/device/marginal.h"
#include "optics/aperture_kinds.h"

enum {
    MOST_BLADES = 32
};

typedef struct corner {
    double u;
    double v;
} corner;

static int by_u(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The chord at u, on the edges between u and `towards`: at a corner the two sides may differ. */
static void chord_near(const corner *corners, int blades, double u, double towards, double *low,
                       double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int i = 0; i < blades; i++) {
        const corner *a = &corners[i], *b = &corners[(i + 1) % blades];
        const double left = fmin(a->u, b->u), right = fmax(a->u, b->u);
        const double middle = 0.5 * (u + towards);
        if (!(left <= middle && middle <= right) || right - left < 1e-9) continue;
        const double v = a->v + (b->v - a->v) * (u - a->u) / (b->u - a->u);
        *low = fmin(*low, v);
        *high = fmax(*high, v);
    }
}

/* The distinct u of the corners in rising order; values within 1e-6 count as one. */
static cs_u32 knots_of(const corner *corners, int blades, double *knots)
{
    double all[MOST_BLADES];
    cs_u32 count = 0;
    for (int i = 0; i < blades; i++)
        all[i] = corners[i].u;
    qsort(all, (size_t)blades, sizeof *all, by_u);
    for (int i = 0; i < blades; i++)
        if (count == 0 || all[i] - knots[count - 1] > 1e-6) knots[count++] = all[i];
    return count;
}

static void place_corners(corner *corners, int blades, double rotation_deg)
{
    const double radius =
        sqrt(2.0 / (blades * sin(2.0 * CS_PI_DOUBLE / blades))); /* a polygon of area 1 */
    for (int i = 0; i < blades; i++) {
        const double angle = 2.0 * CS_PI_DOUBLE * i / blades + rotation_deg * CS_PI_DOUBLE / 180.0;
        corners[i] = (corner){radius * cos(angle), -radius * sin(angle)}; /* v points down */
    }
}

/* Fills the rows of the marginal; returns its second moment. */
static double fill_rows(const corner *corners, int blades, const double *knots, cs_u32 segments,
                        cs_f32 *rows)
{
    double cdf = 0.0, integral = 0.0, moment = 0.0;
    for (cs_u32 i = 0; i < segments; i++) {
        cs_f32 *row = rows + (size_t)i * CS_MARGINAL_COLUMNS;
        const double width = knots[i + 1] - knots[i];
        double low[2], high[2];
        chord_near(corners, blades, knots[i], knots[i + 1], &low[0], &high[0]);
        chord_near(corners, blades, knots[i + 1], knots[i], &low[1], &high[1]);
        const double density = high[0] - low[0];
        const double slope = (high[1] - low[1] - density) / width;
        row[CS_MARGINAL_START] = (cs_f32)knots[i];
        row[CS_MARGINAL_CDF] = (cs_f32)cdf;
        row[CS_MARGINAL_INTEGRAL] = (cs_f32)integral;
        row[CS_MARGINAL_DENSITY] = (cs_f32)density;
        row[CS_MARGINAL_SLOPE] = (cs_f32)slope;
        row[CS_MARGINAL_LOW] = (cs_f32)low[0];
        row[CS_MARGINAL_LOW_SLOPE] = (cs_f32)((low[1] - low[0]) / width);
        integral += width * (cdf + width * (0.5 * density + slope * width / 6.0));
        const double piece = width * (density + 0.5 * slope * width);
        const double middle = 0.5 * (knots[i] + knots[i + 1]);
        moment += piece * (middle * middle + width * width / 12.0);
        cdf += piece;
    }
    cs_f32 *end = rows + (size_t)segments * CS_MARGINAL_COLUMNS;
    end[CS_MARGINAL_START] = (cs_f32)knots[segments];
    end[CS_MARGINAL_CDF] = 1.0f;
    end[CS_MARGINAL_INTEGRAL] = (cs_f32)integral;
    return moment;
}

float cs_polygon_unit(const cs_view *camera)
{
    const float blades = camera->blades > 2 ? (float)camera->blades : 3.0f;
    return sqrtf(0.5f * blades * sinf(2.0f * CS_PI / blades));
}

/* Appends the marginal of u, with the chords along v. Returns its second moment through `moment`
 * and its segments through `segments`. */
static clshear_status append_marginal(const corner *corners, int blades, cs_optics_tables *tables,
                                      cs_u32 *segments, double *moment, cs_error *error)
{
    double knots[MOST_BLADES] = {0};
    *segments = knots_of(corners, blades, knots) - 1;
    const size_t size = (size_t)(*segments + 1) * CS_MARGINAL_COLUMNS;
    cs_f32 *rows = cs_array_extend(&tables->table, size);
    if (rows == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *moment = fill_rows(corners, blades, knots, *segments, rows);
    return CLSHEAR_OK;
}

clshear_status cs_polygon_make(const cs_view *camera, cs_optics_tables *tables, cs_error *error)
{
    const int blades = camera->blades;
    const float rotation_deg = camera->blade_rotation_deg;
    cs_optics *optics = &tables->optics;
    clshear_status status = CLSHEAR_OK;
    corner corners[MOST_BLADES];
    if (blades < 3 || blades > MOST_BLADES)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "an aperture of %d blades: must be 3 to %d",
                       blades, MOST_BLADES);
    if (!isfinite(rotation_deg))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "blade rotation: must be finite");
    place_corners(corners, blades, fmod((double)rotation_deg, 360.0));
    optics->marginal = CS_MARGINAL_POLYGON;
    for (int axis = 0; axis < 2; axis++) {
        double moment = 0.0;
        CS_TRY(append_marginal(corners, blades, tables, &optics->segments[axis], &moment, error));
        optics->half_width[axis] = (cs_f32)hypot(corners[0].u, corners[0].v);
        optics->deviation[axis] = (cs_f32)sqrt(moment);
        for (int i = 0; i < blades; i++)
            corners[i] = (corner){corners[i].v, corners[i].u};
    }
done:
    return status;
}
