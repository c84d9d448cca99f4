#!/bin/bash
# What is installed is enough: the examples and a C++ program compile with the installed headers and
# library alone, run, and do what they say.
set -eu
root=$1 build=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
cmake --install "$build" --prefix "$PWD/installed" >/dev/null
cp "$root"/examples/*.c "$root"/scenes/cornell.* .
PKG_CONFIG_PATH=$(dirname "$(find "$PWD/installed" -name clshear.pc)")
export PKG_CONFIG_PATH
LD_LIBRARY_PATH=$(pkg-config --variable=libdir clshear)
export LD_LIBRARY_PATH
read -ra flags <<<"$(pkg-config --cflags clshear)"
read -ra libraries <<<"$(pkg-config --libs clshear)"
c=(-std=c17 -O2 -Wall -Wextra -Werror -ffp-contract=off "${flags[@]}")

# By the command in the head of each, which guides repeat.
for example in own_kernel embree_lens; do
    command=$(sed -n 's/^ \*     \(cc .*\)/\1/p' $example.c)
    if grep -h "^    cc .* $example.c " "$root"/docs/guide/*.md | grep -vxF "    $command"; then
        echo "$example.c: a guide compiles it by another command than its head"
        exit 1
    fi
    eval "$command -O2 -Wall -Wextra -Werror -o $example"
    ./$example
done
cc "${c[@]}" render.c -o render "${libraries[@]}"
./render cornell.obj out.exr >/dev/null

# Every public header compiles by itself.
for header in installed/include/clshear/*.h; do
    echo "#include <clshear/${header##*/}>" | cc "${c[@]}" -x c -fsyntax-only -
done

# C++: every public header, and words that agree with the functions.
{
    (cd installed/include && find clshear -maxdepth 1 -name '*.h' | sort | sed 's/.*/#include <&>/')
    (cd installed/include && find clshear/device -name '*.h' | sort | sed 's/.*/#include <&>/')
    cat <<'END'
#include <cstdio>
int main()
{
    clshear_pattern *pattern = nullptr;
    cs_pattern constants;
    size_t words;
    if (clshear_pattern_create("halton", 100, CLSHEAR_ORDER_COHERENT, &pattern) != CLSHEAR_OK ||
        clshear_pattern_constants(pattern, &constants, sizeof constants) != CLSHEAR_OK) {
        std::puts(clshear_message());
        return 1;
    }
    const uint32_t *table = clshear_pattern_table(pattern, &words);
    double sum = 0.0;
    for (cs_u32 i = 0; i < constants.grid.count; i++) {
        float tuple[CS_DIMENSIONS];
        cs_draw_all(&constants, table, cs_pattern_key(1, 2, 3), i, tuple);
        for (float coordinate : tuple)
            sum += coordinate;
    }
    const double mean = sum / (constants.grid.count * CS_DIMENSIONS);
    std::printf("C++: mean coordinate %.3f\n", mean);
    clshear_pattern_free(pattern);
    return mean > 0.48 && mean < 0.52 ? 0 : 1;
}
END
} >consumer.cpp
c++ -std=c++17 -O2 -Wall -Wextra -Werror -ffp-contract=off "${flags[@]}" consumer.cpp -o consumer "${libraries[@]}"
./consumer

# OpenCL C: the installed headers by -I, where there is a compiler for it.
clang=$(command -v clang || command -v clang-14 || true)
if [ -n "$clang" ]; then
    echo '#include "clshear/device/shear.h"' >stranger.cl
    "$clang" -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Werror \
        -I installed/include stranger.cl
fi
echo "installed tree checked"
