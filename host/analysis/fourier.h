/* FFTW for callers in several threads. */
#ifndef CS_ANALYSIS_FOURIER_H
#define CS_ANALYSIS_FOURIER_H

/* To be called before anything that makes or destroys plans: FFTW keeps what it knows of all plans
 * in one place, unguarded unless it is told to. */
void cs_fourier_start(void);

#endif
