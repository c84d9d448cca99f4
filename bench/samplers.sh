#!/bin/bash
# Image error of every sampler with and without shear, as a Markdown table: the mean over pixels and
# colours of the variance of one pattern of N samples, from 8 independent patterns a pixel; and the
# slope of its logarithm over that of N.
#
# bench/samplers.sh [-p PROGRAM] [-s SCENE] [-n "16 64 ..."] [-x "SAMPLER ..."] [-- FLAGS...]
set -eu
program=build/clshear scene=scenes/cornell.obj counts="16 64 256 1024 4096" samplers=
while getopts p:s:n:x: flag; do
    case $flag in
    p) program=$OPTARG ;;
    s) scene=$OPTARG ;;
    n) counts=$OPTARG ;;
    x) samplers=$OPTARG ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ -n "$samplers" ] || samplers=$("$program" --list-samplers | awk '{ print $1 }')
image=$(mktemp --suffix=.exr)
trap 'rm -f "$image"' EXIT

# variance SAMPLER SHEAR N: of one pattern
variance() {
    "$program" "$scene" --width 128 --height 128 --replicates 8 --spp $((8 * $3)) --sampler "$1" \
        --shear "$2" --quiet --stats --out "$image" "${flags[@]}" |
        awk '/^variance/ { printf "%.2e", 8 * $2 }'
}

# slope N VARIANCE N VARIANCE ...: by least squares in logarithms
slope() {
    echo "$@" | awk '{ for (i = 1; i < NF; i += 2) { x = log($i); y = log($(i + 1)); n++
        sx += x; sy += y; sxx += x * x; sxy += x * y }
        printf "%.2f", (n * sxy - sx * sy) / (n * sxx - sx * sx) }'
}

flags=("$@")
echo "| sampler | shear |$(for n in $counts; do printf ' N = %d |' "$n"; done) slope |"
echo "|---|---|$(for n in $counts; do printf -- '---|'; done)---|"
for sampler in $samplers; do
    for shear in none equal-area; do
        line="| $sampler | $shear |"
        points=
        for n in $counts; do
            value=$(variance "$sampler" $shear "$n")
            line="$line $value |" points="$points $n $value"
        done
        echo "$line $(slope $points) |"
    done
done
