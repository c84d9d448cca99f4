#include "oracle/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Statistics of a pixel and its neighbours, 3 x 3 pixels. */
typedef struct surroundings {
    double variance;  /* mean with binomial weights */
    double intensity; /* likewise */
    double contrast;  /* largest difference of intensity from the pixel */
} surroundings;

static int is_known(const cs_pilot_picture *pilot, size_t pixel)
{
    return !(pilot->variance[pixel] < 0.0f);
}

static surroundings surroundings_of(const cs_pilot_picture *pilot, size_t pixel)
{
    const int width = pilot->width, height = pilot->height;
    const int x = (int)(pixel % (size_t)width), y = (int)(pixel / (size_t)width);
    surroundings found = {0};
    double weights = 0.0;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++) {
            const size_t there = (size_t)j * (size_t)width + (size_t)i;
            const int own = there == pixel;
            if (!is_known(pilot, there)) continue;
            const double weight = (i == x ? 2.0 : 1.0) * (j == y ? 2.0 : 1.0);
            const double intensity =
                (double)(own ? pilot->intensity : pilot->near_intensity)[there];
            const double contrast = fabs(intensity - (double)pilot->intensity[pixel]);
            found.variance +=
                weight * (double)(own ? pilot->variance : pilot->near_variance)[there];
            found.intensity += weight * intensity;
            found.contrast = fmax(found.contrast, contrast);
            weights += weight;
        }
    found.variance /= weights;
    found.intensity /= weights;
    return found;
}

/* What importance is measured by, of the whole picture. */
typedef struct measure {
    double overlooked; /* variance of a missed feature, of contrast 1 */
    double level;      /* the picture's mean intensity */
    double dark;       /* square of the intensity below which errors are absolute */
    double absolute;   /* A of allocate.h */
    double relative;   /* B */
} measure;

/* V and W of allocate.h. */
typedef struct errors {
    cs_f32 v, w;
    int is_dark;
} errors;

static errors errors_of(const cs_pilot_picture *pilot, const measure *by, size_t pixel)
{
    const surroundings at = surroundings_of(pilot, pixel);
    return (errors){.v = (cs_f32)(at.variance + by->overlooked * at.contrast * at.contrast),
                    .w = (cs_f32)(1.0 / (at.intensity * at.intensity + by->dark)),
                    .is_dark = at.intensity < 0.5 * by->level};
}

/* Notes V and W of every pixel in `all`. */
static measure measure_of(const cs_pilot_picture *pilot, errors *all)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    /* A feature missed by n samples has an area of about 1/n. Within it, patterns of s samples have
     * the variance contrast^2 / (n s). */
    measure by = {.overlooked =
                      0.2 / ((double)pilot->pattern * pilot->pattern * pilot->replicates)};
    double known = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        if (!is_known(pilot, i)) continue;
        by.level += fabs((double)pilot->intensity[i]);
        known++;
    }
    by.level /= known > 0.0 ? known : 1.0;
    by.dark = 1e-4 * by.level * by.level + 1e-30;
    for (size_t i = 0; i < pixels; i++) {
        if (pilot->certain[i] || !is_known(pilot, i)) continue;
        all[i] = errors_of(pilot, &by, i);
        by.absolute += (double)all[i].v;
        by.relative += (double)all[i].v * (double)all[i].w;
    }
    return by;
}

enum {
    BINS = 4096,
    BINS_PER_OCTAVE = 96,
    LOWEST = -40 /* binary logarithm of the importance of the first bin */
};

/* Pixels of like importance. */
typedef struct crowd {
    double pixels;
    double absolute; /* their part of A */
    double relative; /* of B */
} crowd;

/* All pixels but the certain ones, by importance. */
typedef struct census {
    crowd bright[BINS];
    crowd dark[BINS];
    double certain; /* pixels */
    double pixels;  /* in all */
} census;

/* The bin of a pixel with these errors, if `weight` is that of the relative error. */
static int bin_of(const measure *by, double weight, errors at)
{
    const double v = (double)at.v, w = (double)at.w;
    const double share = v / (by->absolute + 1e-300) + weight * v * w / (by->relative + 1e-300);
    const double importance = 0.4 * (double)log2f((float)share + 1e-37f);
    const double bin = (importance - LOWEST) * BINS_PER_OCTAVE;
    return bin < 0.0 ? 0 : bin < BINS ? (int)bin : BINS - 1;
}

/* How samples follow from a pixel's errors. */
typedef struct plan {
    cs_u32 least; /* of bright pixels */
    cs_u32 even;  /* of dark ones */
    cs_u32 most;
    double weight; /* of the relative error */
    double scale;  /* binary logarithm of samples over importance */
} plan;

/* Counts the pixels by their importance. */
static void count_pixels(const cs_pilot_picture *pilot, const measure *by, const errors *found,
                         double weight, census *all)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    memset(all, 0, sizeof *all);
    for (size_t i = 0; i < pixels; i++) {
        if (!is_known(pilot, i)) continue;
        all->pixels++;
        if (pilot->certain[i]) {
            all->certain++;
            continue;
        }
        const errors at = found[i];
        crowd *mine = (at.is_dark ? all->dark : all->bright) + bin_of(by, weight, at);
        mine->pixels++;
        mine->absolute += (double)at.v;
        mine->relative += (double)at.v * (double)at.w;
    }
}

/* `least`, or the power of two nearest to what the bin is worth, from there to `most`. */
static cs_u32 samples_of(const plan *how, int bin, int is_dark)
{
    const double wanted = exp2(how->scale + LOWEST + (double)bin / BINS_PER_OCTAVE);
    cs_u32 count = is_dark ? how->even : how->least;
    while (bin > 0 && count < how->most) { /* no variance: what is left over helps nobody */
        const cs_u32 next = 2 * cs_power_of_two(count);
        if ((double)next > 1.41421356 * wanted) break;
        count = next;
    }
    return count;
}

/* Samples of a plan, without those of certain pixels. */
static double total_of(const census *all, const plan *how)
{
    double sum = 0.0;
    for (int bin = 0; bin < BINS; bin++) {
        const double bright = all->bright[bin].pixels, dark = all->dark[bin].pixels;
        if (bright > 0.0) sum += bright * samples_of(how, bin, 0);
        if (dark > 0.0) sum += dark * samples_of(how, bin, 1);
    }
    return sum;
}

/* What a plan leaves, if variance falls as N^-1.4; both up to a factor. */
typedef struct prospect {
    double absolute; /* A */
    double relative; /* B */
} prospect;

static prospect prospect_of(const census *all, const plan *how)
{
    prospect sum = {0};
    for (int place = 0; place < 2 * BINS; place++) {
        const int is_dark = place >= BINS, bin = place % BINS;
        const crowd *these = (is_dark ? all->dark : all->bright) + bin;
        if (!(these->pixels > 0.0)) continue;
        const double left = pow(samples_of(how, bin, is_dark), -1.4);
        sum.absolute += these->absolute * left;
        sum.relative += these->relative * left;
    }
    return sum;
}

/* Finds the largest scale with which the range's samples are enough, to a hundred-thousandth of an
 * octave. */
static prospect fit(const census *all, const cs_range *range, plan *how)
{
    const double budget = range->mean * all->pixels - range->certain * all->certain;
    double low = -60.0, high = 160.0;
    for (int step = 0; step < 24; step++) {
        how->scale = 0.5 * (low + high);
        if (total_of(all, how) > budget)
            high = how->scale;
        else
            low = how->scale;
    }
    how->scale = low;
    return prospect_of(all, how);
}

/* A plan with less than `even` in bright pixels, if one promises enough and that neither error
 * rises; else one without. `all` is overwritten. */
static plan choose_plan(const cs_pilot_picture *pilot, const measure *by, const errors *found,
                        const cs_range *range, census *all)
{
    static const double weights[] = {1.0, 0.3, 0.1};
    const double clear = 1.03; /* the least gain for which bright pixels may have less than even */
    plan best = {.least = range->even, .even = range->even, .weight = weights[0]};
    best.most = cs_power_of_two(range->most / 16 < range->mean ? range->most : 16 * range->mean);
    count_pixels(pilot, by, found, best.weight, all);
    const prospect safe = fit(all, range, &best);
    const double enough = safe.absolute * safe.relative / (clear * clear);
    if (range->least >= range->even) return best;
    for (size_t k = 0; k < sizeof weights / sizeof *weights && best.least == range->even; k++) {
        plan bold = best;
        bold.least = range->least;
        bold.weight = weights[k];
        if (k > 0) count_pixels(pilot, by, found, bold.weight, all);
        const prospect daring = fit(all, range, &bold);
        if (daring.absolute <= safe.absolute && daring.relative <= safe.relative &&
            daring.absolute * daring.relative < enough)
            best = bold;
    }
    return best;
}

cs_u32 cs_power_of_two(cs_u32 count)
{
    cs_u32 power = 1;
    while (power <= count / 2)
        power *= 2;
    return power;
}

size_t cs_allocate_bytes(void)
{
    return sizeof(errors);
}

/* Reserves what both functions below need; the caller frees it, also after a failure. */
static clshear_status reserve(size_t pixels, census **all, errors **found, cs_error *error)
{
    *all = malloc(sizeof **all);
    *found = malloc(pixels * sizeof **found);
    if (*all == NULL || *found == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", pixels);
    return CLSHEAR_OK;
}

clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, const cs_range *range,
                                   cs_u32 *samples, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    census *all = NULL;
    errors *found = NULL;
    CS_TRY(reserve(pixels, &all, &found, error));
    /* What the pixels have in common must not depend on what is kept from one of them. */
    cs_pilot_picture alone = *pilot;
    alone.near_variance = pilot->variance;
    alone.near_intensity = pilot->intensity;
    const measure by = measure_of(&alone, found);
    const plan how = choose_plan(pilot, &by, found, range, all);
    for (size_t i = 0; i < pixels; i++) {
        samples[i] = range->certain;
        if (pilot->certain[i]) continue;
        const errors at = errors_of(pilot, &by, i);
        samples[i] = samples_of(&how, bin_of(&by, how.weight, at), at.is_dark);
    }
done:
    free(all);
    free(found);
    return status;
}

clshear_status cs_allocate_gain(const cs_pilot_picture *pilot, const cs_range *range, double *gain,
                                cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    census *all = NULL;
    errors *found = NULL;
    CS_TRY(reserve(pixels, &all, &found, error));
    const measure by = measure_of(pilot, found);
    const plan how = choose_plan(pilot, &by, found, range, all);
    count_pixels(pilot, &by, found, how.weight, all);
    const prospect shared = prospect_of(all, &how);
    const double even = pow(range->mean, -1.4);
    *gain = 1.0;
    if (shared.absolute > 0.0 && shared.relative > 0.0)
        *gain = even * sqrt(by.absolute / shared.absolute * (by.relative / shared.relative));
done:
    free(all);
    free(found);
    return status;
}
