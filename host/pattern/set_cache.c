#include "pattern/set_cache.h"

#include <stdio.h>
#include <string.h>

#include "base/cache_folder.h"
#include "base/output_file.h"
#include "clshear/device/hash.h"

enum {
    PATH_SIZE = 4096,
    MAGIC = 0x53505343, /* "CSPS" in the order of bytes of the machine that wrote the file */
    VERSION = 1         /* raise it when the construction of a set changes */
};

/* The head of a file. The set's words follow, and nothing after them. */
typedef struct set_head {
    cs_u32 magic;
    cs_u32 version;
    cs_u32 count;
    cs_u32 number;
    cs_u32 checksum;
} set_head;

static set_head head_of(const cs_set_name *name, const cs_u32 *words)
{
    set_head head = {MAGIC, VERSION, name->count, name->number, 0};
    for (size_t i = 0; i < 2 * (size_t)name->count; i++)
        head.checksum = cs_hash(head.checksum ^ words[i]);
    return head;
}

/* Writes the folder's path and, behind `length` characters of it, the file's name. Returns 0 if
 * there is no cache. */
static int find_path(const cs_set_name *name, char *path, size_t *length)
{
    if (!cs_cache_folder("clshear/point-sets", path, PATH_SIZE)) return 0;
    *length = strlen(path);
    const int used = snprintf(path + *length, PATH_SIZE - *length, "/%s-%u-%u", name->sampler,
                              name->count, name->number);
    return used > 0 && (size_t)used < PATH_SIZE - *length;
}

int cs_set_cache_read(const cs_set_name *name, cs_u32 *words)
{
    char path[PATH_SIZE];
    size_t length = 0;
    const size_t count = 2 * (size_t)name->count;
    set_head head;
    FILE *file = find_path(name, path, &length) ? fopen(path, "rb") : NULL;
    if (file == NULL) return 0;
    int good = fread(&head, sizeof head, 1, file) == 1 &&
               fread(words, sizeof *words, count, file) == count && fgetc(file) == EOF;
    fclose(file);
    if (!good) return 0;
    const set_head expected = head_of(name, words);
    return memcmp(&head, &expected, sizeof head) == 0;
}

void cs_set_cache_write(const cs_set_name *name, const cs_u32 *words)
{
    char path[PATH_SIZE];
    size_t length = 0;
    const size_t count = 2 * (size_t)name->count;
    const set_head head = head_of(name, words);
    cs_output_file file = {0};
    if (!find_path(name, path, &length)) return;
    path[length] = '\0';
    if (cs_make_folders(path) != 0) return;
    path[length] = '/';
    if (cs_output_open(path, &file) != 0) return;
    const int good = fwrite(&head, sizeof head, 1, file.stream) == 1 &&
                     fwrite(words, sizeof *words, count, file.stream) == count;
    cs_output_end(&file, good);
}
