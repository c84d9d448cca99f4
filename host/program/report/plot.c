#include "report/plot.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "report/failure.h"
#include "report/output.h"
#include "report/words.h"

static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#e69f00", "#56b4e9", "#000000", "#999999"};

const char *plot_colour(int index)
{
    return colours[index % (int)(sizeof colours / sizeof *colours)];
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
    for (; *text != '\0'; text++) {
        if (*text == '\'') fputc('\'', stream);
        fputc(*text, stream);
    }
    fputc('\'', stream);
}

typedef struct drawing {
    const plot_files *plot;
    const char *data;
    void (*write_script)(FILE *stream, const void *user);
    const void *user;
} drawing;

/* A script that stands by itself; `target` can be set to draw elsewhere. */
static void write_script(FILE *stream, const void *user)
{
    const drawing *d = user;
    fprintf(stream, "set terminal %s\nif (!exists('target')) target = ",
            has_ending(".svg", d->plot->path)
                ? "svg size 800,560 font 'sans,14' background '#ffffff'"
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

static int draw(const plot_files *plot, const char *script)
{
    picture drawn = {0};
    int code = EXIT_FAILED;
    if (run_gnuplot(script, &drawn))
        code = write_file(plot->path, write_picture, &drawn);
    else
        complain(EXIT_FAILED, "%s: gnuplot could not draw it", plot->path);
    free(drawn.bytes);
    return code;
}

int plot_draw(const plot_files *plot, void (*write_data)(FILE *stream, const void *user),
              void (*write_curves)(FILE *stream, const void *user), const void *user)
{
    if (plot->path == NULL) return EXIT_DONE;
    const int drawn = has_gnuplot();
    if (!drawn)
        complain(EXIT_FAILED, "no gnuplot here: %s is not drawn; install gnuplot-nox", plot->path);
    if (!drawn && !plot->keep) return EXIT_FAILED;
    const size_t size = strlen(plot->path) + sizeof ".dat";
    char *data = malloc(size), *script = malloc(size);
    int code = EXIT_FAILED;
    if (data == NULL || script == NULL) {
        complain(EXIT_FAILED, "out of memory");
    } else {
        snprintf(data, size, "%s.dat", plot->path);
        snprintf(script, size, "%s.gp", plot->path);
        const drawing d = {plot, data, write_curves, user};
        code = write_file(data, write_data, user);
        if (code == EXIT_DONE) code = write_file(script, write_script, &d);
        if (code == EXIT_DONE && drawn) code = draw(plot, script);
        if (!plot->keep) {
            unlink(data);
            unlink(script);
        }
    }
    free(data);
    free(script);
    return drawn ? code : EXIT_FAILED;
}
