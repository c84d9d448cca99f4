/* Power spectra of two-dimensional points. */
#include <stddef.h>
#include <stdlib.h>

#include "analysis/periodogram.h"
#include "analysis/spectrum.h"

enum {
    MOST_SIDE = 8192
};

/* Fills the whole plane from columns -width/2 ... width/2 and rows 0 ... height/2; P(-f) = P(f). */
static void unfold(const cs_lattice *lattice, const float *half, clshear_spectrum *spectrum)
{
    const size_t width = spectrum->width, height = spectrum->height;
    for (size_t row = 0; row < height; row++)
        for (size_t column = 0; column < width; column++) {
            const ptrdiff_t y = (ptrdiff_t)row - (ptrdiff_t)(height / 2);
            const ptrdiff_t x = (ptrdiff_t)column - (ptrdiff_t)(width / 2);
            const size_t from_row = (size_t)(y < 0 ? -y : y);
            const size_t from_column = (size_t)((y < 0 ? -x : x) + (ptrdiff_t)(width / 2));
            spectrum->power[row * width + column] =
                half[from_row * lattice->counts[0] + from_column];
        }
}

static clshear_status check_spectrum(const clshear_points *points, size_t width, size_t height,
                                     cs_error *error)
{
    if (points->dimensions != 2)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "a spectrum of points of %zu dimensions: must be 2; choose a projection",
                       points->dimensions);
    if (width < 2 || height < 2 || width > MOST_SIDE || height > MOST_SIDE)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "a spectrum of %zu x %zu frequencies: each side must be 2 to %d", width,
                       height, MOST_SIDE);
    return CLSHEAR_OK;
}

clshear_status cs_spectrum_measure(clshear_context *context, const clshear_points *points,
                                   size_t width, size_t height, clshear_spectrum *spectrum)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    float *half = NULL;
    clshear_spectrum made = {
        .width = width, .height = height, .sets = points->sets, .count = points->count};
    const cs_lattice lattice = {
        .sets = {{.first = {-(int32_t)(width / 2)}, .step = {1}, .wide = MOST_SIDE + 1, .deep = 1},
                 {.coordinate = {1}, .step = {1}, .wide = MOST_SIDE + 1, .deep = 1}},
        .counts = {(uint32_t)(width / 2 * 2 + 1), (uint32_t)(height / 2 + 1)}};
    CS_TRY(check_spectrum(points, width, height, error));
    half = malloc((size_t)lattice.counts[0] * lattice.counts[1] * sizeof *half);
    made.power = malloc(width * height * sizeof *made.power);
    CS_REQUIRE(half != NULL && made.power != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu x %zu frequencies", width, height);
    CS_TRY(cs_periodogram(context->device, points, &lattice, half, error));
    unfold(&lattice, half, &made);
    *spectrum = made;
    made.power = NULL;
done:
    free(made.power);
    free(half);
    return status;
}

void cs_spectrum_free(clshear_spectrum *spectrum)
{
    if (spectrum == NULL) return;
    free(spectrum->power);
    *spectrum = (clshear_spectrum){0};
}
