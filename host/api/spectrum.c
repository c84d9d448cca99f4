/* Public functions of spectra and of image files. */
#include "analysis/spectrum.h"

#include <stdlib.h>

#include "api/arguments.h"

CS_HAND_OVER(spectrum)

clshear_status clshear_spectrum_measure(clshear_context *context, const clshear_points *points,
                                        size_t width, size_t height, clshear_spectrum **spectrum)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(context);
    CS_NEEDS(points);
    CS_NEEDS(spectrum);
    clshear_spectrum made = {0};
    const clshear_status status = cs_spectrum_measure(context, points, width, height, &made);
    return cs_message_keep(&context->message, hand_over(status, &made, spectrum));
}

/* The spectrum of width x height values by one of the transforms below. */
static clshear_status
of_values(clshear_status (*transform)(const float *values, size_t width, size_t height,
                                      clshear_spectrum *spectrum),
          const float *values, size_t width, size_t height, clshear_spectrum **spectrum)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(values);
    CS_NEEDS(spectrum);
    clshear_spectrum made = {0};
    return hand_over(transform(values, width, height, &made), &made, spectrum);
}

clshear_status clshear_spectrum_of_grid(const float *values, size_t width, size_t height,
                                        clshear_spectrum **spectrum)
{
    return of_values(cs_spectrum_of_grid, values, width, height, spectrum);
}

clshear_status clshear_spectrum_of_slice(const float *values, size_t width, size_t height,
                                         clshear_spectrum **spectrum)
{
    return of_values(cs_spectrum_of_slice, values, width, height, spectrum);
}

CS_FREES(spectrum)

CS_GETTER(const float *, spectrum, power)
CS_GETTER(size_t, spectrum, width)
CS_GETTER(size_t, spectrum, height)

size_t clshear_spectrum_radius(const clshear_spectrum *spectrum)
{
    return spectrum != NULL ? cs_spectrum_radius(spectrum) : 0;
}

void clshear_spectrum_radial(const clshear_spectrum *spectrum, float *mean, float *anisotropy_db)
{
    if (spectrum != NULL && mean != NULL) cs_spectrum_radial(spectrum, mean, anisotropy_db);
}

void clshear_spectrum_along(const clshear_spectrum *spectrum, double x, double y, float *power)
{
    if (spectrum != NULL && power != NULL) cs_spectrum_along(spectrum, x, y, power);
}

clshear_status clshear_spectrum_write(const clshear_spectrum *spectrum, int keep_dc,
                                      const char *path)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(spectrum);
    CS_NEEDS_NAME(path);
    return cs_spectrum_write(spectrum, keep_dc, path);
}

clshear_status clshear_image_write(const char *path, int width, int height, size_t channels,
                                   const char *const *names, const float *const *planes)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS_NAME(path);
    CS_NEEDS(names);
    CS_NEEDS(planes);
    for (size_t i = 0; i < channels; i++) {
        CS_NEEDS(names[i]);
        CS_NEEDS(planes[i]);
    }
    return cs_planes_write(path, width, height, channels, names, planes);
}
