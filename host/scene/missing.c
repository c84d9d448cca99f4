#include "scene/missing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    for (int i = 0; i < missing->count; i++)
        if (strcmp(missing->paths[i], path) == 0) return;
    if (missing->count == CS_MISSING_MAX) return;
    snprintf(missing->paths[missing->count++], CS_MISSING_PATH, "%s", path);
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    (void)mode; /* importing only reads */
    struct aiFile *file = calloc(1, sizeof *file);
    FILE *stream = fopen(path, "rb");
    if (file == NULL || stream == NULL) {
        if (stream != NULL) fclose(stream);
        free(file);
        remember((cs_missing *)(void *)io->UserData, path);
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
