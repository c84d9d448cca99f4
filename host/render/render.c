/* clshear_render: options -> camera -> plan -> passes -> film. */
#include "render/render_job.h"

#include "render/resume.h"

clshear_options clshear_options_defaults(void)
{
    return (clshear_options){.width = 512,
                             .height = 512,
                             .spp = 256,
                             .shear = CLSHEAR_SHEAR_EQUAL_AREA,
                             .oracle = CLSHEAR_ORACLE_PILOT,
                             .lens_rays = 16};
}

clshear_status clshear_render(clshear_scene *scene, const clshear_camera *camera,
                              const clshear_options *options, clshear_film **result)
{
    clshear_status status = CLSHEAR_OK, passes = CLSHEAR_OK;
    cs_error *error = &scene->context->error;
    const double start_s = cs_now_s();
    cs_job job = {.scene = scene, .options = *options, .lens = *camera};
    clshear_film *film = NULL;
    CS_TRY(cs_job_check(&job, error));
    CS_TRY(cs_resume_check(&job, error));
    passes = cs_job_plan(&job, error);
    if (passes == CLSHEAR_OK) passes = cs_job_run_passes(&job, error);
    if (passes != CLSHEAR_CANCELLED) CS_TRY(passes);
    CS_TRY(cs_job_resolve(&job, &film, error));
    film->info.render_s = cs_now_s() - start_s;
    CS_TRY(cs_film_set_float(film, "renderTimeSeconds", (float)film->info.render_s));
    if (passes == CLSHEAR_CANCELLED) CS_TRY(cs_film_set_int(film, "clshear.interrupted", 1));
    *result = film;
    film = NULL;
    status = passes;
done:
    clshear_film_free(film);
    cs_job_free(&job);
    return status;
}
