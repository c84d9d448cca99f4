/* Amounts of memory that parts of a render say they take. */
#ifndef CS_RENDER_FOOTPRINT_H
#define CS_RENDER_FOOTPRINT_H

/* Bytes, of a pixel or of everything, on the host and on the device. */
typedef struct cs_footprint {
    double host;
    double device;
} cs_footprint;

static inline double cs_footprint_total(cs_footprint of)
{
    return of.host + of.device;
}

static inline cs_footprint cs_footprint_sum(cs_footprint a, cs_footprint b)
{
    return (cs_footprint){a.host + b.host, a.device + b.device};
}

/* The one that is more in total. */
static inline cs_footprint cs_footprint_larger(cs_footprint a, cs_footprint b)
{
    return cs_footprint_total(a) > cs_footprint_total(b) ? a : b;
}

#endif
