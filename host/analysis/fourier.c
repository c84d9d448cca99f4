#include "analysis/fourier.h"

#include <fftw3.h>
#include <pthread.h>

static pthread_once_t started = PTHREAD_ONCE_INIT;

void cs_fourier_start(void)
{
    pthread_once(&started, fftw_make_planner_thread_safe);
}
