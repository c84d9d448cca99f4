#include "device/pocl_cache.h"

#include <dirent.h>
#include <elf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    FOLDER_SIZE = 1024,
    PATH_SIZE = 4096,
    /* Folders between the cache and its kernels: two of the program's digest, the kernel, its work
     * sizes. */
    KERNEL_LEVEL = 2,
    FILE_LEVEL = 4
};

/* Where PoCL keeps its kernels (PoCL's documentation, "Using PoCL", POCL_CACHE_DIR). */
static void find_folder(char *folder)
{
    const char *own = getenv("POCL_CACHE_DIR"), *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    if (own != NULL)
        snprintf(folder, FOLDER_SIZE, "%s", own);
    else if (cache != NULL)
        snprintf(folder, FOLDER_SIZE, "%s/pocl/kcache", cache);
    else
        snprintf(folder, FOLDER_SIZE, "%s/.cache/pocl/kcache", home != NULL ? home : "");
}

/* Whether a file is a whole shared object as far as its head tells: PoCL links 64-bit ones, whose
 * section headers are the end of the file. */
static int is_whole(const char *path)
{
    Elf64_Ehdr head;
    struct stat about;
    FILE *file = fopen(path, "rb");
    if (file == NULL) return 1; /* PoCL cannot read it either, and compiles it anew */
    const int has_head = fread(&head, sizeof head, 1, file) == 1;
    fclose(file);
    if (!has_head || memcmp(head.e_ident, ELFMAG, SELFMAG) != 0) return 0;
    if (head.e_ident[EI_CLASS] != ELFCLASS64 || stat(path, &about) != 0) return 1;
    return head.e_shoff + (Elf64_Off)head.e_shnum * head.e_shentsize <= (Elf64_Off)about.st_size;
}

static int ends_with(const char *name, const char *end)
{
    const size_t length = strlen(name), end_length = strlen(end);
    return length >= end_length && strcmp(name + length - end_length, end) == 0;
}

static int is_damaged(const char *path)
{
    return !is_whole(path);
}

static int is_any(const char *path)
{
    (void)path;
    return 1;
}

/* Looks for a kernel of this library that is `wanted` in `path`, `level` folders below the cache;
 * returns 1 and leaves its path there. */
static int find_kernel(int (*wanted)(const char *path), char *path, int level)
{
    const size_t length = strlen(path);
    DIR *folder = opendir(path);
    const struct dirent *entry;
    int found = 0;
    while (folder != NULL && !found && (entry = readdir(folder)) != NULL) {
        const char *name = entry->d_name;
        if (*name == '.' || (level == KERNEL_LEVEL && strncmp(name, "cs_", 3) != 0)) continue;
        if (snprintf(path + length, PATH_SIZE - length, "/%s", name) >= (int)(PATH_SIZE - length))
            continue;
        found = level < FILE_LEVEL ? find_kernel(wanted, path, level + 1)
                                   : ends_with(name, ".so") && wanted(path);
    }
    if (!found) path[length] = '\0';
    if (folder != NULL) closedir(folder);
    return found;
}

int cs_pocl_cache_is_empty(void)
{
    char folder[FOLDER_SIZE], path[PATH_SIZE];
    find_folder(folder);
    snprintf(path, sizeof path, "%s", folder);
    return !find_kernel(is_any, path, 0);
}

clshear_status cs_pocl_cache_check(cs_error *error)
{
    char folder[FOLDER_SIZE], path[PATH_SIZE];
    find_folder(folder);
    snprintf(path, sizeof path, "%s", folder);
    if (!find_kernel(is_damaged, path, 0)) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_DEVICE_FAILED,
                   "PoCL's cache of kernels is damaged: %s is cut short; delete the folder %s",
                   path + strlen(folder) + 1, folder);
}

void cs_pocl_cache_advice(cl_device_id device, char *text, size_t size)
{
    char folder[FOLDER_SIZE];
    *text = '\0';
    if (!cs_opencl_is_pocl(device)) return;
    find_folder(folder);
    snprintf(text, size,
             "; PoCL compiles in its cache: make room there, or delete it if it is damaged: %s",
             folder);
}
