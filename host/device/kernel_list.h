/* The tables of programs and kernels: enumerations, names and checks are made from them. */
#ifndef CS_DEVICE_KERNEL_LIST_H
#define CS_DEVICE_KERNEL_LIST_H

#include "kernels/features.h"
#include "kernels/scene.h"

/* What is compiled at once: X(identifier, text), an array that cmake/EmbedKernels.cmake makes. */
#define CS_PROGRAM_LIST(X)        \
    X(RENDER, cs_kernel_text)     \
    X(ANALYSIS, cs_analysis_text) \
    X(RADIANCE, cs_radiance_text)

/* X(identifier, name, program, arguments): arguments is their number. */
#define CS_KERNEL_LIST(X)                              \
    X(RENDER, cs_render, RENDER, 8 + CS_SCENE_BUFFERS) \
    X(TRACE, cs_trace, RENDER, 8)                      \
    X(POINTS, cs_points, RENDER, 7)                    \
    X(DRAW_SUM, cs_draw_sum, RENDER, 5)                \
    X(EXPONENTIALS, cs_exponentials, ANALYSIS, 7)      \
    X(PERIODOGRAM, cs_periodogram, ANALYSIS, 12)       \
    X(RADIANCE, cs_radiance_at, RADIANCE, 10 + CS_SCENE_BUFFERS)

#define CS_PROGRAM_IDENTIFIER(identifier, text) CS_PROGRAM_##identifier,
#define CS_KERNEL_IDENTIFIER(identifier, name, program, arguments) CS_KERNEL_##identifier,
#define CS_KERNEL_ARGUMENTS(identifier, name, program, arguments) \
    CS_ARGUMENTS_##identifier = arguments,

typedef enum cs_program {
    CS_PROGRAM_LIST(CS_PROGRAM_IDENTIFIER) CS_PROGRAM_COUNT
} cs_program;

typedef enum cs_kernel {
    CS_KERNEL_LIST(CS_KERNEL_IDENTIFIER) CS_KERNEL_COUNT
} cs_kernel;

/* How many arguments each kernel has. */
enum {
    CS_KERNEL_LIST(CS_KERNEL_ARGUMENTS)
};

#endif
