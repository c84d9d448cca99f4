#!/bin/sh
# Fuzzes targets (targets.h; without names, all of them) with clang's libFuzzer under sanitizers for
# SECONDS of processor time each (120). Builds in build-fuzz/ of the project, and keeps there what
# was found: corpus_NAME, and files with the inputs that failed. CS_FUZZ_SEEDS may name a folder with
# more first inputs, NAME/FILE; CS_FUZZ_TIMEOUT the seconds of the clock that an input may take (60).
# ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1 looks for leaks, too.
# usage: tests/fuzz/run.sh [SECONDS [TARGET...]]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
seconds=${1:-120}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- obj mtl ply stl off three_mf gltf glb command_line settings points checkpoint merge film
seeds=${CS_FUZZ_SEEDS:+$(cd "$CS_FUZZ_SEEDS" && pwd)}
flags="-g -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined"
cmake -S "$root" -B "$root/build-fuzz" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCLSHEAR_FUZZ=ON \
    -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 \
    -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" >/dev/null
cd "$root/build-fuzz"
ninja fuzz >build.log || { tail -n 40 build.log; exit 1; }
# Drivers keep what they have until the end.
export ASAN_OPTIONS="${ASAN_OPTIONS:-detect_leaks=0:allocator_may_return_null=1}"
# Each input is a file: in memory, where that is possible.
TMPDIR=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d)
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# Sets `spent` to the processor time, in whole seconds, of the ended children of this shell. (A
# subshell would have none.)
count_seconds() {
    times >"$TMPDIR/times"
    spent=$(tail -n 1 "$TMPDIR/times" | tr 'ms' '  ' | awk '{ print int($1 * 60 + $2 + $3 * 60 + $4) }')
}

for name in "$@"; do
    mkdir -p "corpus_$name"
    cp "$root/tests/fuzz/corpus/$name"/* "corpus_$name"/
    [ -z "$seeds" ] || [ ! -d "$seeds/$name" ] || cp "$seeds/$name"/* "corpus_$name"/
    ln -sf tests/fuzz/fuzz "fuzz_$name"
    words="$root/tests/fuzz/dictionaries/$name"
    words=${words:+$([ ! -f "$words" ] || echo "-dict=$words")}
    # libFuzzer counts the clock's time, which is another on a busy machine.
    count_seconds
    begun=$spent
    used=0
    inputs=0
    while [ "$used" -lt "$seconds" ]; do
        "./fuzz_$name" -max_total_time=$((seconds - used)) -max_len=4096 -timeout="${CS_FUZZ_TIMEOUT:-60}" \
            -rss_limit_mb=4096 -print_final_stats=1 -close_fd_mask=1 ${words:+"$words"} \
            -artifact_prefix="$name-" "corpus_$name" >"$name.log" 2>&1 || {
            tail -n 40 "$name.log"
            exit 1
        }
        inputs=$((inputs + $(sed -n 's/^stat::number_of_executed_units: *//p' "$name.log")))
        count_seconds
        used=$((spent - begun))
    done
    echo "$name: $inputs inputs in $used s of processor time, $(find "corpus_$name" -type f | wc -l) in the corpus"
done
