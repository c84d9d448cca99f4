/* Launches: which pixels and which blocks of their patterns, when. */
#include "render/extend.h"

static const double launch_s = 0.15; /* aim for one launch */

/* How far a render is. */
typedef struct cs_clockwork {
    double start_s;
    double rate;  /* samples per second of the last launches */
    double done;  /* samples */
    double total; /* samples */
} cs_clockwork;

static clshear_status launch(cs_job *job, const cs_frame *frame, cs_error *error)
{
    enum {
        BEFORE_WORLD = 4
    };
    cs_argument arguments[BEFORE_WORLD + CS_WORLD_BUFFERS] = {
        {.value = frame, .size = sizeof *frame},
        {.buffer = job->pixels},
        {.buffer = job->shears},
        {.buffer = job->rows}};
    for (int i = 0; i < CS_WORLD_BUFFERS; i++)
        arguments[BEFORE_WORLD + i].buffer = job->scene->world.buffers[i];
    return cs_device_run(job->scene->context->device, CS_KERNEL_RENDER, frame->pixel_count,
                         arguments, BEFORE_WORLD + CS_WORLD_BUFFERS, error);
}

/* Times the launch, and asks the caller whether to go on. */
static clshear_status timed_launch(cs_job *job, const cs_frame *frame, cs_clockwork *clockwork,
                                   cs_error *error)
{
    const double before_s = cs_now_s();
    clshear_status status = launch(job, frame, error);
    if (status != CLSHEAR_OK) return status;
    const double now_s = cs_now_s(), took_s = now_s - before_s + 1e-6;
    uint32_t last = frame->last_block * CS_BLOCK;
    if (last > frame->pattern.grid.count) last = frame->pattern.grid.count;
    const double samples =
        (double)(last - frame->first_block * CS_BLOCK) * (double)frame->pixel_count;
    job->kernel_s += took_s;
    clockwork->done += samples;
    clockwork->rate = 0.5 * (clockwork->rate + samples / took_s);
    if (job->options.progress == NULL) return CLSHEAR_OK;
    const double mean_rate = clockwork->done / (now_s - clockwork->start_s);
    clshear_progress progress = {
        .fraction = clockwork->done / clockwork->total,
        .samples_per_s = mean_rate,
        .remaining_s = (clockwork->total - clockwork->done) / mean_rate,
    };
    if (job->options.progress(job->options.progress_user, &progress) != 0)
        return cs_fail(error, CLSHEAR_CANCELLED, "cancelled");
    return CLSHEAR_OK;
}

/* Draws blocks [first_block, last_block) of every pixel's pattern, some pixels at a time. */
static clshear_status sweep_pixels(cs_job *job, cs_frame *frame, cs_clockwork *clockwork,
                                   cs_error *error)
{
    const size_t least = 64;
    size_t pixel = 0;
    while (pixel < job->pixel_count) {
        double samples_each = (double)(frame->last_block - frame->first_block) * CS_BLOCK;
        double affordable = clockwork->rate * launch_s / samples_each;
        size_t left = job->pixel_count - pixel;
        size_t count = affordable >= (double)left   ? left
                       : affordable < (double)least ? least
                                                    : (size_t)affordable;
        if (count > left) count = left;
        frame->first_pixel = (uint32_t)pixel;
        frame->pixel_count = (uint32_t)count;
        clshear_status status = timed_launch(job, frame, clockwork, error);
        if (status != CLSHEAR_OK) return status;
        pixel += count;
    }
    return CLSHEAR_OK;
}

/* Blocks to draw of each pixel before the next pixel's turn: as few as possible, since an
 * interrupted picture should be even, but more where the image alone does not fill a launch. */
static uint32_t blocks_of_sweep(const cs_job *job, const cs_clockwork *clockwork, uint32_t left)
{
    const double flushes =
        clockwork->rate * launch_s / ((double)job->pixel_count * CS_FLUSH_BLOCKS * CS_BLOCK);
    double blocks = flushes < 1.0 ? CS_FLUSH_BLOCKS : (double)(uint32_t)flushes * CS_FLUSH_BLOCKS;
    return blocks < (double)left ? (uint32_t)blocks : left;
}

clshear_status cs_job_run_passes(cs_job *job, cs_error *error)
{
    const cs_device_world *world = &job->scene->world;
    const uint32_t patterns = job->options.replicates;
    cs_clockwork clockwork = {.start_s = cs_now_s(), .rate = 1e5};
    clockwork.total = (double)job->pixel_count * job->pattern.grid.count * patterns;
    cs_frame frame = {
        .camera = job->camera,
        .pattern = job->pattern,
        .seed = job->options.seed,
        .image_width = (uint32_t)job->options.width,
        .crop_x = (uint32_t)job->window[0],
        .crop_y = (uint32_t)job->window[2],
        .crop_width = (uint32_t)(job->window[1] - job->window[0]),
        .crop_height = (uint32_t)(job->window[3] - job->window[2]),
        .shear_mode = (uint32_t)job->options.shear,
        .lights = world->lights,
        .emitters = world->emitters,
    };
    for (frame.replicate = 0; frame.replicate < patterns; frame.replicate++) {
        clshear_status begun = cs_extend_begin(job, frame.replicate, error);
        if (begun != CLSHEAR_OK) return begun;
        for (uint32_t block = 0; block < job->pattern.blocks; block = frame.last_block) {
            frame.first_block = block;
            frame.last_block =
                block + blocks_of_sweep(job, &clockwork, job->pattern.blocks - block);
            clshear_status status = sweep_pixels(job, &frame, &clockwork, error);
            if (status != CLSHEAR_OK) return status;
        }
        clshear_status ended = cs_extend_end(job, frame.replicate, error);
        if (ended != CLSHEAR_OK) return ended;
    }
    return CLSHEAR_OK;
}
