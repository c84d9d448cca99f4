/* Loops over all cores. */
#ifndef CS_BASE_PARALLEL_H
#define CS_BASE_PARALLEL_H

#include <stddef.h>

/* Calls `body` for consecutive ranges that together cover [0, count), from up to `threads` threads
 * (0: one for each core). Falls back to fewer threads when no more can be started. */
void cs_parallel(int threads, size_t count, void (*body)(void *user, size_t begin, size_t end),
                 void *user);

/* Cores of this machine. */
int cs_core_count(void);

#endif
