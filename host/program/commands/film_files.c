#include "commands/film_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "report/failure.h"

char *film_files_default_name(const char *scene)
{
    const char *slash = strrchr(scene, '/');
    const char *name = slash != NULL ? slash + 1 : scene;
    const char *dot = strrchr(name, '.');
    const size_t length = dot != NULL && dot != name ? (size_t)(dot - name) : strlen(name);
    const size_t size = length + sizeof ".exr";
    char *path = malloc(size);
    if (path != NULL) snprintf(path, size, "%.*s.exr", (int)length, name);
    return path;
}

char *film_files_numbered_name(const char *path, int number)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    const size_t length = dot != NULL ? (size_t)(dot - path) : strlen(path);
    const size_t size = strlen(path) + sizeof ".999999";
    char *name = malloc(size);
    if (name != NULL) snprintf(name, size, "%.*s.%04d%s", (int)length, path, number, path + length);
    return name;
}

/* Writes a word as a shell reads it. */
static void write_word(FILE *stream, const char *word)
{
    const int plain = *word != '\0' && strpbrk(word, " \t\n\"'$&*;<>?\\`|()[]{}!#~") == NULL;
    if (!plain) fputc('\'', stream);
    for (; *word != '\0'; word++)
        if (*word == '\'')
            fputs("'\\''", stream);
        else
            fputc(*word, stream);
    if (!plain) fputc('\'', stream);
}

/* The command that was given; NULL when out of memory. */
static char *command_line(const program_options *options)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (stream == NULL) return NULL;
    for (int i = 0; i < options->word_count; i++) {
        if (i > 0) fputc(' ', stream);
        write_word(stream, options->words[i]);
    }
    fclose(stream);
    return text;
}

static clshear_status annotate(const program_options *options, clshear_film *film)
{
    char *line = command_line(options);
    clshear_status status = CLSHEAR_OK;
    if (line != NULL) status = clshear_film_annotate(film, "clshear.cmdline", line);
    if (status == CLSHEAR_OK && options->file_words != NULL)
        status = clshear_film_annotate(film, "clshear.settings", options->file_words);
    free(line);
    return status;
}

/* What an interrupted render has to show. */
typedef enum film_content {
    NO_SAMPLES,
    SOME_SAMPLES, /* some pixels have none */
    ALL_SAMPLES
} film_content;

static film_content content_of(const clshear_film *film, const clshear_film_info *info)
{
    const size_t pixels = (size_t)info->width * (size_t)info->height;
    const float *samples = clshear_film_channel(film, "Samples");
    size_t sampled = 0;
    for (size_t i = 0; i < pixels; i++)
        sampled += samples[i] > 0.0f;
    if (sampled == 0) return NO_SAMPLES;
    return sampled < pixels ? SOME_SAMPLES : ALL_SAMPLES;
}

/* Whether an interrupted render would replace a file that is worth more: any, if it has pixels
 * without samples, and always the picture that it was to extend, which can be extended again. */
static int is_spared(const film_files *files, const char *path, film_content content)
{
    struct stat out, base;
    if (content == NO_SAMPLES) return 1;
    if (stat(path, &out) != 0 || !S_ISREG(out.st_mode)) return 0;
    if (content == SOME_SAMPLES) return 1;
    return files->extend.count > 0 && stat(files->extend.items[0], &base) == 0 &&
           out.st_ino == base.st_ino && out.st_dev == base.st_dev;
}

static void tell(const char *event, const char *path, int spared, film_content content, int quiet)
{
    if (spared && access(path, F_OK) == 0)
        remark("%s; %s is left as it was", event, path);
    else if (spared)
        remark("%s before the first samples; %s is not written", event, path);
    else if (!quiet)
        remark("%s; %s holds the samples so far%s", event, path,
               content == SOME_SAMPLES ? "; some pixels have none" : "");
}

int film_files_write(const film_files *files, const program_options *options, clshear_film *film,
                     const char *event)
{
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    const film_content content = info.complete ? ALL_SAMPLES : content_of(film, &info);
    int code = exit_status_of(annotate(options, film));
    if (code != EXIT_DONE) return code;
    for (size_t i = 0; i < files->out.count; i++) {
        const char *path = files->out.items[i];
        const int spared = !info.complete && is_spared(files, path, content);
        const clshear_status status = spared ? CLSHEAR_OK : clshear_film_write(film, path);
        if (status != CLSHEAR_OK)
            code = exit_status_of(status); /* which must not cost the other outputs */
        else if (!info.complete)
            tell(event, path, spared, content, options->quiet);
    }
    if (files->gain.count == 0 || clshear_film_channel(film, "Gain") == NULL) return code;
    const int of_gain =
        exit_status_of(clshear_film_write_ratio(film, "Gain", files->gain.items[0]));
    return of_gain != EXIT_DONE ? of_gain : code;
}
