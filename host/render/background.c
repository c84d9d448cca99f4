#include "render/background.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/certain.h"

/* A surface between the rays of two pixels is seen by neither. */
static const cs_f32 margin_px = 1.5f;

/* How far what pixel `i` has hit is seen, px, as cs_mark_certain takes it. */
static cs_f32 reach_of(const cs_job *job, size_t i)
{
    const cs_depth *depth = &job->depth[i];
    const cs_optics *optics = &job->camera.optics;
    if (!isfinite(depth->centre) && !isfinite(depth->near)) return -1.0f;
    const cs_f32 blur = fmaxf(
        fabsf(cs_job_shear(job, i, CS_RULE_CENTRE)),
        fmaxf(fabsf(cs_job_shear(job, i, CS_RULE_NEAR)), fabsf(cs_job_shear(job, i, CS_RULE_FAR))));
    const cs_f32 half = fmaxf(optics->half_width[0] * optics->squeeze, optics->half_width[1]);
    cs_f32 reach = half * blur + 0.5f * optics->filter_width + margin_px;
    if (job->velocities_px != NULL)
        reach += fabsf(job->velocities_px[i].x) + fabsf(job->velocities_px[i].y);
    return reach;
}

clshear_status cs_background_find(const cs_job *job, uint8_t *certain, cs_error *error)
{
    const int width = job->window[1] - job->window[0], height = job->window[3] - job->window[2];
    memset(certain, 0, job->pixel_count);
    if (job->lighting.environment != NULL) return CLSHEAR_OK; /* an image */
    cs_f32 *reach_px = malloc(job->pixel_count * sizeof *reach_px);
    if (reach_px == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
                       job->pixel_count);
    for (size_t i = 0; i < job->pixel_count; i++)
        reach_px[i] = reach_of(job, i);
    const clshear_status status = cs_mark_certain(reach_px, width, height, certain, error);
    free(reach_px);
    return status;
}
