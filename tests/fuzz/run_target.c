/* Runs a target: under libFuzzer the one that the program's name ends with, fuzz_NAME; otherwise
 * over the files that are given, each with the target that its folder is named for. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "targets.h"

typedef void target(const uint8_t *data, size_t size);

static const struct {
    const char *name;
    target *run;
} targets[] = {
#define CS_FUZZ_ROW(name) {#name, cs_fuzz_##name},
    CS_FUZZ_TARGET_LIST(CS_FUZZ_ROW)};

/* NULL: there is none of this name. */
static target *find(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
        if (strlen(targets[i].name) == length && strncmp(targets[i].name, name, length) == 0)
            return targets[i].run;
    return NULL;
}

static char folder[256];

static void remove_folder(void)
{
    char command[300];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0) fprintf(stderr, "%s: cannot be removed\n", folder);
}

const char *cs_fuzz_path(const char *name)
{
    enum {
        MOST = 32
    };
    static char paths[MOST][320];
    if (folder[0] == '\0') {
        const char *parent = getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%s/clshear_fuzz_XXXXXX", parent != NULL ? parent : "/tmp");
        if (mkdtemp(folder) == NULL) abort();
        atexit(remove_folder);
    }
    const size_t length = strlen(folder) + 1;
    for (int i = 0; i < MOST; i++) {
        if (paths[i][0] == '\0') snprintf(paths[i], sizeof paths[i], "%s/%s", folder, name);
        if (strcmp(paths[i] + length, name) == 0) return paths[i];
    }
    abort();
}

const char *cs_fuzz_file(const char *name, const void *data, size_t size)
{
    const char *path = cs_fuzz_path(name);
    FILE *stream = fopen(path, "wb");
    if (stream == NULL) abort();
    if (size > 0 && fwrite(data, 1, size, stream) != size) abort();
    fclose(stream);
    return path;
}

#ifdef CS_LIBFUZZER

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static target *chosen;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    const char *name = strstr((*argv)[0], "fuzz_"), *next = name;
    for (; next != NULL; next = strstr(next + 1, "fuzz_"))
        name = next;
    if (name != NULL) chosen = find(name + 5, strlen(name + 5));
    if (chosen != NULL) return 0;
    fprintf(stderr, "%s: the name must end in fuzz_ and a target\n", (*argv)[0]);
    exit(1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    chosen(data, size);
    return 0;
}

#else

static int run_file(const char *path)
{
    static uint8_t bytes[1 << 20];
    const char *end = strrchr(path, '/'), *begin = end;
    while (begin != NULL && begin > path && begin[-1] != '/')
        begin--;
    target *run = begin != NULL ? find(begin, (size_t)(end - begin)) : NULL;
    FILE *stream = fopen(path, "rb");
    if (run == NULL || stream == NULL) {
        fprintf(stderr, "%s: is no file in the folder of a target\n", path);
        if (stream != NULL) fclose(stream);
        return 0;
    }
    const size_t size = fread(bytes, 1, sizeof bytes, stream);
    fclose(stream);
    fprintf(stderr, "== %s\n", path);
    run(bytes, size);
    return 1;
}

int main(int argc, char **argv)
{
    int good = argc > 1;
    for (int i = 1; i < argc; i++)
        good &= run_file(argv[i]);
    return good ? 0 : 1;
}

#endif
