#!/bin/bash
# What a render costs against triangles, samples, pixels, blur and threads: build/bench/scaling.json,
# a table on standard output, and docs/notes/performance/*.png. Takes a quarter of an hour on an idle
# machine and 12 GiB; SMALL=1 leaves out what takes long.
# bench/scaling.sh [FOLDER]
set -eu
cd "$(dirname "$0")/.."
folder=${1:-docs/notes/performance}
mkdir -p "$folder"
json=build/bench/scaling.json work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: >"$json"

# value NAME: a number of the last record
value() { tail -n 1 "$json" | sed "s/.*\"$1\": \([^,}]*\).*/\1/"; }

# run FILE X FLAGS...: one job; appends x, ns per sample, kernel, render, prepass, build, load, MB
run() {
    local file=$1 x=$2
    shift 2
    build/bench/bench_render --oracle centre --json "$json" "$@" >/dev/null
    echo "$x $(awk "BEGIN { print 1e3 / $(value msamples_per_s) }") $(value kernels_s) $(value render_s) \
$(value prepass_s) $(value build_s) $(value load_s) $(value memory_mb)" >>"$work/$file"
}

triangles="100 1000 10000 100000 1000000 10000000" samples="1 4 16 64 256 1024 4096 16384 65536 262144 1000000"
sizes="32 64 128 256 512 1024 2048 4096 8192"
if [ -n "${SMALL:-}" ]; then triangles="100 1000" samples="1 16" sizes="32 64"; fi
for n in $triangles; do
    run terrain "$n" --mesh terrain --triangles "$n" --spp 64
    run spheres "$n" --mesh spheres --triangles "$n" --spp 64
done
for n in $samples; do run samples "$n" --mesh box --size 32 --spp "$n" --replicates 1 --rounds 1; done
for n in $sizes; do run pixels "$((n * n))" --mesh box --size "$n" --spp 4 --rounds 1; done
for lens in 0 0.003 0.006 0.0125 0.025 0.05 0.1 0.2 0.4; do
    # At the back wall, 1.2 behind the focal distance of 1.5: px over the whole aperture.
    blur=$(awk "BEGIN { print 2 * $lens / (2 * 1.5 * 0.41421 / 256) * (1 - 1.5 / 2.2) }")
    run blur "$blur" --mesh spheres --lens "$lens" --spp 64
done
for n in 1 2; do
    run threads "$n" --mesh spheres --threads "$n" --spp 64
done

# plot NAME XLABEL YLABEL LINES...
plot() {
    local name=$1 x=$2 y=$3
    shift 3
    gnuplot <<END
set terminal pngcairo size 640,400
set output "$folder/$name.png"
set logscale xy
set xlabel "$x"
set ylabel "$y"
set grid
set key outside top center horizontal
set linetype 1 lc rgb "#0072b2" lw 2 pt 7
set linetype 2 lc rgb "#d55e00" lw 2 pt 5
set linetype 3 lc rgb "#009e73" lw 2 pt 9
plot $*
END
}

plot triangles "triangles" "kernel, ns per sample" \
    "\"$work/terrain\" u 1:2 w lp t 'terrain', \"$work/spheres\" u 1:2 w lp t 'spheres'"
plot build "triangles" "s" "\"$work/terrain\" u 1:6 w lp t 'hierarchy built', \"$work/terrain\" u 1:4 w lp t 'rendered, 256 x 256, 64 samples'"
plot samples "samples per pixel" "kernels, s" "\"$work/samples\" u 1:3 w lp t 'box, 32 x 32'"
plot pixels "pixels" "s" "\"$work/pixels\" u 1:4 w lp t 'render, 4 samples', \"$work/pixels\" u 1:5 w lp t 'of that, prepass'"
plot blur "blur of the back wall + 0.1, px" "kernel, ns per sample" "\"$work/blur\" u (\$1+0.1):2 w lp t 'spheres, 238 000 triangles'"

for name in terrain spheres samples pixels blur threads; do
    printf '\n%s\n\n| x | ns per sample | kernels s | render s | prepass s | build s | load s | MB |\n|---|---|---|---|---|---|---|---|\n' $name
    awk '{ printf "| %s | %.1f | %.3g | %.3g | %.3g | %.3g | %.3g | %.0f |\n", $1, $2, $3, $4, $5, $6, $7, $8 }' "$work/$name"
done
