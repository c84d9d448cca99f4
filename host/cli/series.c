#include "cli/series.h"

#include <math.h>

static const char *name_of_error(const cli_study *study)
{
    return study->has_reference ? "mse" : "variance";
}

void cli_study_write_csv(FILE *stream, const void *user)
{
    const cli_study *study = user;
    fprintf(stream, "target,sampler,shear,n,replicates,%s,slope,slope_low,slope_high,mean\n",
            name_of_error(study));
    for (int s = 0; s < study->series_count; s++) {
        const cli_series *series = &study->series[s];
        for (size_t k = 0; k < study->sizes; k++)
            fprintf(stream, "%s,%s,%s,%u,%u,%.6g,%.4f,%.4f,%.4f,%.6g\n", series->target,
                    series->sampler, series->shear, series->counts[k], study->replicates,
                    series->errors[k], series->fit.slope, series->fit.slope_low,
                    series->fit.slope_high, series->mean);
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

static void write_series(FILE *stream, const cli_study *study, const cli_series *series)
{
    fprintf(stream, "    {\"target\": \"%s\", \"sampler\": \"%s\", \"shear\": \"%s\",\n     ",
            series->target, series->sampler, series->shear);
    write_number(stream, "slope", series->fit.slope);
    fprintf(stream, ", ");
    write_number(stream, "slope_low", series->fit.slope_low);
    fprintf(stream, ", ");
    write_number(stream, "slope_high", series->fit.slope_high);
    fprintf(stream, ", ");
    write_number(stream, "mean", series->mean);
    fprintf(stream, ",\n     \"n\": [");
    for (size_t k = 0; k < study->sizes; k++)
        fprintf(stream, "%s%u", k > 0 ? ", " : "", series->counts[k]);
    fprintf(stream, "], \"%s\": [", name_of_error(study));
    for (size_t k = 0; k < study->sizes; k++)
        fprintf(stream, "%s%.6g", k > 0 ? ", " : "", series->errors[k]);
    fprintf(stream, "]}");
}

void cli_study_write_json(FILE *stream, const void *user)
{
    const cli_study *study = user;
    fprintf(stream, "{\n  \"replicates\": %u,\n  \"series\": [\n", study->replicates);
    for (int s = 0; s < study->series_count; s++) {
        write_series(stream, study, &study->series[s]);
        fprintf(stream, "%s\n", s + 1 < study->series_count ? "," : "");
    }
    fprintf(stream, "  ]\n}\n");
}

/* Blocks of N and error, two empty lines apart: gnuplot's indices. */
static void write_data(FILE *stream, const void *user)
{
    const cli_study *study = user;
    for (int s = 0; s < study->series_count; s++) {
        for (size_t k = 0; k < study->sizes; k++)
            fprintf(stream, "%u %.8g\n", study->series[s].counts[k], study->series[s].errors[k]);
        fprintf(stream, "\n\n");
    }
}

static void write_script(FILE *stream, const void *user)
{
    const cli_study *study = user;
    const cli_series *first = &study->series[0];
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
            first->counts[0], first->counts[study->sizes - 1], first->errors[0], first->counts[0],
            slopes[i], i + 2, slopes[i]);
    for (int s = 0; s < study->series_count; s++)
        fprintf(
            stream,
            "  data index %d with linespoints pt %d lw 2 lc rgb '%s' title '%s %s %s: %.2f'%s\n", s,
            s % 13 + 1, cli_plot_colour(s), study->series[s].target, study->series[s].sampler,
            study->series[s].shear, study->series[s].fit.slope,
            s + 1 < study->series_count ? ", \\" : "");
}

int cli_study_draw(const cli_study *study, const cli_plot *plot)
{
    int visible = 0;
    for (int s = 0; s < study->series_count; s++)
        for (size_t k = 0; k < study->sizes; k++)
            visible |= study->series[s].errors[k] > 0.0;
    if (plot->path != NULL && !visible) {
        fprintf(stderr, "clshear: all errors are 0: %s is not drawn\n", plot->path);
        return 0;
    }
    return cli_plot_draw(plot, write_data, write_script, study);
}
