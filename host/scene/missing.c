#include "scene/missing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/output_file.h"

static FILE *stream_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_items(struct aiFile *file, char *buffer, size_t size, size_t count)
{
    return fread(buffer, size, count, stream_of(file));
}

static size_t write_nothing(struct aiFile *file, const char *buffer, size_t size, size_t count)
{
    (void)file, (void)buffer, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    return (size_t)ftell(stream_of(file));
}

static size_t file_size(struct aiFile *file)
{
    long here = ftell(stream_of(file));
    fseek(stream_of(file), 0, SEEK_END);
    long end = ftell(stream_of(file));
    fseek(stream_of(file), here, SEEK_SET);
    return end < 0 ? 0 : (size_t)end;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    int whence = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return fseek(stream_of(file), (long)offset, whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void flush_nothing(struct aiFile *file)
{
    (void)file;
}

static void remember(cs_missing *missing, const char *path)
{
    while (strncmp(path, "./", 2) == 0)
        path += 2;
    for (int i = 0; i < missing->count; i++)
        if (strcmp(missing->paths[i], path) == 0) return;
    if (missing->count == CS_MISSING_MAX) return;
    snprintf(missing->paths[missing->count++], CS_MISSING_PATH, "%s", path);
}

/* Appends a file's bytes to `target`; 0 if it cannot be read. */
static int append_file(const char *path, FILE *target)
{
    char bytes[4096];
    size_t count;
    FILE *stream = cs_is_special_file(path) ? NULL : fopen(path, "rb");
    if (stream == NULL) return 0;
    while ((count = fread(bytes, 1, sizeof bytes, stream)) > 0)
        fwrite(bytes, 1, count, target);
    fputc('\n', target);
    fclose(stream);
    return 1;
}

/* `mtllib a.mtl b.mtl` names several files, which Assimp asks for as one, "FOLDER/a.mtl b.mtl": the
 * files one after another; NULL if there are none. */
static FILE *open_several(cs_missing *missing, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    const size_t folder = (size_t)(name - path);
    int found = 0;
    if (strchr(name, ' ') == NULL || strstr(name, ".mtl") == NULL) return NULL;
    FILE *joined = tmpfile();
    while (joined != NULL && *name != '\0') {
        char one[CS_MISSING_PATH];
        size_t length = strcspn(name, " \t");
        snprintf(one, sizeof one, "%.*s%.*s", (int)folder, path, (int)length, name);
        if (append_file(one, joined))
            found++;
        else if (length > 0)
            remember(missing, one);
        name += length;
        name += strspn(name, " \t");
    }
    if (joined != NULL && found == 0) {
        fclose(joined);
        return NULL;
    }
    if (joined != NULL) rewind(joined);
    return joined;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    (void)mode; /* importing only reads */
    struct aiFile *file = calloc(1, sizeof *file);
    cs_missing *missing = (cs_missing *)(void *)io->UserData;
    FILE *stream = cs_is_special_file(path) ? NULL : fopen(path, "rb"); /* folders, pipes */
    if (stream == NULL) stream = open_several(missing, path);
    if (file == NULL || stream == NULL) {
        if (stream != NULL) fclose(stream);
        free(file);
        remember(missing, path);
        return NULL;
    }
    file->ReadProc = read_items;
    file->WriteProc = write_nothing;
    file->TellProc = tell;
    file->FileSizeProc = file_size;
    file->SeekProc = seek;
    file->FlushProc = flush_nothing;
    file->UserData = (aiUserData)(void *)stream;
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose(stream_of(file));
    free(file);
}

struct aiFileIO cs_recording_file_io(cs_missing *missing)
{
    struct aiFileIO io = {open_file, close_file, (aiUserData)(void *)missing};
    return io;
}
