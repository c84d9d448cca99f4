/* Pixel filters as densities on steps of equal width. */
#include <math.h>

#include "base/pi.h"
#include "optics/aperture_kinds.h"

static const float usual_width_px[] = {
    [CLSHEAR_FILTER_BOX] = 1.0f,
    [CLSHEAR_FILTER_TENT] = 2.0f,
    [CLSHEAR_FILTER_GAUSSIAN] = 3.0f,
    [CLSHEAR_FILTER_BLACKMAN_HARRIS] = 3.0f,
};

/* Unnormalised filter value at `place`, which runs from -1/2 to 1/2 over the filter's width. */
static double height(clshear_filter filter, double place)
{
    const double turn = 2.0 * CS_PI_DOUBLE * place, deviations = 6.0 * place;
    switch (filter) {
    case CLSHEAR_FILTER_TENT:
        return 1.0 - 2.0 * fabs(place);
    case CLSHEAR_FILTER_GAUSSIAN:
        return exp(-0.5 * deviations * deviations) - exp(-4.5);
    case CLSHEAR_FILTER_BLACKMAN_HARRIS: /* Harris 1978, the minimum four-term window */
        return 0.35875 + 0.48829 * cos(turn) + 0.14128 * cos(2.0 * turn) +
               0.01168 * cos(3.0 * turn);
    default:
        return 1.0;
    }
}

/* Mean filter value on step `k` of `steps`. */
static double mean_height(clshear_filter filter, cs_u32 k, cs_u32 steps)
{
    enum {
        PARTS = 64
    };
    double sum = 0.0;
    for (int i = 0; i < PARTS; i++)
        sum += height(filter, (k + (i + 0.5) / PARTS) / steps - 0.5);
    return sum / PARTS;
}

clshear_status cs_filter_make(clshear_filter filter, float width_px, cs_optics_tables *tables,
                              cs_error *error)
{
    cs_optics *optics = &tables->optics;
    if ((cs_u32)filter >= sizeof usual_width_px / sizeof *usual_width_px)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "filter %d is not known", (int)filter);
    if (!(width_px >= 0.0f && width_px <= 64.0f) || (width_px > 0.0f && width_px < 0.01f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "filter width %g px: must be 0.01 to 64, or 0 for the usual",
                       (double)width_px);
    cs_f32 *table = cs_array_extend(&tables->table, CS_FILTER_STEPS);
    if (table == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    const float width = width_px > 0.0f ? width_px : usual_width_px[filter];
    const cs_u32 steps = filter == CLSHEAR_FILTER_BOX ? 1 : CS_FILTER_STEPS;
    const double step = (double)width / steps;
    double sum = 0.0, square = 0.0;
    for (cs_u32 k = 0; k < steps; k++)
        sum += mean_height(filter, k, steps) * step;
    for (cs_u32 k = 0; k < steps; k++) {
        const double density = mean_height(filter, k, steps) / sum;
        const double place = (k + 0.5) * step - 0.5 * (double)width;
        table[k] = (cs_f32)density;
        square += density * step * (place * place + step * step / 12.0);
    }
    optics->filter_steps = steps;
    optics->filter_width = width;
    optics->filter_deviation = (cs_f32)sqrt(square);
    return CLSHEAR_OK;
}
