#!/bin/sh
# Fuzzes the readers of scene files with clang's libFuzzer, SECONDS each (120), in a scratch folder.
# Images are left to their library: its place has a stand-in.
# usage: tests/fuzz/run.sh BUILD [SECONDS [FORMAT...]]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
seconds=${2:-120}
shift; [ $# -gt 0 ] && shift
scratch=$(mktemp -d)
cd "$scratch"
flags="-g -O1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -D_XOPEN_SOURCE=700
    -DCLSHEAR_BUILDING -DCLSHEAR_HELPER_FROM_LIBRARY=\"x\" -DCLSHEAR_HELPER_INSTALLED=\"x\"
    -I$root/include -I$root/cl -I$root/host -I$build/generated"
for file in "$root"/host/import/*.c "$root"/host/scene/light.c "$root"/host/scene/material.c \
    "$root"/host/scene/scene.c "$root"/host/scene/standard.c "$root"/host/scene/texture.c \
    "$root"/host/image/texel_kinds.c "$root"/host/base/array.c \
    "$root"/host/base/status.c "$root"/host/base/output_file.c "$root"/tests/fuzz/no_images.c; do
    # shellcheck disable=SC2086
    clang-14 $flags -c "$file" -o "$(basename "$file").o"
done
# shellcheck disable=SC2086
clang++-14 $flags -std=c++17 -c "$root/host/base/number.cpp" -o number.o
for format in "${@:-obj}" $( [ $# -gt 0 ] || echo mtl ply stl gltf glb ); do
    # shellcheck disable=SC2086
    clang-14 $flags -DCS_FUZZ_SUFFIX="\"$format\"" -c "$root/tests/fuzz/fuzz_import.c" -o target.o
    clang++-14 -fsanitize=fuzzer,address,undefined ./*.o -ljansson -lpthread -ldl -lm -o "fuzz_$format"
    mkdir -p "corpus_$format"
    cp "$root"/tests/fuzz/corpus/*."$format" "corpus_$format"/
    echo "$format"
    "./fuzz_$format" -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 "corpus_$format" \
        >"$format.log" 2>&1 || { tail -n 40 "$format.log"; echo "artifacts are in $scratch"; exit 1; }
    grep -E "stat::(number_of_executed|average_exec)" "$format.log"
done
rm -rf "$scratch"
