#include "device/slow_driver.h"

#include <errno.h>
#include <pthread.h>
#include <time.h>

enum {
    PATIENCE_S = 5
};

typedef struct task {
    clshear_status (*work)(void *user);
    void *user;
    clshear_status status;
    int is_done;
    pthread_mutex_t lock; /* of is_done */
    pthread_cond_t done;
} task;

static void *run_task(void *user)
{
    task *run = user;
    run->status = run->work(run->user);
    pthread_mutex_lock(&run->lock);
    run->is_done = 1;
    pthread_cond_signal(&run->done);
    pthread_mutex_unlock(&run->lock);
    return NULL;
}

/* Returns 1 if the task is done before the patience ends, else 0. */
static int wait_for(task *run)
{
    struct timespec end;
    clock_gettime(CLOCK_MONOTONIC, &end);
    end.tv_sec += PATIENCE_S;
    int code = 0;
    pthread_mutex_lock(&run->lock);
    while (!run->is_done && code != ETIMEDOUT)
        code = pthread_cond_timedwait(&run->done, &run->lock, &end);
    const int is_done = run->is_done;
    pthread_mutex_unlock(&run->lock);
    return is_done;
}

clshear_status cs_run_patiently(clshear_status (*work)(void *user), void *user, const char *device,
                                const cs_log *log)
{
    task run = {.work = work, .user = user};
    pthread_t thread;
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&run.lock, NULL);
    pthread_cond_init(&run.done, &monotonic);
    pthread_condattr_destroy(&monotonic);
    if (log == NULL || pthread_create(&thread, NULL, run_task, &run) != 0) {
        run.status = work(user);
    } else {
        if (!wait_for(&run))
            cs_warn(log, "%s: its driver is compiling the kernels, which may take minutes", device);
        pthread_join(thread, NULL);
    }
    pthread_cond_destroy(&run.done);
    pthread_mutex_destroy(&run.lock);
    return run.status;
}
