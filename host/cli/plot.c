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
    fprintf(stream, "\nif (strlen(target) > 0) set output target\ndata = ");
    write_quoted(stream, d->data);
    fprintf(stream, "\nset grid lc rgb '#dddddd'\n");
    d->write_script(stream, d->user);
}

/* What gnuplot drew, in memory: it does not notice when a disk is full. */
typedef struct picture {
    char *bytes;
    size_t size;
} picture;

/* All that comes from `source`, until its end. Returns whether there was memory for it. */
static int read_all(int source, picture *result)
{
    char chunk[65536];
    ssize_t got;
    FILE *memory = open_memstream(&result->bytes, &result->size);
    if (memory == NULL) return 0;
    while ((got = read(source, chunk, sizeof chunk)) > 0)
        fwrite(chunk, 1, (size_t)got, memory);
    const int broken = ferror(memory);
    return fclose(memory) == 0 && !broken && got == 0;
}

/* Runs gnuplot on a script that draws to the standard output stream; its complaints go to the
 * standard error stream. */
static int run_gnuplot(const char *script, picture *result)
{
    int state = 0, ends[2];
    if (pipe(ends) != 0) return 0;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        execlp("gnuplot", "gnuplot", "-e", "target = ''", script, (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    const int complete = read_all(ends[0], result);
    close(ends[0]);
    return child > 0 && waitpid(child, &state, 0) == child && WIFEXITED(state) &&
           WEXITSTATUS(state) == 0 && complete && result->size > 0;
}

static void write_picture(FILE *stream, const void *user)
{
    const picture *drawn = user;
    fwrite(drawn->bytes, 1, drawn->size, stream);
}

static int draw(const cli_plot *plot, const char *script)
{
    picture drawn = {0};
    int code = CLI_FAILED;
    if (run_gnuplot(script, &drawn))
        code = cli_write_file(plot->path, write_picture, &drawn);
    else
        fprintf(stderr, "clshear: %s: gnuplot could not draw it\n", plot->path);
    free(drawn.bytes);
    return code;
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
    if (!drawn && !plot->keep) return CLI_FAILED;
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
    return drawn ? code : CLI_FAILED;
}
