#include "render/checkpoint.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/output_file.h"
#include "clshear/device/hash.h"
#include "render/recipe.h"

static const char magic[16] = "clshear state 1";

/* A checkpoint being written or read: the same calls in the same order do both. */
typedef struct tape {
    FILE *stream;
    int writes;
    int is_good;
    int reason;   /* errno where it is not */
    uint64_t sum; /* of all bytes so far */
} tape;

static void add_to_sum(tape *tape, const void *data, size_t size)
{
    tape->sum = cs_checksum_add(tape->sum, data, size);
}

static tape tape_of(FILE *stream, int writes)
{
    return (tape){stream, writes, 1, 0, CS_CHECKSUM_OF_NOTHING};
}

static void move(tape *tape, void *data, size_t size)
{
    if (!tape->is_good || size == 0) return;
    errno = 0;
    tape->is_good = (tape->writes ? fwrite(data, 1, size, tape->stream)
                                  : fread(data, 1, size, tape->stream)) == size;
    if (!tape->is_good) tape->reason = errno != 0 ? errno : EIO;
    add_to_sum(tape, data, size);
}

/* The state of a render, without its pixels. */
typedef struct state {
    cs_place place;
    cs_stop stop;
    double elapsed_s; /* since the render began */
    double pass_s;    /* of that, since the samples that count */
    double done;      /* samples */
    double kernel_s;
    uint64_t pixel_count;
    uint64_t planes;
    cs_u32 from;
    cs_u32 to;
    cs_u32 replicate;
    cs_u32 has_open;
    cs_u32 replicates_begun;
    cs_u32 patterns_kept;
    cs_u32 plan; /* fingerprint of what the prepass and the pilots have chosen */
    cs_u32 unused;
} state;

static cs_u32 fingerprint_of_plan(const cs_job *job)
{
    cs_u32 plan = 0;
    for (size_t i = 0; i < job->pixel_count; i++) {
        cs_u32 shear;
        memcpy(&shear, &job->shear_px[i], sizeof shear);
        plan = cs_key(cs_key(plan, shear), job->samples != NULL ? job->samples[i] : 0u);
    }
    return plan;
}

static state state_of(const cs_job *job, const cs_pass *pass)
{
    const double now_s = cs_now_s();
    return (state){.place = pass->place,
                   .stop = job->stop,
                   .elapsed_s = now_s - job->start_s,
                   .pass_s = now_s - pass->start_s,
                   .done = pass->done,
                   .kernel_s = job->kernel_s + pass->kernel_s,
                   .pixel_count = job->pixel_count,
                   .planes = job->pixels.planes,
                   .from = job->rounds.from,
                   .to = job->rounds.to,
                   .replicate = job->rounds.replicate,
                   .has_open = job->rounds.open != NULL,
                   .replicates_begun = job->replicates_begun,
                   .patterns_kept = job->patterns_kept,
                   .plan = fingerprint_of_plan(job)};
}

static int is_duration(double seconds)
{
    return seconds >= 0.0 && isfinite(seconds);
}

/* Whether what was read of the rules can be theirs. */
static int stop_fits(const cs_stop *stop)
{
    return (unsigned)stop->reason <= (unsigned)CS_STOP_TIME && stop->noise >= 0.0 &&
           stop->pixels >= 0.0 && stop->time_s >= 0.0 && stop->last.samples >= 0.0 &&
           stop->before.samples >= 0.0;
}

/* Whether a state that was read can be one of the job. */
static int fits(const cs_job *job, const state *read)
{
    const cs_u32 most =
        job->pattern.grid.count > job->replicates ? job->pattern.grid.count : job->replicates;
    const cs_u32 most_kept = job->pattern_means != NULL ? job->replicates : 0u;
    return read->pixel_count == job->pixel_count && read->planes == job->pixels.planes &&
           read->from <= read->to && read->to <= most && read->replicate <= job->replicates &&
           read->replicates_begun <= job->replicates && read->patterns_kept <= most_kept &&
           read->place.part >= 0.0 && read->place.next <= 1.0 && stop_fits(&read->stop) &&
           is_duration(read->elapsed_s) && is_duration(read->pass_s) &&
           is_duration(read->kernel_s) && read->done >= 0.0;
}

static void apply(const state *read, cs_job *job, cs_pass *pass)
{
    const double now_s = cs_now_s();
    pass->place = read->place;
    pass->start_s = now_s - read->pass_s;
    pass->done = read->done;
    job->kernel_s = read->kernel_s;
    job->stop = read->stop;
    job->start_s = now_s - read->elapsed_s;
    job->rounds.from = read->from;
    job->rounds.to = read->to;
    job->rounds.replicate = read->replicate;
    job->replicates_begun = read->replicates_begun;
    job->patterns_kept = read->patterns_kept;
}

/* Pixels of the device, from or to the tape. */
static clshear_status move_pixels(cs_job *job, tape *tape, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t planes = job->pixels.planes;
    cs_pixel *slice = malloc(CS_AOV_PIXEL_SLICE * sizeof *slice);
    cs_exact_sum *sums = malloc((CS_AOV_PIXEL_SLICE * planes + 1) * sizeof *sums);
    CS_REQUIRE(slice != NULL && sums != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t first = 0; tape->is_good && first < job->pixel_count; first += CS_AOV_PIXEL_SLICE) {
        const size_t left = job->pixel_count - first,
                     count = left < CS_AOV_PIXEL_SLICE ? left : CS_AOV_PIXEL_SLICE;
        if (tape->writes) CS_TRY(cs_pixels_read(&job->pixels, first, count, slice, error));
        if (tape->writes && planes > 0)
            CS_TRY(cs_pixels_read_aovs(&job->pixels, first, count, sums, error));
        move(tape, slice, count * sizeof *slice);
        move(tape, sums, count * planes * sizeof *sums);
        if (tape->writes || !tape->is_good) continue;
        CS_TRY(cs_pixels_write(&job->pixels, first, count, slice, error));
        if (planes > 0) CS_TRY(cs_pixels_write_aovs(&job->pixels, first, count, sums, error));
    }
done:
    free(sums);
    free(slice);
    return status;
}

/* What the host has of the pixels, and those of the device. */
static clshear_status move_all(cs_job *job, tape *tape, cs_error *error)
{
    const size_t pixels = job->pixel_count, replicates = job->replicates;
    if (job->rounds.open != NULL)
        move(tape, job->rounds.open, replicates * pixels * sizeof *job->rounds.open);
    if (job->pattern_means != NULL) {
        move(tape, job->pattern_means, 3 * replicates * pixels * sizeof *job->pattern_means);
        move(tape, job->pattern_sums, 3 * pixels * sizeof *job->pattern_sums);
    }
    return move_pixels(job, tape, error);
}

static clshear_status write_all(cs_job *job, const cs_pass *pass, tape *tape, cs_error *error)
{
    char first[sizeof magic], recipe[CS_RECIPE_SIZE] = "";
    state now = state_of(job, pass);
    memcpy(first, magic, sizeof magic);
    cs_recipe_of_state(job, recipe, sizeof recipe);
    move(tape, first, sizeof first);
    move(tape, recipe, sizeof recipe);
    move(tape, &now, sizeof now);
    const clshear_status status = move_all(job, tape, error);
    uint64_t sum = tape->sum;
    move(tape, &sum, sizeof sum);
    return status;
}

clshear_status cs_checkpoint_save(cs_job *job, cs_pass *pass, int at_once, cs_error *error)
{
    const char *path = cs_text(&job->settings, CHECKPOINT);
    const double now_s = cs_now_s();
    cs_output_file file = {0};
    if (path == NULL) return CLSHEAR_OK;
    if (!at_once && now_s - job->saved_s < cs_number(&job->settings, EVERY)) return CLSHEAR_OK;
    int reason = cs_output_open(path, &file);
    clshear_status status = CLSHEAR_OK;
    if (reason == 0) {
        tape tape = tape_of(file.stream, 1);
        file.is_durable = 1;
        status = write_all(job, pass, &tape, error);
        reason = cs_output_end(&file, tape.is_good && status == CLSHEAR_OK);
        if (!tape.is_good) reason = tape.reason;
    }
    if (reason != 0 && !job->save_fails) /* warns at the first of several failures only */
        cs_alarm(&job->scene->context->log,
                 "checkpoint %s: cannot be written: %s; the render goes on", path,
                 strerror(reason));
    job->save_fails = reason != 0;
    job->saved_s = cs_now_s();
    return status;
}

static clshear_status damaged(const char *path, cs_error *error)
{
    return cs_fail(error, CLSHEAR_BAD_FILE,
                   "%s: is no whole checkpoint of this version; remove it to begin anew", path);
}

/* Whether the last bytes of a file are the checksum of those before. */
static int has_its_checksum(FILE *stream)
{
    char block[4096];
    uint64_t sum = 0;
    tape tape = tape_of(stream, 0);
    if (fseek(stream, 0, SEEK_END) != 0) return 0;
    long left = ftell(stream) - (long)sizeof sum;
    rewind(stream);
    for (; left > 0 && tape.is_good; left -= (long)sizeof block)
        move(&tape, block, left < (long)sizeof block ? (size_t)left : sizeof block);
    return tape.is_good && fread(&sum, 1, sizeof sum, stream) == sizeof sum && sum == tape.sum;
}

/* Whether a file is a whole checkpoint of the job. */
static clshear_status check_file(const cs_job *job, const char *path, FILE *stream, cs_error *error)
{
    char first[sizeof magic], theirs[CS_RECIPE_SIZE], mine[CS_RECIPE_SIZE] = "";
    char name[64];
    tape tape = tape_of(stream, 0);
    move(&tape, first, sizeof first);
    move(&tape, theirs, sizeof theirs);
    if (!tape.is_good || memcmp(first, magic, sizeof magic) != 0 ||
        memchr(theirs, '\0', sizeof theirs) == NULL)
        return damaged(path, error);
    cs_recipe_of_state(job, mine, sizeof mine);
    if (cs_recipe_difference(theirs, mine, name, sizeof name))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s: was written with another %s; give all flags as before", path, name);
    return has_its_checksum(stream) ? CLSHEAR_OK : damaged(path, error);
}

clshear_status cs_checkpoint_check(cs_job *job, cs_error *error)
{
    const char *path = cs_text(&job->settings, CHECKPOINT);
    const int resumes = cs_integer(&job->settings, RESUME) != 0;
    job->saved_s = cs_now_s();
    if (path == NULL && resumes)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "resume: needs a checkpoint to go on from");
    if (path == NULL) return CLSHEAR_OK;
    FILE *stream = fopen(path, "rb");
    if (stream == NULL && errno != ENOENT)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    if (stream == NULL && resumes)
        cs_warn(&job->scene->context->log, "%s: is not there yet; the render begins", path);
    if (stream == NULL) return CLSHEAR_OK;
    clshear_status status =
        resumes ? check_file(job, path, stream, error)
                : cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                          "%s: is there already; go on from it with resume, or remove it", path);
    fclose(stream);
    job->resumes = status == CLSHEAR_OK;
    return status;
}

clshear_status cs_checkpoint_load(cs_job *job, cs_pass *pass, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const char *path = cs_text(&job->settings, CHECKPOINT);
    state read;
    if (!job->resumes) return CLSHEAR_OK;
    FILE *stream = fopen(path, "rb");
    CS_REQUIRE(stream != NULL, CLSHEAR_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    tape tape = tape_of(stream, 0);
    CS_REQUIRE(fseek(stream, sizeof magic + CS_RECIPE_SIZE, SEEK_SET) == 0, CLSHEAR_BAD_FILE,
               "%s: cannot be read: %s", path, strerror(errno));
    move(&tape, &read, sizeof read);
    if (!tape.is_good || !fits(job, &read)) CS_TRY(damaged(path, error));
    CS_REQUIRE(read.plan == fingerprint_of_plan(job), CLSHEAR_BAD_FILE,
               "%s: this machine finds other depths, or its pilot other shears; go on with the "
               "machine that began",
               path);
    if (read.has_open) {
        job->rounds.open = calloc(job->replicates * job->pixel_count, sizeof(cs_open_pattern));
        CS_REQUIRE(job->rounds.open != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    }
    CS_TRY(move_all(job, &tape, error));
    if (!tape.is_good) CS_TRY(damaged(path, error));
    apply(&read, job, pass);
done:
    if (stream != NULL) fclose(stream);
    return status;
}
