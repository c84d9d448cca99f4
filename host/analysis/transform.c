/* Spectra of values on a grid, by the discrete Fourier transform. */
#include <fftw3.h>
#include <math.h>
#include <stdlib.h>

#include "analysis/fourier.h"
#include "analysis/spectrum.h"
#include "base/pi.h"

clshear_status cs_spectrum_of_grid(const float *values, size_t width, size_t height,
                                   clshear_spectrum *spectrum)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    fftw_complex *data = NULL;
    fftw_plan plan = NULL;
    double sum = 0.0;
    clshear_spectrum made = {.width = width, .height = height, .sets = 1, .count = width * height};
    CS_REQUIRE(width >= 2 && height >= 2 && width <= 8192 && height <= 8192, CLSHEAR_BAD_ARGUMENT,
               "a spectrum of %zu x %zu values: each side must be 2 to 8192", width, height);
    data = fftw_malloc(made.count * sizeof *data);
    made.power = malloc(made.count * sizeof *made.power);
    CS_REQUIRE(data != NULL && made.power != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu x %zu values", width, height);
    cs_fourier_start();
    plan = fftw_plan_dft_2d((int)height, (int)width, data, data, FFTW_FORWARD, FFTW_ESTIMATE);
    CS_REQUIRE(plan != NULL, CLSHEAR_OUT_OF_MEMORY, "no transform of %zu x %zu values", width,
               height);
    for (size_t i = 0; i < made.count; i++) {
        data[i][0] = (double)values[i];
        data[i][1] = 0.0;
    }
    fftw_execute(plan);
    for (size_t i = 1; i < made.count; i++)
        sum += data[i][0] * data[i][0] + data[i][1] * data[i][1];
    const double scale = sum > 0.0 ? (double)(made.count - 1) / sum : 0.0;
    for (size_t i = 0; i < made.count; i++) { /* frequency 0 moves to the middle */
        const size_t column = (i % width + width / 2) % width;
        const size_t row = (i / width + height / 2) % height;
        made.power[row * width + column] =
            (float)(scale * (data[i][0] * data[i][0] + data[i][1] * data[i][1]));
    }
    *spectrum = made;
    made.power = NULL;
done:
    if (plan != NULL) fftw_destroy_plan(plan);
    fftw_free(data);
    free(made.power);
    return status;
}

/* Hann's window over `count` values. */
static double window(size_t index, size_t count)
{
    return 0.5 - 0.5 * cos(2.0 * CS_PI_DOUBLE * ((double)index + 0.5) / (double)count);
}

clshear_status cs_spectrum_of_slice(const float *values, size_t width, size_t height,
                                    clshear_spectrum *spectrum)
{
    double mean = 0.0;
    float *windowed = malloc(width * height * sizeof *windowed);
    if (windowed == NULL) return cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t i = 0; i < width * height; i++)
        mean += (double)values[i] / ((double)width * (double)height);
    for (size_t i = 0; i < width * height; i++)
        windowed[i] = (float)(((double)values[i] - mean) * window(i % width, width) *
                              window(i / width, height));
    const clshear_status status = cs_spectrum_of_grid(windowed, width, height, spectrum);
    free(windowed);
    return status;
}
