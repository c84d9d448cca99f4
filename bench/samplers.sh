#!/bin/bash
# Image error of every sampler with and without shear, as a Markdown table: the mean over pixels and
# colours of the variance of one pattern of N samples, from 8 independent patterns a pixel.
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

flags=("$@")
echo "| sampler | shear |$(for n in $counts; do printf ' N = %d |' "$n"; done)"
echo "|---|---|$(for n in $counts; do printf -- '---|'; done)"
for sampler in $samplers; do
    for shear in none equal-area; do
        line="| $sampler | $shear |"
        for n in $counts; do line="$line $(variance "$sampler" $shear "$n") |"; done
        echo "$line"
    done
done
