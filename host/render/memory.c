#include "render/memory.h"

#include <unistd.h>

#include "base/resident.h"
#include "render/aov.h"
#include "render/pilot.h"
#include "render/resume.h"
#include "render/rounds.h"

/* The part of a memory that a render may fill. */
static const double safe_part = 0.8;

/* Bytes of a pixel that are held during the whole render. */
static cs_footprint reserved_bytes(const cs_job *job)
{
    cs_footprint bytes = {
        .host = sizeof *job->depth + sizeof *job->shear_px + sizeof *job->rule,
        .device = (double)cs_pixel_bytes(cs_aov_count(job->planes)),
    };
    if (job->moves) bytes.host += sizeof *job->velocities_px;
    if (cs_integer(&job->settings, GAIN) != 0) bytes.host += sizeof *job->gain;
    bytes.host += (double)cs_resume_bytes(job);
    return bytes;
}

/* Bytes of a pixel that are held besides, once the samples are planned. */
static cs_footprint planned_bytes(const cs_job *job)
{
    cs_footprint bytes = {.device = sizeof *job->shear_px};
    if (job->moves) bytes.device += sizeof *job->velocities_px;
    if (cs_pilot_chooses_samples(job)) bytes.host += sizeof *job->samples;
    if (cs_adaptive_shares(job)) bytes.host += (double)cs_adaptive_bytes(job);
    bytes.host += (double)cs_rounds_bytes(job);
    return bytes;
}

/* Raises the peaks to `bytes`, which are held at one time. */
static void hold(cs_memory *memory, cs_footprint bytes)
{
    if (bytes.host > memory->host) memory->host = bytes.host;
    if (bytes.device > memory->device) memory->device = bytes.device;
    if (cs_footprint_total(bytes) > memory->both) memory->both = cs_footprint_total(bytes);
}

/* Takes in the memory of a picture whose pixels hold `first` and, the first `part` of them, also
 * `second`. */
static void hold_pixels(cs_memory *memory, const cs_job *job, cs_footprint first,
                        cs_footprint second, double part)
{
    const double pixels = (double)job->pixel_count;
    const double slice = CS_PIXEL_SLICE * (double)cs_pixel_bytes(0);
    const double table = (double)(job->optics.table.count * job->optics.table.item_size);
    const cs_footprint wide = {.device = cs_wide_scene_expected(job->scene, job->features)};
    const cs_footprint all = {.host = table + slice + pixels * (first.host + part * second.host),
                              .device = table + pixels * (first.device + part * second.device)};
    hold(memory, cs_footprint_sum(all, wide));
}

/* Resolving gives the pixels back page by page while it fills the film, unless the film is a
 * preview. */
static void hold_film(cs_memory *memory, const cs_job *job, cs_footprint kept)
{
    const cs_preview *preview = &job->settings.preview;
    const int is_shown = preview->wanted != NULL || cs_text(&job->settings, PREVIEW) != NULL ||
                         cs_text(&job->settings, DISPLAY) != NULL;
    const double page =
        (double)cs_page_pixels(job->scene->context, (cs_u32)(job->window[1] - job->window[0]));
    const double part = page / (double)job->pixel_count;
    const cs_footprint film = {.host = (double)cs_film_bytes(job)};
    const cs_footprint given_back = {.device = -(double)cs_pixel_bytes(0)};
    hold_pixels(memory, job, kept, film, is_shown || part > 1.0 ? 1.0 : part);
    hold_pixels(memory, job, cs_footprint_sum(kept, film), given_back, 1.0);
}

cs_memory cs_memory_of(const cs_job *job)
{
    const cs_footprint reserved = reserved_bytes(job), nothing = {0};
    const cs_footprint planned = cs_footprint_sum(reserved, planned_bytes(job));
    const cs_footprint order = {.device = sizeof(cs_u32)};
    cs_footprint drawn = cs_footprint_sum(planned, order);
    cs_memory memory = {0};
    hold(&memory, cs_wide_scene_making(job->scene, job->features));
    hold_pixels(&memory, job, reserved, cs_pilot_bytes(job), 1.0);
    hold_pixels(&memory, job, drawn, (cs_footprint){.host = (double)cs_rounds_look_bytes(job)},
                1.0);
    if (cs_adaptive_shares(job)) {
        const cs_footprint begin = {.host = (double)cs_adaptive_begin_bytes()};
        hold_pixels(&memory, job, planned, begin, 1.0);
        for (int k = 1; k < CS_BEGINNINGS; k++) /* batches of all replicates stay */
            drawn = cs_footprint_sum(drawn, order);
    }
    hold_pixels(&memory, job, drawn, nothing, 1.0);
    hold_film(&memory, job, drawn);
    return memory;
}

/* Warns of `bytes` for the picture, besides what there is already, in a memory of so many. */
static void check(const cs_job *job, const char *whose, double bytes, double held, double most)
{
    if (bytes + held <= safe_part * most || !(most > 0.0)) return;
    cs_warn(&job->scene->context->log,
            "%zu pixels take %.1f GB besides the %.1f GB of scene and program, of the %s's %.1f GB "
            "of memory; --crop renders parts",
            job->pixel_count, 1e-9 * bytes, 1e-9 * held, whose, 1e-9 * most);
}

void cs_memory_check(const cs_job *job)
{
    const cs_device *device = job->scene->context->device;
    const int is_shared = cs_device_shares_memory(device);
    const cs_memory memory = cs_memory_of(job);
    check(job, "machine", is_shared ? memory.both : memory.host, (double)cs_resident_bytes(),
          (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE));
    if (!is_shared)
        check(job, "device", memory.device, (double)cs_device_held(device),
              (double)cs_device_memory(device));
}
