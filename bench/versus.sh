#!/bin/bash
# The frame of this tree against that of another commit, on an idle machine: bench/versus.sh COMMIT
# [ROUNDS]. Both are built the same way and render in turn; printed is the median over rounds of the
# time on the device before, divided by the time now. Above 1: this tree is faster.
set -eu
[ $# -ge 1 ] || { echo "usage: bench/versus.sh COMMIT [ROUNDS]" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
rounds=${2:-7}
scratch=$(mktemp -d)
trap 'git -C "$root" worktree remove --force "$scratch/before" 2>/dev/null; rm -rf "$scratch"' EXIT
git -C "$root" worktree add --quiet --detach "$scratch/before" "$1"
"$root/scripts/build"
"$scratch/before/scripts/build"

# kernel_s TREE FLAGS...: seconds on the device for the tree's own Cornell box, whose settings each
# tree's program knows
kernel_s() {
    local tree=$1
    shift
    "$tree/build/clshear" "$tree/scenes/cornell.obj" "$@" --adaptive=0 --quiet --stats --out "$scratch/frame.exr" | awk '$1 == "kernels" { print $2 }'
}

compare() {
    local title=$1 before now
    shift
    kernel_s "$scratch/before" "$@" >/dev/null # compiles
    kernel_s "$root" "$@" >/dev/null
    for _ in $(seq "$rounds"); do
        before=$(kernel_s "$scratch/before" "$@")
        now=$(kernel_s "$root" "$@")
        echo "$before $now"
    done | awk -v title="$title" '{ print $1 / $2, title }' | sort -g |
        awk '{ ratio[NR] = $1; $1 = ""; title = $0 } END {
            printf "|%s | %.3f | %.3f ... %.3f |\n", title, ratio[int((NR + 1) / 2)], ratio[1], ratio[NR] }'
}

echo "| frame | before / now | range |"
echo "|---|---|---|"
compare "square" --width 256 --height 256 --spp 256
compare "disk" --width 256 --height 256 --spp 256 --aperture disk
compare "disk, 16 samples" --width 512 --height 512 --spp 16 --aperture disk
compare "hexagon, gaussian" --width 128 --height 128 --spp 256 --blades 6 --filter gaussian
compare "one lane" --width 128 --height 128 --spp 64 --packet 1
