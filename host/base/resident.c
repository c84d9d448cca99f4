#include "base/resident.h"

#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

size_t cs_resident_bytes(void)
{
    size_t whole = 0, resident = 0;
    FILE *stream = fopen("/proc/self/statm", "r"); /* Linux: in pages */
    if (stream == NULL) return 0;
    if (fscanf(stream, "%zu %zu", &whole, &resident) != 2) resident = 0;
    fclose(stream);
    return resident * (size_t)sysconf(_SC_PAGESIZE);
}

size_t cs_address_limit(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return 0;
    return (size_t)limit.rlim_cur;
}

size_t cs_open_file_limit(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return 0;
    return (size_t)limit.rlim_cur;
}
