#include "cli/plot.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/job.h"
#include "cli/output.h"

static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#e69f00", "#56b4e9", "#000000", "#999999"};

const char *cli_plot_colour(int index)
{
    return colours[index % (int)(sizeof colours / sizeof *colours)];
}

static int ends_in(const char *path, const char *end)
{
    const size_t length = strlen(path), size = strlen(end);
    return length > size && strcmp(path + length - size, end) == 0;
}

const char *cli_read_plot_path(const char *value, const char **path)
{
    *path = value;
    return ends_in(value, ".png") || ends_in(value, ".svg") ? NULL
                                                            : "a name that ends in .png or .svg";
}

static int has_gnuplot(void)
{
    const char *path = getenv("PATH");
    char file[4096];
    for (const char *start = path; start != NULL && *start != '\0';) {
        const size_t length = strcspn(start, ":");
        snprintf(file, sizeof file, "%.*s/gnuplot", (int)length, start);
        if (access(file, X_OK) == 0) return 1;
        start += length + (start[length] == ':');
    }
    return 0;
}

/* A string of gnuplot in single quotes, where only those need care. */
static void write_quoted(FILE *stream, const char *text)
{
    fputc('\'', stream);
    for (; *text != '\0'; text++)
        fputs(*text == '\'' ? "\'\'" : (const char[]){*text, '\0'}, stream);
    fputc('\'', stream);
}

typedef struct drawing {
    const cli_plot *plot;
    const char *data;
    void (*write_script)(FILE *stream, const void *user);
    const void *user;
} drawing;

/* A script that stands by itself; `target` can be set to draw elsewhere. */
static void write_script(FILE *stream, const void *user)
{
    const drawing *d = user;
    fprintf(stream, "set terminal %s\nif (!exists('target')) target = ",
            ends_in(d->plot->path, ".svg") ? "svg size 800,560 font 'sans,14' background '#ffffff'"
                                           : "pngcairo size 960,672 font 'sans,13'");
    write_quoted(stream, d->plot->path);
    fprintf(stream, "\nset output target\ndata = ");
    write_quoted(stream, d->data);
    fprintf(stream, "\nset grid lc rgb '#dddddd'\n");
    d->write_script(stream, d->user);
}

/* Runs gnuplot on a script that draws into `target`; its complaints go to the standard error
 * stream.
 */
static int run_gnuplot(const char *script, const char *target)
{
    char assignment[4200];
    int state = 0;
    FILE *text = fmemopen(assignment, sizeof assignment, "w");
    if (text == NULL) return 0;
    fprintf(text, "target = ");
    write_quoted(text, target);
    fclose(text);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        execlp("gnuplot", "gnuplot", "-e", assignment, script, (char *)NULL);
        _exit(127);
    }
    return child > 0 && waitpid(child, &state, 0) == child && WIFEXITED(state) &&
           WEXITSTATUS(state) == 0;
}

/* Draws beside the plot and gives it its name when it is complete. */
static int draw(const cli_plot *plot, const char *script)
{
    char part[4096];
    snprintf(part, sizeof part, "%s.part%ld", plot->path, (long)getpid());
    if (run_gnuplot(script, part) && rename(part, plot->path) == 0) return CLI_DONE;
    unlink(part);
    fprintf(stderr, "clshear: %s: gnuplot could not draw it\n", plot->path);
    return CLI_FAILED;
}

int cli_plot_draw(const cli_plot *plot, void (*write_data)(FILE *stream, const void *user),
                  void (*write_curves)(FILE *stream, const void *user), const void *user)
{
    char data[4096], script[4096];
    if (plot->path == NULL) return CLI_DONE;
    const int drawn = has_gnuplot();
    if (!drawn)
        fprintf(stderr, "clshear: no gnuplot here: %s is not drawn; install gnuplot-nox\n",
                plot->path);
    if (!drawn && !plot->keep) return CLI_DONE;
    snprintf(data, sizeof data, "%s.dat", plot->path);
    snprintf(script, sizeof script, "%s.gp", plot->path);
    const drawing d = {plot, data, write_curves, user};
    int code = cli_write_file(data, write_data, user);
    if (code == CLI_DONE) code = cli_write_file(script, write_script, &d);
    if (code == CLI_DONE && drawn) code = draw(plot, script);
    if (!plot->keep) {
        unlink(data);
        unlink(script);
    }
    return code;
}
