#include "render/render.h"

#include "render/capsule.h"
#include "render/checkpoint.h"
#include "render/live.h"
#include "render/resume.h"
#include "render/rounds.h"

clshear_status cs_render(clshear_scene *scene, const clshear_settings *settings,
                         const clshear_film *base, clshear_film **result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK, passes = CLSHEAR_OK;
    const double start_s = cs_now_s();
    cs_job job = {.start_s = start_s};
    clshear_film *film = NULL;
    cs_recorder *recorder = NULL;
    CS_TRY(cs_job_begin(&job, scene, settings, base, error));
    cs_read_settings_compare(&scene->read_settings, &job.settings, &scene->context->log);
    CS_TRY(cs_job_choose_samples(&job, error));
    CS_TRY(cs_resume_check(&job, error));
    CS_TRY(cs_rounds_check(&job, error));
    CS_TRY(cs_checkpoint_check(&job, error));
    CS_TRY(cs_live_begin(&job, error));
    passes = cs_job_plan(&job, error);
    if (passes == CLSHEAR_OK) passes = cs_capsule_begin(&job, &recorder, error);
    if (passes == CLSHEAR_OK) passes = cs_job_run_passes(&job, error);
    if (passes != CS_CANCELLED) CS_TRY(passes);
    CS_TRY(cs_capsule_end(&job, &recorder, error));
    job.is_over = 1;
    CS_TRY(cs_job_resolve(&job, &film, error));
    film->info.complete = passes == CLSHEAR_OK;
    film->info.render_s = cs_now_s() - start_s;
    CS_TRY(cs_film_set_float(film, "renderTimeSeconds", (float)film->info.render_s));
    if (!film->info.complete) CS_TRY(cs_film_set_int(film, "clshear.interrupted", 1));
    cs_live_end(&job, film);
    *result = film;
    film = NULL;
done:
    cs_recorder_close(recorder, 0, 0.0, error);
    cs_film_free(film);
    cs_job_free(&job);
    return status;
}
