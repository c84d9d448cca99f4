#!/bin/bash
# The table of docs/notes/oracle.md on --adaptive: image error with samples shared out evenly and by need, on the
# scenes of scripts/oracle and, for the Cornell box, at larger sizes. SMALL=1 leaves those out, which
# take most of a quarter of an hour (2048 x 2048: 2 GB of renders).
# bench/adaptive.sh [SEEDS [FOLDER]]
set -eu
cd "$(dirname "$0")/.."
seeds=${1:-8} folder=${2:-build/adaptive}
scripts/scenes "$folder"

# row SEEDS SIZE SPP NAME FLAGS...
row() {
    local seeds=$1 size=$2 spp=$3 name=$4
    shift 4
    local scene=("$folder/$name.obj" --width "$size" --height "$size" --spp "$spp" --quiet "$@")
    for seed in $(seq "$seeds"); do
        build/clshear "${scene[@]}" --seed "$seed" --adaptive=0 --out "$folder/even-$seed.exr"
        build/clshear "${scene[@]}" --seed "$seed" --adaptive --out "$folder/shared-$seed.exr"
    done
    printf '\n%s, %s x %s pixels, %s samples\n\n' "$name $*" "$size" "$size" "$spp"
    build/bench/bench_noise even - "$folder"/even-*.exr + adaptive even "$folder"/shared-*.exr
    rm -f "$folder"/even-*.exr "$folder"/shared-*.exr
}

for spp in 256 1024; do
    row "$seeds" 128 $spp cornell --focal-distance 700
    row "$seeds" 128 $spp cornell
    row "$seeds" 128 $spp cornell --focal-distance 1250
    row "$seeds" 128 $spp bunny
    row "$seeds" 128 $spp fence
    row "$seeds" 128 $spp flat
done
[ -z "${SMALL:-}" ] || exit 0
row 3 512 1024 cornell
row 2 1024 1024 cornell
row 2 2048 1024 cornell
