#include "render/live.h"

#include <math.h>
#include <stdio.h>

#include "display/viewer.h"
#include "image/image_io.h"

/* Making the film for the viewer takes at most a twentieth of the render's time. */
static const double least_pause_s = 0.5, pause_per_cost = 20.0;

/* A viewer that takes nothing for so long, at the end of a render, is lost. */
static const double last_patience_s = 5.0;

/* The viewer's name for the picture; renders that go on at the same time differ. */
static void name_picture(const cs_job *job, char *name, size_t size)
{
    const char *shard = cs_text(&job->settings, SHARD);
    snprintf(name, size, "clshear%s%s", shard != NULL ? " shard " : "", shard != NULL ? shard : "");
}

static void lose_viewer(cs_job *job, const cs_error *reason)
{
    cs_alarm(&job->scene->context->log, "%s; the render goes on without it", reason->message);
    cs_viewer_close(job->live.viewer);
    job->live.viewer = NULL;
}

clshear_status cs_live_begin(cs_job *job, cs_error *error)
{
    const char *address = cs_text(&job->settings, DISPLAY);
    const char *file = cs_text(&job->settings, PREVIEW);
    clshear_status status = CLSHEAR_OK;
    cs_error reason;
    char name[64];
    job->live.kept_s = cs_now_s();
    if (file != NULL)
        status = cs_image_check(file, job->window[1] - job->window[0],
                                job->window[3] - job->window[2], error);
    if (status == CLSHEAR_OK && address != NULL) status = cs_viewer_check(address, error);
    if (status != CLSHEAR_OK || address == NULL) return status;
    name_picture(job, name, sizeof name);
    if (cs_viewer_open(address, name, &job->live.viewer, &reason) != CLSHEAR_OK)
        lose_viewer(job, &reason);
    return CLSHEAR_OK;
}

/* Sends what the viewer takes, and gives up one that is gone. */
static void feed_viewer(cs_job *job, double patience_s)
{
    cs_live *live = &job->live;
    cs_error reason;
    int is_sent = 0;
    if (live->viewer == NULL || live->film == NULL) return;
    if (cs_viewer_send(live->viewer, patience_s, &is_sent, &reason) != CLSHEAR_OK)
        lose_viewer(job, &reason);
    if (!is_sent && live->viewer != NULL) return;
    cs_film_free(live->film);
    live->film = NULL;
}

/* Writes the file, atomically as all pictures. */
static void keep(cs_job *job, clshear_film *film)
{
    cs_live *live = &job->live;
    const int fails = cs_film_write(film, cs_text(&job->settings, PREVIEW)) != CLSHEAR_OK;
    if (fails && !live->file_fails)
        cs_alarm(&job->scene->context->log, "preview: %s; the render goes on",
                 cs_thread_error()->message);
    live->file_fails = fails;
    live->kept_s = cs_now_s();
}

/* Whether each of those that show the picture is to have it. */
typedef struct wishes {
    int caller;
    int file;
    int viewer;
} wishes;

static wishes wishes_of(const cs_job *job)
{
    const cs_preview *preview = &job->settings.preview;
    const cs_live *live = &job->live;
    const double now_s = cs_now_s();
    return (wishes){.caller = preview->wanted != NULL && preview->show != NULL &&
                              preview->wanted(preview->user),
                    .file = cs_text(&job->settings, PREVIEW) != NULL &&
                            now_s - live->kept_s >= cs_number(&job->settings, EVERY),
                    /* One film at a time: where the viewer is slow, it gets fewer. */
                    .viewer = live->viewer != NULL && live->film == NULL &&
                              now_s - live->shown_s >=
                                  fmax(least_pause_s, pause_per_cost * live->cost_s)};
}

clshear_status cs_live_update(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_live *live = &job->live;
    clshear_film *film = NULL;
    cs_error reason;
    feed_viewer(job, 0.0);
    const wishes wanted = wishes_of(job);
    if (!wanted.caller && !wanted.file && !wanted.viewer) return CLSHEAR_OK;
    const double begun_s = cs_now_s();
    CS_TRY(cs_job_resolve(job, &film, error));
    film->info.complete = 0;
    CS_TRY(cs_film_set_int(film, "clshear.interrupted", 1));
    if (wanted.viewer) live->cost_s = cs_now_s() - begun_s;
    if (wanted.caller) job->settings.preview.show(job->settings.preview.user, film);
    if (wanted.file) keep(job, film);
    if (!wanted.viewer) goto done;
    live->shown_s = cs_now_s();
    if (cs_viewer_show(live->viewer, film, 0, &reason) != CLSHEAR_OK) {
        lose_viewer(job, &reason);
        goto done;
    }
    live->film = film;
    film = NULL;
    feed_viewer(job, 0.0);
done:
    cs_film_free(film);
    return status;
}

/* Shows the viewer the last film and waits until it has it. */
static void show_last(cs_job *job, const clshear_film *film)
{
    cs_error reason;
    int is_sent = 0;
    cs_viewer *viewer = job->live.viewer;
    if (cs_viewer_show(viewer, film, 1, &reason) != CLSHEAR_OK ||
        cs_viewer_send(viewer, last_patience_s, &is_sent, &reason) != CLSHEAR_OK)
        lose_viewer(job, &reason);
}

void cs_live_end(cs_job *job, clshear_film *film)
{
    if (cs_text(&job->settings, PREVIEW) != NULL) keep(job, film);
    if (job->live.viewer != NULL) show_last(job, film);
}

void cs_live_free(cs_job *job)
{
    cs_viewer_close(job->live.viewer);
    cs_film_free(job->live.film);
}
