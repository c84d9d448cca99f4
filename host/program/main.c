/* The program: the first word may name a command, otherwise a scene is rendered. */
#define _GNU_SOURCE /* pthread_setattr_default_np */
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "commands/commands.h"
#include "report/failure.h"
#include "report/progress.h"
#include "report/words.h"

/* The command that a word which is neither one nor a file may mean, or NULL. */
static const char *nearest_command(const char *word)
{
    const size_t length = strlen(word), most = 2;
    if (length <= most || *word == '-' || access(word, F_OK) == 0) return NULL;
    if (strcmp(word, "help") == 0) return "--help";
    if (strcmp(word, "version") == 0) return "--version";
    for (size_t i = 1; all_commands[i] != NULL; i++) {
        const char *name = all_commands[i]->name;
        if (word_distance(word, length, name, strlen(name)) <= most) return name;
    }
    return NULL;
}

static int run(int argc, char **argv)
{
    for (size_t i = 1; argc > 1 && all_commands[i] != NULL; i++)
        if (strcmp(argv[1], all_commands[i]->name) == 0)
            return command_run(all_commands[i], argc - 1, argv + 1);
    const char *nearest = argc > 1 ? nearest_command(argv[1]) : NULL;
    if (nearest != NULL)
        return complain(EXIT_USAGE, "%s: no such command or scene; did you mean %s?", argv[1],
                        nearest);
    return command_run(all_commands[0], argc, argv);
}

/* Puts something that fails where standard streams are closed: else the first files that are opened
 * would be these streams, and what is printed would go into them. */
static void occupy_streams(void)
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++) {
        if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
        const int mode = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        if (open("/dev/null", mode) != stream) return; /* the lowest that is free */
    }
}

/* Gives threads, those of drivers too, stacks of 2 MB where `ulimit -s` sets a smaller default: it
 * is meant for the first thread. Only GNU's C library has the call. */
static void enlarge_stacks(void)
{
#ifdef __GLIBC__
    const size_t wanted = (size_t)2 << 20;
    size_t size = wanted;
    pthread_attr_t attributes;
    if (pthread_getattr_default_np(&attributes) != 0) return;
    if (pthread_attr_getstacksize(&attributes, &size) == 0 && size < wanted &&
        pthread_attr_setstacksize(&attributes, wanted) == 0)
        pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
#endif
}

int main(int argc, char **argv)
{
    occupy_streams();
    progress_note_signals();
    enlarge_stacks();
    const int code = run(argc, argv);
    if (code != EXIT_DONE || (fflush(stdout) == 0 && !ferror(stdout))) return code;
    return complain(EXIT_FAILED, "standard output: cannot be written: %s", strerror(errno));
}
