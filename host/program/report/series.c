#include "report/series.h"

#include <math.h>

#include "report/failure.h"

void study_free(error_study *study)
{
    for (size_t s = 0; s < study->count; s++)
        clshear_convergence_free(study->series[s].result);
}

static clshear_fit fit_of(const error_series *series)
{
    clshear_fit fit = {.struct_size = sizeof fit};
    clshear_convergence_fit(series->result, &fit);
    return fit;
}

static size_t sizes_of(const error_study *study)
{
    return study->count > 0 ? clshear_convergence_sizes(study->series[0].result) : 0;
}

static const char *name_of_error(const error_study *study)
{
    return study->has_reference ? "mse" : "variance";
}

static clshear_fit local_fit_of(const error_series *series, size_t index)
{
    clshear_fit fit = {.struct_size = sizeof fit};
    clshear_convergence_local_fit(series->result, index, &fit);
    return fit;
}

/* The slope to the next number of samples; nothing after the last. */
static void write_local_slope(FILE *stream, const error_study *study, const error_series *series,
                              size_t index)
{
    if (index + 1 == sizes_of(study)) {
        fprintf(stream, ",,,");
        return;
    }
    const clshear_fit fit = local_fit_of(series, index);
    fprintf(stream, ",%.4f,%.4f,%.4f", fit.slope, fit.slope_low, fit.slope_high);
}

void study_write_csv(FILE *stream, const void *user)
{
    const error_study *study = user;
    fprintf(stream, "target,sampler,shear,n,replicates,%s,slope,slope_low,slope_high,mean%s\n",
            name_of_error(study),
            study->has_local_slopes ? ",local_slope,local_slope_low,local_slope_high" : "");
    for (size_t s = 0; s < study->count; s++) {
        const error_series *series = &study->series[s];
        const clshear_fit fit = fit_of(series);
        for (size_t k = 0; k < sizes_of(study); k++) {
            fprintf(stream, "%s,%s,%s,%u,%u,%.6g,%.4f,%.4f,%.4f,%.6g", series->target,
                    series->sampler, series->shear, clshear_convergence_count(series->result, k),
                    study->replicates, clshear_convergence_error(series->result, k), fit.slope,
                    fit.slope_low, fit.slope_high, clshear_convergence_mean(series->result));
            if (study->has_local_slopes) write_local_slope(stream, study, series, k);
            fprintf(stream, "\n");
        }
    }
}

/* A number, or null: JSON knows no NaN. */
static void write_number(FILE *stream, const char *name, double value)
{
    if (isfinite(value))
        fprintf(stream, "\"%s\": %.6g", name, value);
    else
        fprintf(stream, "\"%s\": null", name);
}

/* An array of objects, one for each step between two numbers of samples. */
static void write_local_slopes(FILE *stream, const error_study *study, const error_series *series)
{
    fprintf(stream, ",\n     \"local_slopes\": [");
    for (size_t k = 0; k + 1 < sizes_of(study); k++) {
        const clshear_fit fit = local_fit_of(series, k);
        fprintf(stream, "%s{", k > 0 ? ", " : "");
        write_number(stream, "slope", fit.slope);
        fprintf(stream, ", ");
        write_number(stream, "slope_low", fit.slope_low);
        fprintf(stream, ", ");
        write_number(stream, "slope_high", fit.slope_high);
        fprintf(stream, "}");
    }
    fprintf(stream, "]");
}

static void write_series(FILE *stream, const error_study *study, const error_series *series)
{
    const clshear_fit fit = fit_of(series);
    fprintf(stream, "    {\"target\": \"%s\", \"sampler\": \"%s\", \"shear\": \"%s\",\n     ",
            series->target, series->sampler, series->shear);
    write_number(stream, "slope", fit.slope);
    fprintf(stream, ", ");
    write_number(stream, "slope_low", fit.slope_low);
    fprintf(stream, ", ");
    write_number(stream, "slope_high", fit.slope_high);
    fprintf(stream, ", ");
    write_number(stream, "mean", clshear_convergence_mean(series->result));
    fprintf(stream, ",\n     \"n\": [");
    for (size_t k = 0; k < sizes_of(study); k++)
        fprintf(stream, "%s%u", k > 0 ? ", " : "", clshear_convergence_count(series->result, k));
    fprintf(stream, "], \"%s\": [", name_of_error(study));
    for (size_t k = 0; k < sizes_of(study); k++)
        fprintf(stream, "%s%.6g", k > 0 ? ", " : "", clshear_convergence_error(series->result, k));
    fprintf(stream, "]");
    if (study->has_local_slopes) write_local_slopes(stream, study, series);
    fprintf(stream, "}");
}

void study_write_json(FILE *stream, const void *user)
{
    const error_study *study = user;
    fprintf(stream, "{\n  \"replicates\": %u,\n  \"series\": [\n", study->replicates);
    for (size_t s = 0; s < study->count; s++) {
        write_series(stream, study, &study->series[s]);
        fprintf(stream, "%s\n", s + 1 < study->count ? "," : "");
    }
    fprintf(stream, "  ]\n}\n");
}

/* Blocks of N and error, two empty lines apart: gnuplot's indices. */
static void write_data(FILE *stream, const void *user)
{
    const error_study *study = user;
    for (size_t s = 0; s < study->count; s++) {
        for (size_t k = 0; k < sizes_of(study); k++)
            fprintf(stream, "%u %.8g\n", clshear_convergence_count(study->series[s].result, k),
                    clshear_convergence_error(study->series[s].result, k));
        fprintf(stream, "\n\n");
    }
}

static void write_script(FILE *stream, const void *user)
{
    const error_study *study = user;
    const error_series *first = &study->series[0];
    const uint32_t least = clshear_convergence_count(first->result, 0);
    static const double slopes[] = {-1.0, -1.5, -2.0};
    fprintf(stream,
            "set logscale xy\nset format y '10^{%%T}'\nset xlabel 'samples N'\nset ylabel '%s'\n"
            "set key bottom left Left reverse\nplot \\\n",
            name_of_error(study));
    for (int i = 0; i < 3; i++)
        fprintf(
            stream,
            "  [%u:%u] %.8g * (x / %u.0)**(%g) with lines lc rgb '#999999' dt %d title 'N^{%g}', "
            "\\\n",
            least, clshear_convergence_count(first->result, sizes_of(study) - 1),
            clshear_convergence_error(first->result, 0), least, slopes[i], i + 2, slopes[i]);
    for (size_t s = 0; s < study->count; s++)
        fprintf(
            stream,
            "  data index %zu with linespoints pt %d lw 2 lc rgb '%s' title '%s %s %s: %.2f'%s\n",
            s, (int)(s % 13) + 1, plot_colour((int)s), study->series[s].target,
            study->series[s].sampler, study->series[s].shear, fit_of(&study->series[s]).slope,
            s + 1 < study->count ? ", \\" : "");
}

int study_draw(const error_study *study, const plot_files *plot)
{
    int visible = 0;
    for (size_t s = 0; s < study->count; s++)
        for (size_t k = 0; k < sizes_of(study); k++)
            visible |= clshear_convergence_error(study->series[s].result, k) > 0.0;
    if (plot->path != NULL && !visible) {
        complain(EXIT_DONE, "all errors are 0: %s is not drawn", plot->path);
        return EXIT_DONE;
    }
    return plot_draw(plot, write_data, write_script, study);
}
