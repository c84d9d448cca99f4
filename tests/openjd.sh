#!/bin/bash
# The job template of Open Job Description: openjd.sh PROGRAM ROOT SCRATCH. It is valid, and a session of
# openjd (of the Python package openjd-cli, on the PATH or in $OPENJD) that runs it makes the picture of
# its shards. Exit 77: there is no openjd here.
set -eu
program=$(realpath "$1") root=$2 scratch=$3
openjd=${OPENJD:-openjd}
command -v "$openjd" >/dev/null || { echo "no openjd"; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch/a folder"
cd "$scratch"
"$openjd" check "$root/scripts/openjd/render.yaml"
"$openjd" run "$root/scripts/openjd/render.yaml" -p Scene="$root/scenes/cornell.obj" \
    -p Out="$scratch/a folder/img.exr" -p Shards=3 -p Program="$program" \
    -p Flags='--width 32 --height 32 --spp 48 --oracle centre' >openjd.log || { cat openjd.log; exit 1; }
for k in 1 2 3; do
    "$program" "$root/scenes/cornell.obj" --width 32 --height 32 --spp 48 --oracle centre \
        --shard $k/3 --quiet --out $k.exr
done
"$program" merge 3.exr 1.exr 2.exr --out right.exr
hash_of() { iinfo --hash "$1" | grep -o '[0-9A-F]\{40\}'; }
[ "$(hash_of right.exr)" = "$(hash_of 'a folder/img.exr')" ] || { echo "another picture"; exit 1; }
echo "all as expected"
