/* The table of light kinds: kernels, host and tests expand it. Shared.
 *
 * X(identifier, name, suffix, extent)
 * name: for messages. suffix: cs_sample_light_<suffix> in this folder samples it. extent: DELTA
 * lights shine from one point or direction; AREA lights are sampled by a pair of the tuple. */
#ifndef CS_LIGHT_LIST_H
#define CS_LIGHT_LIST_H

#define CS_LIGHT_LIST(X)                              \
    X(POINT, "point", point, DELTA)                   \
    X(DIRECTIONAL, "directional", directional, DELTA) \
    X(TRIANGLES, "emissive triangles", triangles, AREA)

#define CS_LIGHT_IDENTIFIER(identifier, name, suffix, extent) CS_LIGHT_##identifier,

enum {
    CS_LIGHT_LIST(CS_LIGHT_IDENTIFIER) CS_LIGHT_KINDS
};

#endif
