/* Vectors of three coordinates, in single and double precision. */
#ifndef CS_BASE_VEC_H
#define CS_BASE_VEC_H

static inline float cs_vec_dot(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double cs_vec_dot_double(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Luminance of a linear Rec.709 colour; cs_luminance of kernels/vector.h is that of floats. */
static inline double cs_luminance_double(double red, double green, double blue)
{
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/* c = a x b; c must not alias a or b. */
static inline void cs_vec_cross(const float *a, const float *b, float *c)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* c = a x b; c must not alias a or b. */
static inline void cs_vec_cross_double(const double *a, const double *b, double *c)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* d = a - b. */
static inline void cs_vec_subtract(const float *a, const float *b, float *d)
{
    for (int i = 0; i < 3; i++)
        d[i] = a[i] - b[i];
}

/* d = a - b in double precision, which is exact up to one rounding. */
static inline void cs_vec_subtract_double(const float *a, const float *b, double *d)
{
    for (int i = 0; i < 3; i++)
        d[i] = (double)a[i] - (double)b[i];
}

#endif
