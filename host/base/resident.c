#include "base/resident.h"

#include <stdio.h>
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
