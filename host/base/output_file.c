#include "base/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int cs_is_special_file(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && !S_ISREG(about.st_mode);
}

const char *cs_not_a_file(const char *path)
{
    struct stat about;
    if (stat(path, &about) != 0 || S_ISREG(about.st_mode)) return NULL;
    return S_ISDIR(about.st_mode) ? "is a folder, not a file" : "is not a regular file";
}

/* Where the link at `path` leads, though nothing is there yet; NULL if it is no link. */
static char *link_target(const char *path)
{
    char name[4096];
    const ssize_t length = readlink(path, name, sizeof name - 1);
    if (length < 0) return NULL;
    name[length] = '\0';
    const char *slash = strrchr(path, '/');
    const size_t folder = *name == '/' || slash == NULL ? 0 : (size_t)(slash + 1 - path);
    char *target = malloc(folder + (size_t)length + 1);
    if (target == NULL) return NULL;
    memcpy(target, path, folder);
    memcpy(target + folder, name, (size_t)length + 1);
    return target;
}

/* The temporary path beside `target`, owned by the caller. A name that would be too long with what
 * is added to it is cut. */
static char *part_beside(const char *target)
{
    char suffix[sizeof ".part" + 20]; /* 64 bits have 20 digits */
    const size_t added = (size_t)snprintf(suffix, sizeof suffix, ".part%ld", (long)getpid());
    const char *slash = strrchr(target, '/');
    const size_t folder = slash == NULL ? 0 : (size_t)(slash + 1 - target);
    size_t kept = strlen(target);
    if (kept - folder > NAME_MAX - added) kept = folder + NAME_MAX - added;
    char *part = malloc(kept + added + 1);
    if (part == NULL) return NULL;
    memcpy(part, target, kept);
    memcpy(part + kept, suffix, added + 1);
    return part;
}

int cs_output_begin(const char *path, cs_output_file *file)
{
    *file = (cs_output_file){0};
    const int special = cs_is_special_file(path);
    file->target = special ? NULL : realpath(path, NULL);
    if (file->target == NULL && !special) file->target = link_target(path);
    if (file->target == NULL) file->target = strdup(path);
    if (file->target == NULL) return ENOMEM;
    file->part = special ? strdup(file->target) : part_beside(file->target);
    if (file->part == NULL) {
        free(file->target);
        *file = (cs_output_file){0};
        return ENOMEM;
    }
    return 0;
}

/* Makes the part anew, so that nobody else can read it: neither through its permissions nor through
 * a file of that name that is left from before. Returns NULL with errno if it cannot. */
static FILE *open_private(const char *part)
{
    unlink(part);
    const int descriptor = open(part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) return NULL;
    FILE *stream = fdopen(descriptor, "wb");
    const int reason = errno;
    if (stream == NULL) close(descriptor);
    errno = reason;
    return stream;
}

/* Hands on the group, and the owner where the process may give files away. Returns whether the file
 * has the group. */
static int hand_on_owner(int descriptor, const struct stat *old)
{
    return fchown(descriptor, old->st_uid, old->st_gid) == 0 ||
           fchown(descriptor, (uid_t)-1, old->st_gid) == 0;
}

/* Returns the permissions of a file that has another group than the old file. Members of the old
 * group are among the others now, and others may be members of the new group. So both classes get
 * only the rights that both classes had. */
static mode_t without_group(mode_t mode)
{
    const mode_t both = mode & mode >> 3 & 07;
    return (mode & 0700) | both << 3 | both;
}

/* Opens the part. A file that it will replace has to allow that, and hands on its owner, its group
 * and its permissions. These come last: until then the file may have another owner. */
static FILE *open_part(const cs_output_file *file)
{
    struct stat old;
    const int replaces = strcmp(file->part, file->target) != 0 && stat(file->target, &old) == 0;
    if (!replaces) return fopen(file->part, "wb");
    if (access(file->target, W_OK) != 0) return NULL;
    FILE *stream = open_private(file->part);
    if (stream == NULL) return NULL;
    const int has_group = hand_on_owner(fileno(stream), &old);
    fchmod(fileno(stream), has_group ? old.st_mode & 0777 : without_group(old.st_mode));
    return stream;
}

int cs_output_open(const char *path, cs_output_file *file)
{
    int reason = cs_output_begin(path, file);
    if (reason != 0) return reason;
    file->stream = open_part(file);
    if (file->stream != NULL) return 0;
    reason = errno;
    free(file->target);
    free(file->part);
    *file = (cs_output_file){0};
    return reason;
}

/* Whether all that was written is on the disk; else errno says why not. */
static int is_on_disk(FILE *stream)
{
    return fflush(stream) == 0 && fsync(fileno(stream)) == 0;
}

/* Puts the names in a file's folder on the disk. Returns 0, or errno. Where the folder cannot be
 * read, or the file system has no such call, either of the two files has the name after a power
 * cut. */
static int sync_names(char *target)
{
    char *slash = strrchr(target, '/');
    if (slash != NULL) slash[slash == target] = '\0';
    const int folder = open(slash != NULL ? target : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return 0;
    const int reason = fsync(folder) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
    close(folder);
    return reason;
}

int cs_output_end(cs_output_file *file, int good)
{
    const int special = strcmp(file->part, file->target) == 0;
    int reason = 0;
    if (file->stream != NULL) {
        errno = 0;
        const int broken = ferror(file->stream) ||
                           (good && file->is_durable && !special && !is_on_disk(file->stream));
        if (fclose(file->stream) != 0 || broken) reason = errno != 0 ? errno : EIO;
    }
    if (good && reason == 0 && !special && rename(file->part, file->target) != 0) reason = errno;
    if ((!good || reason != 0) && !special) unlink(file->part);
    if (good && reason == 0 && file->is_durable && !special) reason = sync_names(file->target);
    free(file->target);
    free(file->part);
    *file = (cs_output_file){0};
    return reason;
}
