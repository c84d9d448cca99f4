/* clshear merge: the shards of a render, put together. */
#include <stdio.h>
#include <stdlib.h>

#include "commands/commands.h"
#include "report/failure.h"
#include "report/output.h"

typedef struct merge_job {
    program_options options;
    text_list out;
} merge_job;

static const program_flag flags[] = {
    FILES_FLAG("out o", "write .exr, .png, .jpg or .tif; repeatable", "", offsetof(merge_job, out),
               ".exr .png .jpg .jpeg .tif .tiff"),
};
static const clshear_setting no_settings[1];

static int run(void *job);

const program_command merge_command = {
    .name = "merge",
    .usage = "clshear merge FILES [flags]\n"
             "Put shards of a render together: EXR files of the same flags but for --shard\n"
             "K/N, in any order, or merges of some.\n\n"
             "  clshear merge shard-*.exr --out img.exr\n",
    .notes = "The picture is that of a render with all replicates. Shards that are missing are\n"
             "named, and what is there is merged.\n",
    COMMAND_FLAGS(flags),
    .settings = no_settings,
    .takes_files = 1,
    .job_size = sizeof(merge_job),
    .run = run,
};

static int merge(const merge_job *job, clshear_film **films, clshear_film **merged)
{
    char missing[256];
    const size_t count = job->options.file_count;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < count && status == CLSHEAR_OK; i++)
        status = clshear_film_read(job->options.files[i], &films[i]);
    if (status == CLSHEAR_OK)
        status = clshear_film_merge((const clshear_film *const *)films, count, merged);
    if (status == CLSHEAR_BAD_ARGUMENT) status = CLSHEAR_BAD_FILE; /* the films are of files */
    if (status != CLSHEAR_OK) return exit_status_of(status);
    clshear_film_missing(*merged, missing, sizeof missing);
    if (*missing != '\0' && !job->options.quiet)
        fprintf(stderr, "clshear: shards %s are missing; the others are merged\n", missing);
    return EXIT_DONE;
}

static int run(void *user)
{
    const merge_job *job = user;
    const size_t count = job->options.file_count;
    clshear_film *merged = NULL;
    output_files outputs = {0};
    if (count == 0)
        return complain(EXIT_USAGE, "no files given; try: clshear merge a.exr b.exr --out c.exr");
    if (job->out.count == 0) return complain(EXIT_USAGE, "no --out given");
    outputs_add(&outputs, "out", job->out.items, job->out.count);
    int code = outputs_check(&outputs);
    if (code != EXIT_DONE) return code;
    clshear_film **films = calloc(count, sizeof *films);
    if (films == NULL) return complain(EXIT_FAILED, "out of memory");
    code = merge(job, films, &merged);
    for (size_t i = 0; code == EXIT_DONE && i < job->out.count; i++)
        code = exit_status_of(clshear_film_write(merged, job->out.items[i]));
    for (size_t i = 0; i < count; i++)
        clshear_film_free(films[i]);
    clshear_film_free(merged);
    free(films);
    return code;
}
