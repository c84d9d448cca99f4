#include "commands/point_source.h"

#include <stdio.h>
#include <string.h>

#include "commands/outputs.h"
#include "report/failure.h"

double number_or(const number_list *list, double fallback)
{
    return list->count > 0 ? list->items[0] : fallback;
}

uint32_t seed_of(const program_options *options)
{
    int64_t seed = 0;
    clshear_settings_get_integer(options->settings, CLSHEAR_SEED, &seed);
    return (uint32_t)seed;
}

int point_source_check(const point_source *source, const char *flag, size_t exact)
{
    const clshear_settings *settings = source->options.settings;
    const char *letters = source->letters.count > 0 ? source->letters.items[0] : "xy";
    const size_t length = strlen(letters);
    const int is_drawn = clshear_settings_is_set(settings, CLSHEAR_SAMPLER) ||
                         clshear_settings_is_set(settings, CLSHEAR_SEED) ||
                         clshear_settings_is_set(settings, CLSHEAR_FRESH_SETS);
    if (strspn(letters, POINT_LETTERS) != length || (exact > 0 && length != exact))
        return complain(EXIT_USAGE, "--%s %s: must be %sletters out of " POINT_LETTERS, flag,
                        letters, exact > 0 ? "two " : "");
    if (source->in.count == 0 || !(is_drawn || source->count.count > 0 || source->sets.count > 0))
        return EXIT_DONE;
    return complain(EXIT_USAGE,
                    "--in %s brings its points: leave out --sampler, --n, --sets, --seed, "
                    "--fresh-sets",
                    source->in.items[0]);
}

/* Points as they come from the sampler. */
static clshear_status draw(const point_source *source, size_t sets, uint32_t seed, int moving,
                           clshear_points **points)
{
    char sampler[64];
    int64_t fresh = 0;
    const size_t count = (size_t)number_or(&source->count, 1024.0);
    clshear_status status = clshear_settings_get_text(source->options.settings, CLSHEAR_SAMPLER,
                                                      sampler, sizeof sampler);
    if (status == CLSHEAR_OK)
        status = clshear_settings_get_integer(source->options.settings, CLSHEAR_FRESH_SETS, &fresh);
    if (status == CLSHEAR_OK && moving)
        status = clshear_points_draw_moving(sampler, count, sets, seed, fresh != 0, points);
    else if (status == CLSHEAR_OK)
        status = fresh != 0 ? clshear_points_draw_fresh(sampler, count, sets, seed, points)
                            : clshear_points_draw(sampler, count, sets, seed, points);
    if (status == CLSHEAR_OK && clshear_points_count(*points) != count && !source->options.quiet)
        fprintf(stderr, "clshear: sampler %s has no sets of %zu points: %zu\n", sampler, count,
                clshear_points_count(*points));
    return status;
}

static clshear_status shear_points(const point_source *source, clshear_points *points)
{
    int64_t shear = CLSHEAR_SHEAR_NONE;
    const float shear_px = (float)number_or(&source->shear_px, 0.0);
    clshear_settings_get_integer(source->options.settings, CLSHEAR_SHEAR, &shear);
    if (source->velocity_px.count > 0) {
        const double *velocity = source->velocity_px.items;
        const float velocity_px[2] = {(float)velocity[0], (float)velocity[1]};
        return clshear_points_shear_moving(points, (clshear_shear)shear, shear_px, velocity_px);
    }
    return shear_px != 0.0f ? clshear_points_shear(points, (clshear_shear)shear, shear_px)
                            : CLSHEAR_OK;
}

int point_source_check_outputs(const point_source *source, const output_files *files)
{
    const int code = check_outputs(&source->options, files);
    return code == EXIT_DONE ? outputs_spare(files, "--in", source->in.items, source->in.count)
                             : code;
}

clshear_status point_source_make(const point_source *source, size_t sets, uint32_t seed,
                                 const char *letters, clshear_points **points)
{
    const int is_read = source->in.count > 0;
    if (is_read) letters = NULL;
    if (source->letters.count > 0) letters = source->letters.items[0];
    const int moving =
        source->velocity_px.count > 0 || (letters != NULL && strchr(letters, 't') != NULL);
    clshear_status status = is_read ? clshear_points_read(source->in.items[0], points)
                                    : draw(source, sets, seed, moving, points);
    if (status == CLSHEAR_OK) status = shear_points(source, *points);
    if (status == CLSHEAR_OK && letters != NULL) status = clshear_points_select(*points, letters);
    return status;
}
