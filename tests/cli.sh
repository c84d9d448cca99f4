#!/bin/bash
# The program as a person drives it: flags, errors, exit codes, files, pipes and Ctrl-C.
set -u
program=$(realpath "$1") root=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1
cornell=$root/scenes/cornell.obj
small="--width 32 --height 32 --spp 16"
failures=0

wrong() {
    echo "FAILED: $1"
    failures=$((failures + 1))
}

# expect CODE WORDS -- ARGUMENTS: exit code, and words in what is printed (both streams).
expect() {
    local code=$1 words=$2
    shift 3
    output=$("$program" "$@" 2>&1 </dev/null)
    local got=$?
    [ $got -eq "$code" ] || wrong "clshear $*: exit $got, not $code: $output"
    case "$output" in
    *"$words"*) ;;
    *) wrong "clshear $*: no \"$words\" in: $output" ;;
    esac
}

# The same for usage errors and failures: one line only, and no picture.
refuse() {
    rm -f refused.exr
    expect "$@" --out refused.exr
    [ "$(echo "$output" | wc -l)" -eq 1 ] || wrong "more than one line: $output"
    [ ! -e refused.exr ] || wrong "a picture was written: ${*:4}"
}

# Help, version, devices.
expect 0 "usage: clshear SCENE" -- --help
[ "$(echo "$output" | awk '{ if (length > 80) print }' | wc -l)" -eq 0 ] || wrong "help wider than 80"
expect 0 "clshear 0." -- --version
expect 0 "--spp N" -- --print-settings md
cmp -s <(echo "$output") <("$program" --print-settings md) || wrong "the reference changes"
expect 0 '.TH CLSHEAR 1' -- --print-settings man
expect 2 "--print-settings html: must be one of md man" -- --print-settings html
expect 0 "0: " -- --list-devices

# Wrong usage: 2.
refuse 2 "no scene given" --
refuse 2 "did you mean --fov?" -- "$cornell" --fvo 30
refuse 2 "did you mean --spp?" -- "$cornell" --sp 30
refuse 2 "unknown flag --zzzzzzzzzz" -- "$cornell" --zzzzzzzzzz
refuse 2 "--spp 0: must be a whole number" -- "$cornell" --spp 0
refuse 2 "--spp 1e99: must be" -- "$cornell" --spp 1e99
refuse 2 "--spp -4: must be" -- "$cornell" --spp -4
refuse 2 "--eye 1,2: must be three numbers" -- "$cornell" --eye 1,2
refuse 2 "--eye 1,2,nan: must be" -- "$cornell" --eye 1,2,nan
refuse 2 "--fov 180: must be" -- "$cornell" --fov 180
refuse 2 "--shear sideways: must be none, toroidal or equal-area" -- "$cornell" --shear sideways
refuse 2 "--packet 3: must be" -- "$cornell" --packet 3
refuse 2 "--quiet takes no value" -- "$cornell" --quiet=yes
refuse 2 "more than one scene" -- "$cornell" "$cornell"
refuse 2 "--aperture heart: must be disk, square, polygon or an image file" -- "$cornell" --aperture heart
expect 0 "--fstop is not used: --lens-radius comes after it" -- "$cornell" --fstop 2 --lens-radius 3 --width 8 --height 8 --spp 1 --out pair.exr
expect 0 "--focus-pixel is not used: --focal-distance" -- "$cornell" --focus-pixel 3,3 --focal-distance 1000 --width 8 --height 8 --spp 1 --out pair.exr
refuse 2 "--blades 2: must be" -- "$cornell" --blades 2
refuse 2 "--anamorphic 0: must be" -- "$cornell" --anamorphic 0
refuse 2 "--filter lanczos: must be box" -- "$cornell" --filter lanczos
refuse 2 "--filter-width 0: must be" -- "$cornell" --filter-width 0
expect 2 "--out needs a value" -- "$cornell" --out
expect 2 "--out picture.bmp: must be a name that ends in" -- "$cornell" --out picture.bmp

# Failures: 1.
refuse 1 "nowhere.obj: cannot be opened: No such file" -- nowhere.obj
refuse 1 "no OpenCL device \"toaster\"" -- "$cornell" --quiet --device toaster
refuse 2 "--crop 0,0,0,0: must be four whole numbers, X0,X1,Y0,Y1, with X0 < X1" -- "$cornell" --crop 0,0,0,0
refuse 1 "crop 0,99,0,9" -- "$cornell" --quiet --width 32 --height 32 --crop 0,99,0,9
refuse 1 "pixel 40,2 is outside" -- "$cornell" --quiet --width 32 --height 32 --focus-pixel 40,2
refuse 1 "replicates" -- "$cornell" --quiet --spp 2 --replicates 3
expect 1 "folder no/such/ cannot be written" -- "$cornell" --out no/such/folder.exr
output=$(OCL_ICD_VENDORS=/nonexistent "$program" "$cornell" --quiet --out refused.exr 2>&1)
case $?$output in 1*"no OpenCL device found; install"*) ;; *) wrong "no driver: $output" ;; esac

# Full outputs and formats that are too small.
output=$("$program" --list-samplers 2>&1 >/dev/full)
case $?$output in 1*"standard output: cannot be written"*) ;; *) wrong "/dev/full: $output" ;; esac
expect 1 "environment 1,2: neither R,G,B nor a file" -- "$cornell" --quiet --environment 1,2 --out refused.exr
expect 1 "environment gone.hdr: neither" -- "$cornell" --quiet --environment gone.hdr --out refused.exr
expect 1 "65500" -- "$cornell" --quiet --spp 1 --width 65536 --height 1 --out wide.jpg

# A name may be as long as the file system has them, and one that is longer is refused before the render.
long=$(printf 'n%.0s' $(seq 251))
expect 0 "" -- "$cornell" --quiet --spp 1 --width 8 --height 8 --out "$long.png"
[ -s "$long.png" ] || wrong "no picture under a name of 255 bytes"
expect 1 "the name is too long" -- "$cornell" --quiet --spp 1000000000 --out "${long}n.png"

# Renders. Settings beside the scene are read and said; the command line wins.
# shellcheck disable=SC2086
{
    expect 0 "settings from $root/scenes/cornell.flags" -- "$cornell" $small --out a.exr --out a.png
    expect 0 "" -- "$cornell" $small --quiet
    [ -z "$output" ] || wrong "--quiet printed: $output"
    [ -s cornell.exr ] || wrong "no default output"
    expect 0 "rays " -- "$cornell" $small --stats --out b.exr
    cmp -s <(oiiotool --dumpdata a.exr | tail -n +2) <(oiiotool --dumpdata b.exr | tail -n +2) ||
        wrong "two runs differ"
    expect 0 "" -- "$cornell" $small --quiet --threads 1 --out c.exr
    cmp -s <(oiiotool --dumpdata a.exr | tail -n +2) <(oiiotool --dumpdata c.exr | tail -n +2) ||
        wrong "one thread differs from two"
    echo "--lens-radius 1 # tiny" >mine.flags
    expect 0 "settings from mine.flags" -- "$cornell" $small --settings mine.flags --out d.exr
    case $(oiiotool --info -v d.exr) in *"clshear.lensRadius: 1"*) ;; *) wrong "settings unused" ;; esac
    expect 0 "" -- "$cornell" $small --settings mine.flags --aperture-radius=2.5 --out d.exr
    case $(oiiotool --info -v d.exr) in *"clshear.lensRadius: 2.5"*) ;; *) wrong "line lost" ;; esac
    echo "--lens-raduis 1" >mine.flags
    refuse 2 "mine.flags:1: unknown flag --lens-raduis; did you mean --lens-radius?" -- \
        "$cornell" --settings mine.flags
    printf -- '--width 32 # px\n--spp 0\n' >mine.flags
    refuse 2 "mine.flags:2: spp 0: must be a whole number" -- "$cornell" --settings mine.flags
    printf 'light 1,2,3,4,5,6\nblades 5\nout file.exr\n' >mine.flags
    expect 0 "" -- "$cornell" $small --quiet --settings mine.flags --aperture disk --adaptive=0 --out line.exr
    [ -s line.exr ] && [ ! -e file.exr ] || wrong "outputs of the line do not replace the file's"
    case $(oiiotool --info -v line.exr) in *'clshear.aperture: "disk"'*) ;; *) wrong "aperture of the file won" ;; esac
    refuse 1 "gone.flags: cannot be read" -- "$cornell" --settings gone.flags
}

# Apertures and filters, with what tells them in the metadata.
oiiotool --create 8x8 1 --fill:color=0 8x8 -o dark.exr --create 300x200 3 --fill:color=1,1,1 300x200 \
    -o bright.exr
# shellcheck disable=SC2086
{
    refuse 1 "gone.png" -- "$cornell" --quiet --aperture gone.png
    refuse 1 "aperture image: all black" -- "$cornell" --quiet --aperture dark.exr
    refuse 1 "the toroidal shear knows square and disk" -- "$cornell" --quiet --blades 5 --shear toroidal
    expect 0 "" -- "$cornell" $small --quiet --aperture ./bright.exr --filter tent --out l.exr
    expect 0 "" -- "$cornell" $small --quiet --aperture disk --blades 5 --blade-rotation 10 \
        --anamorphic 2 --filter gaussian --filter-width 2.5 --out l.exr
    info=$(oiiotool --info -v l.exr)
    for word in 'aperture: "polygon"' 'blades: 5' 'bladeRotation: 10' 'anamorphic: 2' \
        'filter: "gaussian"' 'filterWidth: 2.5'; do
        case $info in *"clshear.$word"*) ;; *) wrong "no $word in the metadata" ;; esac
    done
}

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
expect 2 "--projection xyz: must be two letters" -- spectrum --projection xyz
expect 2 "--resolution 1: must be" -- spectrum --resolution 1
expect 2 "unknown flag --fov" -- spectrum --fov 30
expect 2 "--direction 0,0: must be two numbers" -- spectrum --direction 0,0
expect 2 "--out a.gif: must be" -- spectrum --out a.gif
expect 2 "--plot a.pdf: must be a name that ends in one of .png .svg" -- spectrum --plot a.pdf
expect 1 "none.txt" -- spectrum --in none.txt
expect 0 "predicted as isotropic," -- predict --integrand step --sampler nrooks --n 16 --sets 50 --measure 50
case $output in *"measured,"*) ;; *) wrong "not measured: $output" ;; esac
expect 2 "give an --integrand" -- predict --n 16
expect 0 "measured unshifted," -- predict "$cornell" --pixel 302,130 --quiet --n 16 --sets 4 \
    --resolution 31 --block 2 --measure 4
expect 2 "--pixel is of a SCENE" -- predict --pixel 3,4
expect 2 "--pixel 512,4: is outside the 512 x 512 image" -- predict "$cornell" --pixel 512,4 --n 16 --sets 4 --quiet
expect 2 "--block 16: must be" -- predict "$cornell" --pixel 3,4 --block 16
expect 2 "--integrand blob: must be one of step box" -- predict --integrand blob
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
expect 1 "the reference has 24 x 20 pixels: it needs the image's size, 24 x 16" -- converge "$cornell" --quiet --width 24 \
    --height 16 --reference ref.exr
oiiotool --create 24x20 1 --chnames Y -o grey.exr
expect 1 "the reference has no channel R: it needs R, G and B" -- converge "$cornell" --quiet --width 24 --height 20 \
    --reference grey.exr
expect 0 "" -- converge "$cornell" --quiet --width 24 --height 20 --crop 3,19,5,9 --sampler mj,sz --nsamps 4,16 \
    --map map.csv --map map.exr --map map.png
[ "$(grep -c '^3,5,mj,none,.*,1$' map.csv)" -eq 1 ] || wrong "map: no first pixel with gain 1"
[ "$(wc -l <map.csv)" -eq $((1 + 16 * 4 * 4)) ] || wrong "map: $(wc -l <map.csv) rows"
oiiotool --info -v map.exr | grep -q 'sz.equal-area.Gain' || wrong "map.exr has no gain"
oiiotool --info map.png | grep -q '96 x *4' || wrong "map.png is not six panels"
expect 0 "" -- predict "$cornell" --quiet --width 24 --height 20 --crop 3,5,5,6 --sampler mj --n 16 --sets 20 --resolution 15 \
    --block 2 --measure 20 --map predicted.csv --map predicted.exr --map predicted.png --plot scatter.png
[ "$(grep -c '^[34],5,[1-9]' predicted.csv)" -eq 2 ] || wrong "predict --map: no two pixels with a variance"
oiiotool --info predicted.png | grep -q '4 x *1' || wrong "predicted.png is not two panels"
[ -s predicted.exr ] && [ -s scatter.png ] || wrong "predict --map: no predicted.exr or scatter.png"
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
expect 1 "too few frequencies" -- spectrum --resolution 2 --n 4 --sets 1 --plot p.png

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

# A scene without camera, lens and light says what was chosen.
cat >bare.obj <<'END'
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
f 1 2 3 4
END
# shellcheck disable=SC2086
{
    expect 0 "no lens given, a moderate blur: --lens-radius" -- bare.obj $small --out e.exr
    case $output in *"focused on the middle of the picture, --focal-distance"*) ;; *) wrong "focus unsaid" ;; esac
    expect 0 "" -- bare.obj $small --fstop 2.8 --unit 0.01 --focus-pixel 16,16 --out f.exr
}

# What the settings file says of the lens gives way to either way of saying it.
# shellcheck disable=SC2086
{
    expect 0 "" -- "$cornell" $small --quiet --fstop 2 --unit 0.001 --out i.exr
    case $(oiiotool --info -v i.exr) in *"clshear.lensRadius: 25"*) wrong "--fstop unused" ;; esac
    echo "--focus-pixel 3,3" >mine.flags
    expect 0 "" -- bare.obj $small --quiet --settings mine.flags --focal-distance 2 --out j.exr
    case $(oiiotool --info -v j.exr) in *"clshear.focalDistance: 2"*) ;; *) wrong "focus unused" ;; esac
}

# Scenes without anything but triangles are seen and lit, flat ones too.
sed 's/^v \(.*\) \(.*\) 0/v \1 0 \2/' bare.obj >floor.obj
for scene in bare.obj floor.obj; do
    # shellcheck disable=SC2086
    expect 0 "no light given" -- $scene $small --out k.exr
    oiiotool --stats k.exr | awk '/Stats Avg/ { exit !($3 > 0.01) }' || wrong "$scene is dark"
done
# Pictures that cannot be meant are remarked on; others are not.
remarks="black|brighter|everything is in focus"
# shellcheck disable=SC2086
{
    expect 0 "black: the camera does not see" -- bare.obj $small --eye 0,0,1e5 --target 0,0,2e5 \
        --light 0,0,9,1,1,1 --out k.exr
    expect 0 "black: no light reaches" -- bare.obj $small --light 1e6,1e6,1e6,0,0,0 --out k.exr
    expect 0 "--exposure -9 or --auto-exposure" -- bare.obj $small --environment 99,99,99 \
        --out k.exr
    expect 0 "" -- bare.obj $small --environment 99,99,99 --exposure -8 --out k.png
    if echo "$output" | grep -qE "$remarks"; then wrong "a remark on a dark exposure: $output"; fi
    expect 0 "everything is in focus" -- bare.obj $small --lens-radius 1e-6 --out k.exr
    expect 0 "" -- bare.obj $small --out k.exr
    if echo "$output" | grep -qE "$remarks"; then wrong "a remark on a good picture: $output"; fi
}
mkdir -p folder.exr
expect 1 "folder.exr: is a folder" -- bare.obj --out folder.exr

# Metadata reproduces the image.
info=$(oiiotool --info -v a.exr)
for word in 'Software: "clshear' 'clshear.cmdline: "' 'clshear.settings: "--eye 276.4,274.4,800 --target' 'clshear.seed: "0"' 'clshear.sampler: "sz"' \
    'clshear.shear: "equal-area"' 'clshear.replicates: 2' 'samplesPerPixel: 16' \
    'renderTimeSeconds: ' 'worldToCamera: ' 'clshear.focalDistance: 930' 'clshear.device: "' \
    'clshear.driver: "' 'Variance.R' 'SampleVariance.B' 'Samples' 'Shear'; do
    case $info in *"$word"*) ;; *) wrong "no $word in the metadata" ;; esac
done
case $info in *"float openexr"*) ;; *) wrong "not float32" ;; esac

# Samplers: every name renders; a number that a sampler has not is raised, and said.
expect 0 "sobol-pairs" -- --list-samplers
refuse 2 "--sampler dice: must be random, jittered" -- "$cornell" --sampler dice
"$program" --list-samplers | while read -r sampler rest; do
    # shellcheck disable=SC2086
    "$program" "$cornell" $small --quiet --sampler "$sampler" --out sampler.exr || exit 1
    case $(oiiotool --info -v sampler.exr) in *"clshear.sampler: \"$sampler\""*) ;; *) exit 1 ;; esac
done || wrong "a sampler does not render"
# shellcheck disable=SC2086
expect 0 "sampler oa has no patterns of 8 samples: 2 replicates of 9" -- "$cornell" $small \
    --sampler oa --out sampler.exr
case $(oiiotool --info -v sampler.exr) in *"samplesPerPixel: 18"*) ;; *) wrong "samples untold" ;; esac

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
expect 2 "--dims xz: must be letters out of xyuvpq" -- points --dims xz
expect 2 "scene.obj: not a flag" -- points scene.obj
expect 1 "must be 1 to 65536" -- points --sampler ccvt --n 70000
"$program" points --out /dev/full 2>full.txt && wrong "full device: exit code"
grep -q "/dev/full: cannot be written" full.txt || wrong "full device: $(cat full.txt)"
"$program" points --n 100000 2>pipe.txt | head -1 >/dev/null # a closed pipe is no crash

# The oracle: rules, sharing out, and what the shear gains as a picture.
# shellcheck disable=SC2086
{
    refuse 2 "--oracle delphi: must be centre, median, near, far or pilot" -- "$cornell" --oracle delphi
    expect 0 "" -- "$cornell" --width 32 --height 32 --spp 128 --quiet --adaptive --gain gain.png \
        --out gain.exr
    [ -s gain.png ] || wrong "no picture of the gain"
    case $(oiiotool --info -v gain.exr) in *"clshear.adaptive: 1"*) ;; *) wrong "adaptive untold" ;; esac
    case $output in *"Gain"*) wrong "said something" ;; esac
    refuse 2 "--gain gain.bmp: must be a name that ends in" -- "$cornell" --quiet --gain gain.bmp
    refuse 1 "cannot be extended" -- "$cornell" $small --quiet --adaptive --extendable
}

# A render goes on where it ended, and says so when it cannot.
# shellcheck disable=SC2086
{
    expect 0 "" -- "$cornell" $small --quiet --extendable --out more.exr
    expect 0 "" -- "$cornell" $small --quiet --extend more.exr --spp 64 --out more.exr
    case $(oiiotool --info -v more.exr) in *"samplesPerPixel: 64"*) ;; *) wrong "not extended" ;; esac
    refuse 1 "another seed" -- "$cornell" $small --quiet --extend more.exr --spp 128 --seed 4
    refuse 1 "rendered with --extendable" -- "$cornell" $small --quiet --extend a.exr --spp 128
    refuse 1 "gone.exr" -- "$cornell" $small --quiet --extend gone.exr --spp 128
}

# Progress: a line per 10 % in a pipe, the last one 100 %.
output=$("$program" "$cornell" --width 64 --height 64 --spp 256 --out g.exr 2>&1 >/dev/null)
[ "$(echo "$output" | grep -c ' %')" -le 11 ] || wrong "too many lines of progress"
case $output in *"100 %"*) ;; *) wrong "never at 100 %: $output" ;; esac

# On a narrow terminal, no longer than it is wide.
output=$(script -qec "stty cols 20; '$program' '$cornell' --width 64 --height 64 --spp 256 --out g.exr" /dev/null)
case $output in *"100 %"*) ;; *) wrong "terminal: $output" ;; esac
longest=$(echo "$output" | tr '\r' '\n' | awk '/ %/ && length > most { most = length } END { print most }')
[ "$longest" -le 19 ] || wrong "a line of progress has $longest columns of 20"

# Ctrl-C, kill and a closed terminal: what was done is written, with true counts, and the exit code
# says so.
for signal in INT:130 TERM:143 HUP:129; do
    rm -f h.exr h.txt
    "$program" "$cornell" --spp 200000 --width 64 --height 64 --out h.exr 2>h.txt &
    child=$!
    for _ in $(seq 300); do grep -q '10 %' h.txt 2>/dev/null && break; sleep 0.1; done
    kill -"${signal%:*}" $child
    wait $child
    [ $? -eq "${signal#*:}" ] || wrong "$signal: exit code"
    grep -q "h.exr holds the samples so far" h.txt || wrong "$signal: $(cat h.txt)"
    [ -s h.exr ] || wrong "$signal: no picture"
    oiiotool --info h.exr | grep -q "64 x   64, 13 channel" || wrong "$signal: bad file"
done

# SIGUSR1 asks for the picture so far; the render goes on, and its checkpoint is gone when it is done.
rm -f h.exr h.txt
"$program" "$cornell" --spp 4000 --width 64 --height 64 --checkpoint state --every 0 --out h.exr 2>h.txt &
child=$!
for _ in $(seq 300); do grep -q '10 %' h.txt 2>/dev/null && break; sleep 0.1; done
[ -s state ] || wrong "no checkpoint"
kill -USR1 $child
wait $child
[ $? -eq 0 ] || wrong "USR1: exit code"
grep -q "going on; h.exr holds the samples so far" h.txt || wrong "USR1: $(cat h.txt)"
case $(oiiotool --info -v h.exr) in *interrupted*) wrong "USR1: the picture is not complete" ;; esac
[ ! -e state ] || wrong "the checkpoint is left"

# Checkpoints that cannot be written, or are of something else.
refuse 1 "resume: needs a checkpoint" -- "$cornell" --quiet --resume
refuse 1 "--checkpoint no/such/state: folder no/such/ cannot be written" -- "$cornell" --quiet --checkpoint no/such/state
echo "not a checkpoint" >state
refuse 1 "state: is there already" -- "$cornell" --quiet --checkpoint state
refuse 1 "state: is no whole checkpoint" -- "$cornell" --quiet --checkpoint state --resume
rm -f state

# Rules that end a render say what they promised.
# shellcheck disable=SC2086
{
    expect 0 "ended by --noise at" -- "$cornell" $small --spp 4096 --noise 0.05 --out rule.exr
    expect 0 "would take about" -- "$cornell" $small --spp 64 --noise 0.0001 --out rule.exr
    case $(oiiotool --info -v rule.exr) in *'clshear.stoppedBy: "spp"'*) ;; *) wrong "rule untold" ;; esac
    refuse 1 "needs 2 replicates" -- "$cornell" $small --quiet --noise 0.1 --replicates 1
}

# Shards, merged.
# shellcheck disable=SC2086
{
    for shard in 1 2 3; do
        expect 0 "" -- "$cornell" $small --quiet --shard $shard/3 --out shard-$shard.exr
    done
    expect 0 "shards 2 are missing" -- merge shard-3.exr shard-1.exr --out some.exr
    expect 0 "" -- merge some.exr shard-2.exr --out all.exr --out all.png
    case $(oiiotool --info -v all.exr) in *'clshear.shard: "1-3/3"'*) ;; *) wrong "shards untold" ;; esac
    refuse 1 "shard 1 is in another of the films, too" -- merge some.exr shard-1.exr
    refuse 1 "is no complete EXR of a shard" -- merge some.exr a.exr
    refuse 1 "gone.exr" -- merge some.exr gone.exr
    refuse 2 "no files given" -- merge
    expect 2 "no --out given" -- merge shard-1.exr
    refuse 1 "shard 4/3: must be K/N" -- "$cornell" $small --quiet --shard 4/3
}

# Before the first samples there is nothing to keep: the signal ends the program at once.
"$program" "$cornell" --spp 1 --width 6000 --height 6000 --out never.exr 2>h.txt &
child=$!
sleep 1.5
kill -TERM $child
wait $child
[ $? -eq 143 ] || wrong "early interrupt: exit code, $(cat h.txt)"
[ ! -e never.exr ] || wrong "early interrupt: a picture"

# A link is written through, also one that leads to no file yet.
mkdir -p linked
ln -s linked/new.exr dangling.exr
expect 0 "" -- "$cornell" $small --quiet --out dangling.exr
[ -L dangling.exr ] && [ -s linked/new.exr ] || wrong "a dangling link is not written through"

# What nohup starts goes on after a hangup.
nohup "$program" "$cornell" --spp 4000 --width 64 --height 64 --quiet --out nohup.exr 2>h.txt &
child=$!
sleep 1
kill -HUP $child
wait $child
[ $? -eq 0 ] || wrong "nohup: exit code, $(cat h.txt)"

# A full disk: one line, exit 1, the old picture untouched and nothing left behind.
echo old >kept.exr
(
    ulimit -f 2048 # enough for compiled kernels, too little for the picture
    trap '' XFSZ
    "$program" "$cornell" --spp 4 --quiet --out kept.exr >full.txt 2>&1
)
[ $? -eq 1 ] || wrong "full disk: exit code"
grep -q "kept.exr: cannot be written" full.txt || wrong "full disk: $(cat full.txt)"
[ "$(cat kept.exr)" = old ] || wrong "full disk: the old file is gone"
[ -z "$(ls ./*.part* 2>/dev/null)" ] || wrong "full disk: rest left behind"

[ $failures -eq 0 ] && echo "all as expected"
exit $((failures > 0))
