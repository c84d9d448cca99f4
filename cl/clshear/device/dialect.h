/* The only file that asks which language it is compiled as: OpenCL C 1.2 or C17.
 *
 * Headers marked "shared" in docs/architecture.md are compiled as both, so that the host runs the
 * very text of the kernels. They use the names defined here and nothing else that differs. */
#ifndef CS_DIALECT_H
#define CS_DIALECT_H

#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#define CS_DEVICE 1

/* Without this the device fuses multiply-adds that the host does not, and nearly half of all tuples
 * differ in the last bit. Where fusing pays, the code says fma. */
#pragma OPENCL FP_CONTRACT OFF

typedef uint cs_u32;
typedef int cs_i32;
typedef float cs_f32;
#define CS_GLOBAL __global

#ifndef CS_PACKET
#error "CS_PACKET (lanes in a packet: 1, 4, 8 or 16) must be given on the command line"
#endif

#else

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef uint32_t cs_u32;
typedef int32_t cs_i32;
typedef float cs_f32;
#define CS_GLOBAL
#define CS_PACKET 1 /* the host computes one lane at a time */

#endif

/* For functions whose loops must know what the caller passes as a constant: compilers would leave
 * them as calls, which here cost twice the time. Everywhere else they choose well. */
#define CS_INLINED static inline __attribute__((always_inline))

/* Fails to compile when `type` is not `words` 4-byte words long: a shared struct made of 4-byte
 * scalars has no padding, so equal sizes on both sides fix every offset. */
#define CS_SHARED_WORDS(type, words) typedef char type##_words[sizeof(type) == 4 * (words) ? 1 : -1]

#define CS_PI 3.14159265358979f
#define CS_INVERSE_PI 0.318309886f

#endif
