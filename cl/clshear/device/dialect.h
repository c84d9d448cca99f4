/* The only file that asks which language it is compiled as: OpenCL C (1.2 or later), C17 or C++17.
 *
 * All headers of this folder compile as all of these, so that a host runs the very text that its
 * device runs. They use the names defined here and nothing else that differs. Every name begins
 * with cs_ or CS_, every include guard with CLSHEAR_DEVICE_. */
#ifndef CLSHEAR_DEVICE_DIALECT_H
#define CLSHEAR_DEVICE_DIALECT_H

#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#define CS_DEVICE 1

typedef uint cs_u32;
typedef int cs_i32;
typedef float cs_f32;
#define CS_GLOBAL __global

#else

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef uint32_t cs_u32;
typedef int32_t cs_i32;
typedef float cs_f32;
#define CS_GLOBAL

#if defined(CS_PACKET) && CS_PACKET != 1
#error "CS_PACKET must be 1 on the host, or not be defined at all"
#endif

#endif

/* Samples that one work-item computes at once, each in a lane of a vector: 1, 4, 8 or 16. One width
 * holds for a whole program. Define it before the first include, or by -DCS_PACKET=8. CPUs are
 * fastest with the width of their registers, GPUs with 1, which is the default. */
#ifndef CS_PACKET
#define CS_PACKET 1
#endif

/* Marks a function as always inlined: its loops need the constant arguments of its caller. Left as
 * calls, such functions take twice the time. With CS_NO_INLINING they are: for Oclgrind, which does
 * not know all that inlining leaves behind. */
#ifdef CS_NO_INLINING
#define CS_INLINED static inline
#else
#define CS_INLINED static inline __attribute__((always_inline))
#endif

/* Fails to compile unless `type` is `words` 4-byte words long. A struct made of 4-byte scalars has
 * no padding, so equal sizes on host and device fix every offset. */
#define CS_SHARED_WORDS(type, words) typedef char type##_words[sizeof(type) == 4 * (words) ? 1 : -1]

#define CS_PI 3.14159265358979f
#define CS_INVERSE_PI 0.318309886f

#endif
