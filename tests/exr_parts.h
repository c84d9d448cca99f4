/* EXR files of several parts, which clshear reads and does not write. */
#ifndef CS_TESTS_EXR_PARTS_H
#define CS_TESTS_EXR_PARTS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A part of one texel: its channels, separated by commas, all have the value. */
typedef struct test_exr_part {
    const char *name;
    const char *channels;
    float value;
} test_exr_part;

/* Writes a file; returns 0, with a line printed, where that fails. */
int test_write_exr_parts(const char *path, const test_exr_part *parts, size_t count);

#ifdef __cplusplus
}
#endif

#endif
