/* Where the program clshear-import is, and what it may take. */
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "import/find_file.h"
#include "import/wall.h"

static int is_program(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && S_ISREG(about.st_mode) && access(path, X_OK) == 0;
}

int cs_find_helper(char *path)
{
    /* From the folder of the library or program that holds this code: installed, or just built. */
    static const char *const beside[] = {CLSHEAR_HELPER_FROM_LIBRARY "/clshear-import",
                                         "clshear-import", "../clshear-import"};
    const char *chosen = getenv("CLSHEAR_IMPORT");
    char folder[CS_HELPER_PATH];
    Dl_info here;
    if (chosen != NULL) {
        snprintf(path, CS_HELPER_PATH, "%s", chosen);
        return is_program(path);
    }
    if (dladdr(CLSHEAR_HELPER_FROM_LIBRARY, &here) != 0 && here.dli_fname != NULL) {
        cs_folder_of(here.dli_fname, folder, sizeof folder);
        for (size_t i = 0; i < sizeof beside / sizeof *beside; i++) {
            const int length = snprintf(path, CS_HELPER_PATH, "%s%s", folder, beside[i]);
            if (length < CS_HELPER_PATH && is_program(path)) return 1;
        }
    }
    snprintf(path, CS_HELPER_PATH, "%s", CLSHEAR_HELPER_INSTALLED "/clshear-import");
    return is_program(path);
}

static double megabytes_of(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 ? (double)about.st_size / 1e6 : 0.0;
}

double cs_import_seconds(const char *path, int by_others)
{
    const double megabytes = megabytes_of(path);
    return by_others ? 10.0 + megabytes : 600.0 + 10.0 * megabytes; /* textures take theirs */
}

double cs_import_bytes(const char *path, int by_others)
{
    const double all = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const double wanted = 2e9 + 100e6 * megabytes_of(path);
    return by_others && wanted < all ? wanted : all;
}
