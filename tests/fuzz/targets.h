/* What is fuzzed: targets take any bytes and come back. A crash, a hang or a sanitizer's report is
 * a finding. */
#ifndef CS_TESTS_FUZZ_TARGETS_H
#define CS_TESTS_FUZZ_TARGETS_H

#include <stddef.h>
#include <stdint.h>

/* X(name): the function cs_fuzz_NAME, and its first inputs in corpus/NAME/. */
#define CS_FUZZ_TARGET_LIST(X) \
    X(obj)                     \
    X(mtl)                     \
    X(ply)                     \
    X(stl)                     \
    X(off)                     \
    X(three_mf)                \
    X(gltf)                    \
    X(glb)                     \
    X(command_line)            \
    X(settings)                \
    X(points)                  \
    X(checkpoint)              \
    X(merge)                   \
    X(film)

#define CS_FUZZ_DECLARE(name) void cs_fuzz_##name(const uint8_t *data, size_t size);
CS_FUZZ_TARGET_LIST(CS_FUZZ_DECLARE)

/* The path of a file of this name in the process's scratch folder; a constant for each name. */
const char *cs_fuzz_path(const char *name);

/* Writes that file, and returns its path. */
const char *cs_fuzz_file(const char *name, const void *data, size_t size);

#endif
