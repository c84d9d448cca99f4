/* Limits on memory and processor time of this process. */
#ifndef CS_HELPER_LIMITS_H
#define CS_HELPER_LIMITS_H

#include <sys/resource.h>

/* Lowers the limit of a resource (RLIMIT_...) to `most`, if it is higher. */
void cs_limit(int resource, double most);

typedef struct cs_limits {
    struct rlimit memory;
    struct rlimit time;
} cs_limits;

/* Lowers both limits to what a library of others may take, from now on, to read the scene file
 * `path`. Returns what they were before. */
cs_limits cs_limits_lower(const char *path);
void cs_limits_restore(const cs_limits *limits);

#endif
