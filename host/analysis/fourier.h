/* Thread safety of FFTW. */
#ifndef CS_ANALYSIS_FOURIER_H
#define CS_ANALYSIS_FOURIER_H

/* Makes FFTW's planner thread-safe. Call it before making or destroying plans, because all plans of
 * a process share one unlocked state. */
void cs_fourier_start(void);

#endif
