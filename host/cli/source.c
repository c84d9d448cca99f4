#include "cli/source.h"

#include <stdio.h>
#include <string.h>

#include "cli/flags.h"

const char *cli_store_source_sampler(void *target, const char *value)
{
    cli_source *job = target;
    job->sampler = value;
    job->draws = 1;
    return cli_check_sampler(value);
}

const char *cli_store_source_count(void *target, const char *value)
{
    cli_source *job = target;
    job->draws = 1;
    return cli_read_count(value, 1, &job->count) ? NULL : "a whole number from 1";
}

const char *cli_store_source_sets(void *target, const char *value)
{
    cli_source *job = target;
    job->draws = 1;
    return cli_read_count(value, 1, &job->sets) ? NULL : "a whole number from 1";
}

const char *cli_store_source_seed(void *target, const char *value)
{
    cli_source *job = target;
    job->draws = 1;
    return cli_read_count(value, 0, &job->seed) ? NULL : "a whole number from 0 to 4294967295";
}

const char *cli_store_source_shear(void *target, const char *value)
{
    cli_source *job = target;
    return cli_read_shear(value, &job->shear);
}

const char *cli_store_source_shear_px(void *target, const char *value)
{
    cli_source *job = target;
    return cli_read_floats(value, 1, &job->shear_px) ? NULL : "a number of pixels";
}

const char *cli_store_source_in(void *target, const char *value)
{
    cli_source *job = target;
    job->in = value;
    return NULL;
}

const char *cli_store_source_projection(void *target, const char *value)
{
    cli_source *job = target;
    job->projection = value;
    return strlen(value) == 2 && strspn(value, "xyuvpq") == 2 ? NULL : "two letters out of xyuvpq";
}

const char *cli_store_source_device(void *target, const char *value)
{
    cli_source *job = target;
    job->context.device = value;
    return NULL;
}

const char *cli_store_source_help(void *target, const char *value)
{
    cli_source *job = target;
    (void)value;
    job->help = 1;
    return NULL;
}

clshear_status cli_source_make(const cli_source *job, const char *dimensions,
                               clshear_points *points)
{
    clshear_status status = job->in != NULL ? clshear_points_read(job->in, points)
                                            : clshear_points_draw(job->sampler, job->count,
                                                                  job->sets, job->seed, points);
    if (status == CLSHEAR_OK && job->in == NULL && points->count != job->count)
        fprintf(stderr, "clshear: sampler %s has no sets of %u points: %zu\n",
                job->sampler != NULL ? job->sampler : "sz", job->count, points->count);
    if (status == CLSHEAR_OK && job->shear_px != 0.0f)
        status = clshear_points_shear(points, job->shear, job->shear_px);
    if (status == CLSHEAR_OK && dimensions != NULL)
        status = clshear_points_select(points, dimensions);
    return status;
}

int cli_source_check(const cli_source *job)
{
    if (job->in == NULL || !job->draws) return CLI_DONE;
    fprintf(stderr,
            "clshear: --in %s brings its points: leave out --sampler, --n, --sets, --seed\n",
            job->in);
    return CLI_USAGE;
}
