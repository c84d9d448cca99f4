/* What a program is compiled with. Shared.
 *
 * A scene or a render that needs none of it is rendered by the variant without features, which does
 * not pay for what it does not use. Each variant is compiled when it is first wanted, by
 * -DCS_FEATURES=<bits>. */
#ifndef CS_KERNELS_FEATURES_H
#define CS_KERNELS_FEATURES_H

#define CS_FEATURE_PATHS 1       /* bounces, and both ways to find a light weighted */
#define CS_FEATURE_LIGHTS 2      /* lights besides points, directions and emissive triangles */
#define CS_FEATURE_MATERIALS 4   /* surfaces besides Lambert's; needs PATHS */
#define CS_FEATURE_TEXTURES 8    /* images on surfaces */
#define CS_FEATURE_LOOKUPS 16    /* of which some end, mirror or do not blend; needs TEXTURES */
#define CS_FEATURE_COLOURS 32    /* colours of vertices */
#define CS_FEATURE_AOVS 64       /* channels besides the radiance */
#define CS_FEATURE_MOTION 128    /* samples have times; the camera moves */
#define CS_FEATURE_MOVING 256    /* surfaces move; needs MOTION */
#define CS_FEATURE_EMITTERS 512  /* emissive triangles are chosen by a tree */
#define CS_FEATURE_WIDE 1024     /* rays behind the first surface walk alone; needs PATHS */
#define CS_FEATURE_SAMPLERS 2048 /* point sets besides nets */
#define CS_FEATURE_SETS 4096     /* more than any set of bits */

/* The host sees everything. */
#ifndef CS_FEATURES
#ifdef CS_DEVICE
#define CS_FEATURES 0
#else
#define CS_FEATURES (CS_FEATURE_SETS - 1)
#endif
#endif

#define CS_HAS(feature) ((CS_FEATURES & CS_FEATURE_##feature) != 0)

#endif
