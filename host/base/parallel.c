#define _GNU_SOURCE /* sched_getaffinity */
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

enum {
    MAX_THREADS = 256,
    RANGES_PER_THREAD = 16
};

typedef struct loop {
    atomic_size_t next;
    size_t count;
    size_t step;
    void (*body)(void *user, size_t begin, size_t end);
    void *user;
} loop;

static void *run_ranges(void *argument)
{
    loop *work = argument;
    for (;;) {
        size_t begin = atomic_fetch_add(&work->next, work->step);
        if (begin >= work->count) return NULL;
        size_t end = work->count - begin < work->step ? work->count : begin + work->step;
        work->body(work->user, begin, end);
    }
}

int cs_core_count(void)
{
    cpu_set_t allowed; /* has no room for all of a very large machine */
    const int is_known = sched_getaffinity(0, sizeof allowed, &allowed) == 0;
    const long cores = is_known ? CPU_COUNT(&allowed) : sysconf(_SC_NPROCESSORS_ONLN);
    if (cores < 1) return 1;
    if (cores > MAX_THREADS) return MAX_THREADS;
    return (int)cores;
}

void cs_parallel(int threads, size_t count, void (*body)(void *user, size_t begin, size_t end),
                 void *user)
{
    pthread_t started[MAX_THREADS];
    int extra = 0;
    if (threads <= 0) threads = cs_core_count();
    if (threads > MAX_THREADS) threads = MAX_THREADS;
    loop work = {.count = count, .body = body, .user = user};
    work.step = count / ((size_t)threads * RANGES_PER_THREAD) + 1;
    while (extra < threads - 1 && pthread_create(&started[extra], NULL, run_ranges, &work) == 0)
        extra++;
    run_ranges(&work);
    for (int i = 0; i < extra; i++)
        pthread_join(started[i], NULL);
}
