#include "helper/limits.h"

#include "import/wall.h"

void cs_limit(int resource, double most)
{
    struct rlimit now;
    if (getrlimit(resource, &now) != 0) return;
    const rlim_t wanted = (rlim_t)most;
    if (now.rlim_cur == RLIM_INFINITY || now.rlim_cur > wanted) now.rlim_cur = wanted;
    setrlimit(resource, &now);
}

cs_limits cs_limits_lower(const char *path)
{
    cs_limits before;
    struct rusage used = {0};
    getrlimit(RLIMIT_AS, &before.memory);
    getrlimit(RLIMIT_CPU, &before.time);
    getrusage(RUSAGE_SELF, &used);
    cs_limit(RLIMIT_AS, cs_import_bytes(path, 1));
    cs_limit(RLIMIT_CPU, cs_import_seconds(path, 1) + (double)used.ru_utime.tv_sec + 1.0);
    return before;
}

void cs_limits_restore(const cs_limits *limits)
{
    setrlimit(RLIMIT_AS, &limits->memory);
    setrlimit(RLIMIT_CPU, &limits->time);
}
