#include "render/pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double launch_s = 0.15; /* aim for one launch */

clshear_status cs_batch_set_pattern(clshear_context *context, const cs_pattern *pattern,
                                    cs_batch *batch, cs_error *error)
{
    cs_buffer *rows = NULL;
    const clshear_status status =
        cs_table_cache_find(&context->tables, context->device, pattern, &rows, error);
    if (status != CLSHEAR_OK) return status;
    cs_buffer_free(batch->rows);
    batch->rows = rows;
    batch->pattern = *pattern;
    return CLSHEAR_OK;
}

clshear_status cs_batch_create(clshear_context *context, const cs_pattern *pattern,
                               const cs_u32 *pixels, size_t count, cs_u32 width, int compact,
                               cs_batch *batch, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = context->device;
    const size_t page_pixels = cs_page_pixels(context, width);
    cs_u32 *order = NULL;
    batch->pixel_count = count;
    batch->compact = compact;
    CS_TRY(cs_batch_set_pattern(context, pattern, batch, error));
    if (pixels == NULL) {
        order = malloc(count * sizeof *order);
        CS_REQUIRE(order != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", count);
        for (size_t i = 0; i < count; i++)
            order[i] = cs_tiled_pixel((cs_u32)i, width, (cs_u32)(count / width));
        pixels = order;
    }
    batch->page_ends = calloc((compact ? count - 1 : pixels[count - 1]) / page_pixels + 1,
                              sizeof *batch->page_ends);
    CS_REQUIRE(batch->page_ends != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t i = 0; i < count; i++)
        batch->page_ends[(compact ? i : pixels[i]) / page_pixels] = i + 1;
    CS_TRY(cs_buffer_create(device, count * sizeof *pixels, pixels, &batch->order, error));
done:
    free(order);
    return status;
}

void cs_batch_free(cs_batch *batch)
{
    cs_buffer_free(batch->order);
    cs_buffer_free(batch->rows);
    free(batch->page_ends);
    *batch = (cs_batch){0};
}

clshear_status cs_pass_warm_up(cs_device *device, cs_u32 features, cs_error *error)
{
    const cs_launch launch = {.pixel_count = 0};
    const cs_argument arguments[CS_ARGUMENTS_RENDER] = {
        {.value = &launch, .size = sizeof launch}}; /* and no buffers */
    return CS_RUN_WITH(device, RENDER, features, 1, arguments, error);
}

static clshear_status run_kernel(const cs_pass *pass, const cs_batch *batch,
                                 const cs_launch *launch, cs_error *error)
{
    const cs_buffer *buffers[CS_SCENE_BUFFERS];
    cs_lit_buffers(pass->scene, pass->lighting, buffers);
    const cs_pixels *pixels = pass->pixels;
    const size_t page = launch->page_first / pixels->page_pixels;
    const cs_argument arguments[] = {{.value = launch, .size = sizeof *launch},
                                     {.buffer = pixels->pages[page]},
                                     {.buffer = pixels->aovs != NULL ? pixels->aovs[page] : NULL},
                                     {.buffer = batch->order},
                                     {.buffer = pass->shears},
                                     {.buffer = pass->velocities},
                                     {.buffer = batch->rows},
                                     {.buffer = pass->optics},
                                     CS_SCENE_BUFFER_LIST(CS_SCENE_ARGUMENT)};
    return CS_RUN_WITH(pass->scene->context->device, RENDER, pass->features,
                       (launch->pixel_count + launch->pixels_each - 1) / launch->pixels_each,
                       arguments, error);
}

static clshear_status tell(const clshear_settings *settings, const clshear_progress *progress,
                           cs_error *error)
{
    if (settings == NULL || settings->progress == NULL) return CLSHEAR_OK;
    if (settings->progress(settings->progress_user, progress) != 0)
        return cs_fail(error, CS_CANCELLED, "stopped by the progress callback");
    return CLSHEAR_OK;
}

clshear_status cs_pass_ask(const clshear_settings *settings, cs_error *error)
{
    const clshear_progress nothing = {.struct_size = sizeof nothing};
    return tell(settings, &nothing, error);
}

/* Tells the caller how far it is, and asks whether to go on. */
static clshear_status report(const cs_pass *pass, double now_s, cs_error *error)
{
    const double mean_rate = pass->done / (now_s - pass->start_s);
    const double part = pass->total > 0.0 ? pass->done / pass->total : 0.0;
    const clshear_progress progress = {
        .struct_size = sizeof progress,
        .fraction = part < 1.0 ? part : 1.0,
        .samples_per_s = mean_rate,
        .remaining_s = pass->total > pass->done && !pass->is_open
                           ? (pass->total - pass->done) / mean_rate
                           : 0.0,
        .noise = pass->noise,
        .noise_pixel = pass->noise_pixel,
    };
    return tell(pass->settings, &progress, error);
}

static clshear_status timed_launch(cs_pass *pass, const cs_batch *batch, const cs_launch *launch,
                                   cs_error *error)
{
    const double before_s = cs_now_s();
    clshear_status status = run_kernel(pass, batch, launch, error);
    if (status != CLSHEAR_OK) return status;
    const double now_s = cs_now_s(), took_s = now_s - before_s + 1e-6;
    uint32_t last = launch->last_block * CS_BLOCK;
    if (last > launch->pattern.grid.count) last = launch->pattern.grid.count;
    const double samples =
        (double)(last - launch->first_block * CS_BLOCK) * (double)launch->pixel_count;
    pass->kernel_s += took_s;
    pass->done += samples;
    pass->rate = 0.5 * (pass->rate + samples / took_s);
    pass->place.pixel += launch->pixel_count;
    if (pass->between != NULL) status = pass->between(pass->user, error);
    return status == CLSHEAR_OK ? report(pass, now_s, error) : status;
}

/* Draws blocks [first, last) of the patterns of a batch from the place's pixel on, some pixels at a
 * time. */
static clshear_status pass_batch(cs_pass *pass, const cs_batch *batch, cs_u32 first, cs_u32 last,
                                 cs_error *error)
{
    cs_launch launch = pass->launch;
    launch.pattern = batch->pattern;
    launch.first_block = first;
    launch.last_block = last;
    launch.compact = (cs_u32)batch->compact;
    const int pools =
        (pass->features & CS_FEATURE_PATHS) != 0 && cs_pads_lanes(batch->pattern.sampler);
    launch.pixels_each = cs_pixels_together(
        last - first, (cs_u32)cs_device_packet(pass->scene->context->device), pools);
    const size_t least = (size_t)64 * launch.pixels_each;
    size_t page = 0;
    while (pass->place.pixel < batch->pixel_count) {
        const size_t pixel = pass->place.pixel;
        while (batch->page_ends[page] <= pixel) /* 0 for pages without pixels of the batch */
            page++;
        const double samples_each = (double)(last - first) * CS_BLOCK;
        const double affordable = pass->rate * launch_s / samples_each;
        const size_t left = batch->page_ends[page] - pixel;
        size_t count = affordable >= (double)left   ? left
                       : affordable < (double)least ? least
                                                    : (size_t)affordable;
        if (count > left) count = left;
        launch.page_first = (cs_u32)(page * pass->pixels->page_pixels);
        launch.first_pixel = (cs_u32)pixel;
        launch.pixel_count = (cs_u32)count;
        clshear_status status = timed_launch(pass, batch, &launch, error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

static cs_u32 flushes_of(const cs_batch *batch)
{
    return (batch->pattern.blocks + CS_FLUSH_BLOCKS - 1) / CS_FLUSH_BLOCKS;
}

/* Blocks of a batch that are drawn when `part` of the replicate is: whole flushes, rounded up so
 * that the first step leaves no pixel without samples. */
static cs_u32 blocks_at(const cs_batch *batch, double part)
{
    const cs_u32 blocks = (cs_u32)ceil(part * flushes_of(batch)) * CS_FLUSH_BLOCKS;
    return blocks < batch->pattern.blocks ? blocks : batch->pattern.blocks;
}

int cs_pass_is_fresh(const cs_pass *pass)
{
    return !(pass->place.next > 0.0);
}

clshear_status cs_pass_replicate(cs_pass *pass, const cs_batch *batches, size_t batch_count,
                                 cs_u32 replicate, cs_error *error)
{
    double samples = 0.0;
    cs_u32 most = 1;
    for (size_t b = 0; b < batch_count; b++) {
        samples += (double)batches[b].pixel_count * batches[b].pattern.grid.count;
        if (flushes_of(&batches[b]) > most) most = flushes_of(&batches[b]);
    }
    pass->launch.replicate = replicate;
    cs_place *at = &pass->place;
    while (at->part < 1.0) {
        /* As little as a launch affords, but a flush of the largest pattern at least. */
        const double step = pass->rate * launch_s / samples;
        if (at->next <= at->part) at->next = at->part + (step > 1.0 / most ? step : 1.0 / most);
        if (at->next > 1.0 - 0.5 / most) at->next = 1.0;
        for (; at->batch < batch_count; at->batch++, at->pixel = 0) {
            const cs_batch *batch = &batches[at->batch];
            const cs_u32 first = blocks_at(batch, at->part), last = blocks_at(batch, at->next);
            if (first == last) continue;
            clshear_status status = pass_batch(pass, batch, first, last, error);
            if (status != CLSHEAR_OK) return status;
        }
        *at = (cs_place){.part = at->next};
    }
    *at = (cs_place){0};
    return CLSHEAR_OK;
}
