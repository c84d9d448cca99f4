/* The table of light kinds: kernels, host and tests expand it. Shared.
 *
 * X(identifier, name, suffix, extent)
 * name: for messages. suffix: cs_sample_light_<suffix> in this folder samples it. extent: DELTA
 * lights shine from one point or direction; AREA lights are sampled by a pair of the tuple. */
#ifndef CS_LIGHT_LIST_H
#define CS_LIGHT_LIST_H

/* Those that every program knows, and those that the feature LIGHTS adds (features.h). */
#define CS_LIGHT_LIST_FEW(X)                          \
    X(POINT, "point", point, DELTA)                   \
    X(DIRECTIONAL, "directional", directional, DELTA) \
    X(TRIANGLES, "emissive triangles", triangles, AREA)
#define CS_LIGHT_LIST_MORE(X)         \
    X(SPOT, "spot", spot, DELTA)      \
    X(SUN, "sun", sun, AREA)          \
    X(SPHERE, "sphere", sphere, AREA) \
    X(QUAD, "quad", quad, AREA)       \
    X(ENVIRONMENT, "environment", environment, AREA)
#define CS_LIGHT_LIST(X) \
    CS_LIGHT_LIST_FEW(X) \
    CS_LIGHT_LIST_MORE(X)

#define CS_LIGHT_IDENTIFIER(identifier, name, suffix, extent) CS_LIGHT_##identifier,

enum {
    CS_LIGHT_LIST(CS_LIGHT_IDENTIFIER) CS_LIGHT_KINDS
};

#endif
