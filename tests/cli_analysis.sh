#!/bin/bash
# The commands of the analysis: points, spectrum, slice, predict, converge.
# shellcheck source=tests/cli_support.sh
. "$(dirname "$0")/cli_support.sh"

oiiotool --create 300x200 3 --fill:color=1,1,1 300x200 -o bright.exr

# The analysis: tables to standard output or files, pictures, plots; points from files.
expect 0 "radius,mean,anisotropy_db,along 1:0" -- spectrum --n 64 --sets 4 --resolution 16
[ "$(echo "$output" | wc -l)" -eq 8 ] || wrong "rings: $output"
expect 0 "" -- points --sampler mj --n 64 --sets 4 --dims xu --out p.txt
expect 0 "" -- spectrum --in p.txt --resolution 32,20 --direction 1,2 --out p.exr --out p.png --out p.csv \
    --plot rings.svg --keep
[ -z "$output" ] || wrong "spectrum printed: $output"
grep -q "along 1:2" p.csv || wrong "no profile in p.csv"
case $(oiiotool --info -v p.exr) in *"32 x   20, 1 channel"*Power*) ;; *) wrong "p.exr" ;; esac
[ -s rings.svg ] && [ -s rings.svg.dat ] && [ -s rings.svg.gp ] || wrong "plot, data or script missing"
expect 2 "leave out --sampler" -- spectrum --in p.txt --n 16
for command in points spectrum merge; do
    expect 0 "read flags from FILE" -- $command --help
    case $output in *SCENE*) wrong "$command has no SCENE: $output" ;; esac
done
expect 0 "disk,mj,none,16,2," -- converge --integrand disk --sampler "random , mj" --nsamps "4, 16" --nreps 2
expect 2 "--nsamps 4, 16 64: must be" -- converge --integrand disk --nsamps "4, 16 64"
expect 2 "--projection xyz: must be two letters" -- spectrum --projection xyz
expect 2 "--resolution 1: must be" -- spectrum --resolution 1
expect 2 "unknown flag --fov" -- spectrum --fov 30
expect 2 "--direction 0,0: must be two numbers" -- spectrum --direction 0,0
expect 2 "--out a.gif: must be" -- spectrum --out a.gif
expect 2 "--plot a.pdf: must be a name that ends in .png or .svg" -- spectrum --plot a.pdf
expect 1 "none.txt" -- spectrum --in none.txt
expect 1 "/dev/zero:1: this is no line of text, or has more than 4095 bytes" -- spectrum --in /dev/zero
printf '# %05000d\n0.25 0.5\n0.5 0.75' 0 >long.txt # a remark may be long, the last line without its end
expect 0 "0.25 0.5" -- points --in long.txt --out -
case $output in *"0.5 0.75"*) ;; *) wrong "points behind a long remark: $output" ;; esac
printf '0.1 0.2\n# a byte\0 0\n0.3 0.4\n' >zero.txt
expect 1 "zero.txt:2: this is no line of text, or has more than 4095 bytes" -- points --in zero.txt --out -
printf '0.5 0.5\n0.1 0.2\0 0.3' >last.txt
expect 1 "last.txt:2: this is no line of text" -- points --in last.txt --out -
printf '0.1 0.2\n# the end' >end.txt
expect 0 "0.1" -- points --in end.txt --out -
expect 0 "predicted as isotropic," -- predict --integrand step --sampler nrooks --n 16 --sets 50 --measure 50
case $output in *"measured,"*) ;; *) wrong "not measured: $output" ;; esac
expect 2 "give an --integrand" -- predict --n 16
expect 0 "measured unshifted," -- predict "$cornell" --pixel 302,130 --quiet --n 16 --sets 4 \
    --resolution 31 --block 2 --measure 4
expect 2 "--pixel is of a SCENE" -- predict --pixel 3,4
expect 2 "--pixel 512,4: is outside the 512 x 512 image" -- predict "$cornell" --pixel 512,4 --n 16 --sets 4 --quiet
expect 2 "--block 16: must be" -- predict "$cornell" --pixel 3,4 --block 16
expect 2 "--integrand blob: must be step, box" -- predict --integrand blob
expect 2 "converg: no such command or scene; did you mean converge?" -- converg --integrand disk
expect 0 "target,sampler,shear,n,replicates,variance,slope" -- converge --integrand box --sampler mj --nreps 20
[ "$(echo "$output" | grep -c '^box,mj,none,')" -eq 4 ] || wrong "converge: $output"
# The variance of a wall is least at its own shear: none and the opposite one are worse.
for shear in own 0 13; do
    forced="--shear-px $shear"
    [ $shear = own ] && forced=
    expect 0 "pixel 302:130" -- converge "$cornell" --quiet --pixels 302,130 --sampler mj --shear equal-area \
        --oracle centre --nsamps 256,1024 --nreps 200 $forced
    variance=$(echo "$output" | awk -F, '$4 == 1024 { print $6 }')
    [ $shear = own ] && least=$variance && continue
    # Seventeen times at 0, more at 13; 200 replicates give a ratio a relative error of 14 %, or twice that with heavy tails.
    awk -v a="$variance" -v b="$least" 'BEGIN { exit !(a > 3 * b) }' || wrong "--shear-px $shear: $variance, own $least"
done
expect 0 "mean,local_slope,local_slope_low,local_slope_high" -- converge --integrand disk --sampler mj --nreps 20 \
    --nsamps 16,64,256 --local-slopes
# Least squares through three points at equal distances is the mean of the slopes between them.
echo "$output" | awk -F, 'NR == 2 { slope = $7 } NR > 1 && NR < 4 { mean += $11 / 2 } END { exit !(NR == 4 && $11 == "" &&
    slope - mean < 2e-4 && mean - slope < 2e-4) }' || wrong "local slopes: $output"
expect 0 "" -- converge "$cornell" --quiet --pixels '302,130;3,4' --sampler mj --nreps 8 --nsamps 4,16 \
    --out c.json --plot c.png --reference 0.3
python3 -c 'import json; s = json.load(open("c.json"))["series"]; assert len(s) == 4 and len(s[0]["mse"]) == 2' ||
    wrong "c.json"
[ -s c.png ] && [ ! -e c.png.dat ] || wrong "plot missing, or its data left"
expect 0 "" -- slice "$cornell" --quiet --pixel 302,130 --resolution 32,16 --out q.exr --out q.png \
    --spectrum qs.png
case $(oiiotool --info -v q.exr) in *"32 x   16, 3 channel"*) ;; *) wrong "q.exr" ;; esac
[ -s qs.png ] || wrong "no spectrum of the slice"
expect 0 "" -- slice "$cornell" --quiet --pixel 302,130 --projection 4d --resolution 8 --out q.npy
[ "$(stat -c %s q.npy)" -eq $((128 + 8 * 8 * 8 * 8 * 3 * 4)) ] || wrong "size of q.npy"
expect 0 "" -- slice "$cornell" --quiet --pixel 302,130 --projection xt --resolution 16 \
    --camera-to 276.4,274.4,800,330,274.4,0 --out xt.png
expect 2 "give a SCENE and a --pixel" -- slice "$cornell"
expect 2 ".npy is for --projection 4d" -- slice "$cornell" --pixel 1,1 --out q.npy
expect 2 "--projection xx: must be two letters" -- slice "$cornell" --pixel 1,1 --projection xx
expect 2 "--pixel 600,1: is outside" -- slice "$cornell" --quiet --pixel 600,1 --out q.png
for command in points spectrum predict converge slice merge; do
    expect 0 "usage: clshear $command" -- $command --help
    [ "$(echo "$output" | awk 'length > 80' | wc -l)" -eq 0 ] || wrong "$command --help wider than 80"
done
expect 0 "image,mj,none,4,8," -- converge "$cornell" --quiet --width 24 --height 20 --sampler mj --nsamps 4,16
[ "$(echo "$output" | wc -l)" -eq 5 ] || wrong "converge of an image: $output"
expect 0 "" -- "$cornell" --quiet --width 24 --height 20 --spp 64 --out ref.exr
expect 0 "target,sampler,shear,n,replicates,mse,slope" -- converge "$cornell" --quiet --width 24 --height 20 \
    --sampler mj --nsamps 4,16 --reference ref.exr
expect 2 "the reference has 24 x 20 pixels: it needs the image's size, 24 x 16" -- converge "$cornell" --quiet --width 24 \
    --height 16 --reference ref.exr
oiiotool --create 24x20 1 --chnames Y -o grey.exr
expect 2 "the reference has no channel R: it needs R, G and B" -- converge "$cornell" --quiet --width 24 --height 20 \
    --reference grey.exr
expect 0 "" -- converge "$cornell" --quiet --width 24 --height 20 --crop 3,19,5,9 --sampler mj,sz --nsamps 4,16 \
    --map map.csv --map map.exr --map map.png
[ "$(grep -c '^3,5,mj,none,.*,1$' map.csv)" -eq 1 ] || wrong "map: no first pixel with gain 1"
[ "$(wc -l <map.csv)" -eq $((1 + 16 * 4 * 4)) ] || wrong "map: $(wc -l <map.csv) rows"
oiiotool --info -v map.exr | grep -q 'sz.equal-area.Gain' || wrong "map.exr has no gain"
oiiotool --info map.png | grep -q '96 x *4' || wrong "map.png is not six panels"
expect 0 "" -- predict "$cornell" --quiet --width 24 --height 20 --crop 3,5,5,6 --sampler mj --n 16 --sets 20 --resolution 15 \
    --block 2 --measure 20 --map predicted.csv --map predicted.exr --map predicted.png --plot scatter.png
[ "$(awk -F, 'NR > 1 && $1 >= 3 && $2 == 5 && $3 > 0 && $4 > 0' predicted.csv | wc -l)" -eq 2 ] || wrong "predict --map: no two pixels with a variance"
oiiotool --info predicted.png | grep -q '4 x *1' || wrong "predicted.png is not two panels"
[ -s predicted.exr ] && [ -s scatter.png ] || wrong "predict --map: no predicted.exr or scatter.png"
[ "$(awk -F, 'NR > 1 && ($5 < 0 || $5 > $4 || $6 < $4)' predicted.csv | wc -l)" -eq 0 ] || wrong "intervals: $(cat predicted.csv)"
expect 0 "6 of 6 pixels" -- predict "$cornell" --width 3 --height 2 --sampler mj --n 4 --sets 4 --resolution 7 --block 1 \
    --measure 4 --map small.csv
expect 2 "--out t.csv: is of a --pixel or an --integrand" -- predict "$cornell" --measure 4 --map small.csv --out t.csv
expect 2 "an image of 6 x 6 pixels: an interval needs more than one tile" -- converge "$cornell" --quiet --width 6 \
    --height 6 --sampler mj --nsamps 4,16
# A gain is over the curve without a shear, in whatever order; without that curve there is none.
expect 0 "" -- converge "$cornell" --quiet --width 24 --height 8 --sampler mj --shear equal-area,none --nsamps 4,16 --map order.csv
expect 0 "" -- converge "$cornell" --quiet --width 24 --height 8 --sampler mj --shear equal-area --nsamps 4,16 --map alone.csv
[ "$(grep -c ',none,.*,1$' order.csv)" -gt 64 ] && [ "$(grep -c ',equal-area,.*nan$' alone.csv)" -eq 192 ] ||
    wrong "gains: $(head -3 order.csv alone.csv)"
expect 2 "--map and --plot are of a whole SCENE" -- predict "$cornell" --pixel 1,1 --measure 9 --map predicted.csv
expect 2 "give the sets to --measure with" -- predict "$cornell" --map predicted.csv
expect 2 "--map is of a whole image: leave out --pixels" -- converge "$cornell" --pixels 3,4 --map map.csv
expect 2 "--fresh-sets is of a SCENE" -- converge --integrand box --fresh-sets
expect 2 "a picture is of a whole image" -- converge "$cornell" --quiet --reference 0.5
expect 2 "give either an --integrand or a SCENE" -- converge --sampler mj
expect 2 "give either an --integrand or a SCENE" -- converge "$cornell" --integrand box
expect 0 "pixel 3:4,mj,none,16" -- converge "$cornell" --quiet --pixels 3,4 --sampler mj --nreps 4 \
    --nsamps 4,16 --aperture bright.exr

# Outputs that cannot be written are found before the work, whatever the command.
expect 1 "--out nowhere/x: folder nowhere/ cannot be written" -- predict "$cornell" --pixel 302,130 --out nowhere/x
expect 1 "--out nowhere/x.csv: folder nowhere/ cannot" -- converge "$cornell" --out nowhere/x.csv
expect 1 "--plot nowhere/p.png: folder nowhere/ cannot" -- spectrum --plot nowhere/p.png
expect 1 "--out nowhere/x.png: folder nowhere/ cannot" -- slice "$cornell" --pixel 1,1 --out nowhere/x.png
expect 1 "--out nowhere/p: folder nowhere/ cannot" -- points --out nowhere/p
mkfifo pipe.csv
timeout 60 cat pipe.csv >piped.csv &
expect 0 "" -- predict --integrand step --n 16 --sets 2 --out pipe.csv
wait
[ -p pipe.csv ] && [ -s piped.csv ] || wrong "a pipe is replaced"

output=$(POCL_CACHE_DIR=/proc/none "$program" --list-devices 2>&1)
case $?$output in 1*"PoCL needs a cache folder that it can write"*) ;; *) wrong "no cache: $output" ;; esac

# The file beside a scene is of its renders: their outputs are not another command's.
cp "$cornell" "${cornell%.obj}.mtl" "$(dirname "$cornell")/checker.png" .
echo "--out rendered.exr" >cornell.flags
echo precious >rendered.exr
expect 0 "" -- slice cornell.obj --quiet --pixel 1,1 --resolution 8 --out of-pixel.png
[ "$(cat rendered.exr)" = precious ] || wrong "slice wrote what its scene's render would"
rm -f cornell.* rendered.exr

expect 2 "--lens-radius 1e19: must be a number, 0 to 1e+12" -- "$cornell" --quiet --lens-radius 1e19 --out far.exr
expect 2 "--focal-distance 1e-18: must be a number, 1e-12 to" -- slice "$cornell" --pixel 1,1 --focal-distance 1e-18
expect 2 "--eye 1e38,0,0: must be three numbers, X,Y,Z, each -1e+12 to 1e+12" -- "$cornell" --quiet --eye 1e38,0,0 --out far.exr
expect 2 "--size 0: must be above 0" -- predict --integrand plane-wave --size 0
expect 2 "too few frequencies" -- spectrum --resolution 2 --n 4 --sets 1 --plot p.png

# A full disk costs one line, and not the file that was there.
echo precious >kept.csv
for line in "spectrum --n 16 --sets 2 --resolution 16" "predict --integrand disk --n 16 --sets 2" \
    "converge --integrand disk --nreps 4"; do
    # shellcheck disable=SC2086
    output=$("$program" $line 2>&1 >/dev/full)
    [ $? -eq 1 ] && [ "$output" = "clshear: standard output: cannot be written: No space left on device" ] ||
        wrong "$line to a full disk: $output"
done
# Without a device: drivers write files of their own.
output=$(ulimit -f 0 && trap '' XFSZ && "$program" converge --integrand disk --nreps 4 --out kept.csv 2>&1)
case $?$output in 1*"kept.csv: cannot be written: File too large"*) ;; *) wrong "no room: $output" ;; esac
[ "$(cat kept.csv)" = precious ] || wrong "kept.csv is lost"
[ -z "$(ls | grep part)" ] || wrong "parts of files are left: $(ls | grep part)"
expect 2 "--nsamps: must be 2 to 32 rising" -- converge --integrand box --nsamps 64,16
expect 2 "--pixels 600,3: is outside the 512 x 512 image" -- converge "$cornell" --quiet --pixels 600,3
expect 0 "sampler oa has no sets of 30 points: 49" -- converge --integrand disk --sampler oa --nsamps 9,30 --nreps 4
output=$(PATH=/nonexistent "$program" converge --integrand disk --nreps 4 --plot no.png 2>&1)
case $?$output in 1*"no gnuplot here: no.png is not drawn"*) ;; *) wrong "without gnuplot: $output" ;; esac

# Points: text, CSV and EXR hold the same; files and pipes go in and out.
expect 0 "usage: clshear points" -- points --help
[ "$(echo "$output" | awk '{ if (length > 80) print }' | wc -l)" -eq 0 ] || wrong "help wider than 80"
"$program" points --sampler halton --n 7 --sets 3 >points.txt || wrong "points"
[ "$(grep -c '#' points.txt)" -eq 2 ] && [ "$(grep -vc '#' points.txt)" -eq 21 ] || wrong "points.txt"
"$program" points --in - --out points.exr <points.txt || wrong "points from a pipe"
"$program" points --in points.exr --out points.csv || wrong "points from EXR"
cmp -s <(tr , ' ' <points.csv) points.txt || wrong "formats differ"
"$program" points --in points.txt --dims vx --shear-px 2 | awk '!/#/ && NF != 2 { exit 1 }' || wrong "dims"
expect 1 "nowhere.txt: cannot be opened" -- points --in nowhere.txt
printf '0.1 0.2\n0.3 1.2\n' >bad.txt
expect 1 "bad.txt:2: a coordinate is not between 0 and 1" -- points --in bad.txt
printf '0.1 0.2\n#\n0.1 0.2\n0.3 0.2\n' >bad.txt
expect 1 "bad.txt:4: this set and the first one have different numbers of points" -- points --in bad.txt
expect 2 "--dims xz: must be letters out of xyuvpqt" -- points --dims xz
"$program" points --n 4 --dims tx --velocity-px 8,3 | awk 'NF != 2 { exit 1 }' || wrong "time"
"$program" points --n 4 --velocity-px 8,3 --shear toroidal 2>&1 | grep -q "the shear equal-area or none" ||
    wrong "toroidal shear of time"
expect 2 'coordinates "pt": must be different ones of "xyuvt"' -- points --dims pt
expect 2 "scene.obj: not a flag" -- points scene.obj
expect 2 "an empty word: not a flag" -- points ""
expect 2 "--in is empty: give FILE" -- spectrum --in ""
expect 2 "--reference is empty: give VALUE" -- converge "$cornell" --reference ""
expect 2 "the scene's name is empty" -- slice "" --pixel 1,1
expect 2 "must be 1 to 65536" -- points --sampler ccvt --n 70000
"$program" points --out /dev/full 2>full.txt && wrong "full device: exit code"
grep -q "/dev/full: cannot be written" full.txt || wrong "full device: $(cat full.txt)"
"$program" points --n 100000 2>pipe.txt | head -1 >/dev/null # a closed pipe is no crash

finish
