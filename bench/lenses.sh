#!/bin/bash
# What apertures and filters cost and gain, as a Markdown table: seconds of the kernels and variance of
# the image without and with the equal-area shear (rule centre), in turn; medians of the rounds.
#
# bench/lenses.sh [ROUNDS [SIZE [SPP]]]
set -eu
rounds=${1:-3} size=${2:-192} spp=${3:-1024}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
oiiotool --create 64x64 1 --fill:color=0 64x64 --box:color=1:fill=1 8,8,40,56 \
    --line:color=0.5 0,0,63,63 -o "$folder/shape.exr"

# run SHEAR FLAGS...: seconds and variance
run() {
    local shear=$1
    shift
    build/clshear scenes/cornell.obj --width "$size" --height "$size" --spp "$spp" --oracle centre --adaptive=0 \
        --shear "$shear" --quiet --stats "$@" --out "$folder/image.exr" |
        awk '/^kernels/ { s = $2 } /^variance/ { print s, $2 }'
}

run none --aperture square >/dev/null # warms up
echo "| aperture and filter | s, none | s, sheared | variance, none | sheared | gain | gain at equal time |"
echo "|---|---|---|---|---|---|---|"
while read -r line; do
    read -ra flags <<<"${line//SHAPE/$folder/shape.exr}"
    for _ in $(seq "$rounds"); do
        echo "$(run none "${flags[@]}") $(run equal-area "${flags[@]}")"
    done | sort -n -k3 | awk -v name="$line" '{ row[NR] = $0 }
        END { split(row[int((NR + 1) / 2)], v, " ")
            printf "| `%s` | %.2f | %.2f | %.2e | %.2e | %.1f | %.1f |\n", name, v[1], v[3], v[2],
                v[4], v[2] / v[4], v[2] / v[4] * v[1] / v[3] }'
done <<'END'
--aperture square
--aperture disk
--anamorphic 2
--blades 6
--aperture SHAPE
--aperture square --filter tent
--aperture square --filter blackman-harris
--aperture disk --filter gaussian
--blades 6 --filter gaussian
--aperture SHAPE --filter gaussian
END
