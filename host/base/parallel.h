/* Parallel loops on the host. */
#ifndef CS_BASE_PARALLEL_H
#define CS_BASE_PARALLEL_H

#include <stddef.h>

/* Calls `body` on consecutive ranges that together cover [0, count). Uses up to `threads` threads
 * (0: one per core), or fewer if the system refuses to start more. */
void cs_parallel(int threads, size_t count, void (*body)(void *user, size_t begin, size_t end),
                 void *user);

/* The number of cores that the calling thread may run on, 1 to 256. Threads that it starts may run
 * on the same ones. */
int cs_core_count(void);

#endif
