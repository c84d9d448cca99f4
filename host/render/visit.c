#include "render/visit.h"

#include <stdlib.h>

#include "render/render_job.h"

clshear_status cs_visit_pixels(cs_job *job, const cs_visit *visit, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_pixel *slice = malloc(CS_PIXEL_SLICE * sizeof *slice);
    CS_REQUIRE(slice != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t first = 0; first < job->pixel_count; first += CS_PIXEL_SLICE) {
        const size_t left = job->pixel_count - first,
                     count = left < CS_PIXEL_SLICE ? left : CS_PIXEL_SLICE;
        CS_TRY(cs_pixels_read(&job->pixels, first, count, slice, error));
        for (size_t i = 0; i < count; i++)
            visit->apply(job, visit->user, first + i, &slice[i]);
        if (visit->changes) CS_TRY(cs_pixels_write(&job->pixels, first, count, slice, error));
    }
done:
    free(slice);
    return status;
}
