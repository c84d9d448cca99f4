#!/bin/sh
# Fuzzes what clshear reads of its own: settings files, and the metadata of shards that are merged.
# usage: tests/fuzz/run_own.sh BUILD [SECONDS]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
seconds=${2:-120}
scratch=$(mktemp -d)
cd "$scratch"
flags="-g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -D_XOPEN_SOURCE=700
    -DCLSHEAR_BUILDING -I$root/include -I$root/cl -I$root/host -I$build/generated"
base="$root/host/base/array.c $root/host/base/message.c $root/host/base/status.c $root/host/image/tone.c"
# shellcheck disable=SC2086
{
    clang++-14 $flags -std=c++17 -c "$root/host/base/number.cpp" -o number.o
    clang-14 $flags "$root/tests/fuzz/fuzz_merge.c" $base "$root/host/film/film.c" "$root/host/film/merge.c" \
        "$root/host/film/recipe_difference.c" "$root/host/film/shards.c" -lm -lpthread -o fuzz_merge
    for file in "$root"/host/settings/*.c "$root"/host/optics/*.c $base "$root/tests/fuzz/fuzz_settings.c"; do
        clang-14 $flags -c "$file" -o "$(basename "$file").o"
    done
    clang++-14 -fsanitize=fuzzer,address,undefined ./*.o -lm -lpthread -o fuzz_settings
}
mkdir corpus_merge corpus_settings
cp "$root"/scenes/*.flags corpus_settings/
printf '%s\n' 'spp 3' 'light 1,2,3,4,5,6' 'aperture disk' 'shard 1/7' '# note' '--noise=0.1' >corpus_settings/some
python3 - <<'END'
import struct
def film(shard):
    return struct.pack("<HB", 0x7f80 | 127, 2) + struct.pack("<30f", *([1.0] * 30)) + shard + b"\nseed=0;fov=1\n"
open("corpus_merge/two", "wb").write(film(b"1/3") + film(b"2-3/3"))
open("corpus_merge/same", "wb").write(film(b"1/3") + film(b"1,3/3"))
END
for target in merge settings; do
    echo "$target"
    "./fuzz_$target" -max_total_time="$seconds" -max_len=2048 -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 \
        "corpus_$target" >"$target.log" 2>&1 || { tail -n 40 "$target.log"; echo "artifacts are in $scratch"; exit 1; }
    grep -E "stat::(number_of_executed|average_exec)" "$target.log"
done
rm -rf "$scratch"
