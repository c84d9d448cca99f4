#!/bin/bash
# The program as a person drives it: flags, errors, exit codes, renders, metadata.
# shellcheck source=tests/cli_support.sh
. "$(dirname "$0")/cli_support.sh"

# Help, version, devices.
expect 0 "usage: clshear SCENE" -- --help
[ "$(echo "$output" | awk '{ if (length > 80) print }' | wc -l)" -eq 0 ] || wrong "help wider than 80"
expect 0 "clshear 0." -- --version
expect 0 "--spp N" -- --print-settings md
cmp -s <(echo "$output") <("$program" --print-settings md) || wrong "the reference changes"
expect 0 '.TH CLSHEAR 1' -- --print-settings man
expect 2 "--print-settings html: must be md or man" -- --print-settings html
expect 0 "0: " -- --list-devices

# Wrong usage: 2.
refuse 2 "no scene given" --
refuse 2 "did you mean --fov?" -- "$cornell" --fvo 30
refuse 2 "did you mean --spp?" -- "$cornell" --sp 30
refuse 2 "unknown flag --zzzzzzzzzz" -- "$cornell" --zzzzzzzzzz
refuse 2 "unknown flag -x; see" -- "$cornell" -x
refuse 2 "did you mean --threads?" -- "$cornell" --thr 1
refuse 2 "unknown flag --no-adaptive; did you mean --adaptive=0?" -- "$cornell" --no-adaptive
expect 2 "did you mean --help?" -- help
cp "$cornell" ./-dash.obj
expect 0 "" -- --width 8 --height 8 --spp 1 --out dash.exr -- -dash.obj
refuse 2 "--spp 0: must be a whole number" -- "$cornell" --spp 0
refuse 2 "--spp 1e99: must be" -- "$cornell" --spp 1e99
refuse 2 "--spp -4: must be" -- "$cornell" --spp -4
refuse 2 "--eye 1,2: must be three numbers" -- "$cornell" --eye 1,2
refuse 2 "--eye 1,2,nan: must be" -- "$cornell" --eye 1,2,nan
refuse 2 "--eye 1, 2 3: must be three numbers" -- "$cornell" --eye "1, 2 3"
refuse 2 "--aov albedo normal: must be" -- "$cornell" --aov "albedo normal"
expect 0 "" -- "$cornell" --quiet --eye "1 , 2,	3" --aov "albedo, normal" --environment "1 , 1, 1" --frames "0, 0" \
    --width 8 --height 8 --spp 1 --out blanks.exr
case $(oiiotool --info -v blanks.0000.exr) in *'clshear.eye: "1,2,3"'*) ;; *) wrong "blanks after commas" ;; esac
refuse 2 "--fov 180: must be" -- "$cornell" --fov 180
refuse 2 "--shear sideways: must be none, toroidal or equal-area" -- "$cornell" --shear sideways
refuse 2 "--packet 3: must be" -- "$cornell" --packet 3
refuse 2 "--quiet takes no value" -- "$cornell" --quiet=yes
refuse 2 "more than one scene" -- "$cornell" "$cornell"
refuse 2 "--aperture heart: must be disk, square, polygon or an image file" -- "$cornell" --aperture heart
expect 0 "--fstop is not used: --lens-radius comes after it" -- "$cornell" --fstop 2 --lens-radius 3 --width 8 --height 8 --spp 1 --out pair.exr
expect 0 "--focus-pixel is not used: --focal-distance" -- "$cornell" --focus-pixel 3,3 --focal-distance 1000 --width 8 --height 8 --spp 1 --out pair.exr
for idle in "--unit 0.001" --tone=agx "--exposure 1" --auto-exposure "--every 3" "--environment-rotation 3" "--blade-rotation 9" \
    "--shear none --oracle near" "--fps 30" "--bounces 0 --clamp 2" "--shutter-ramps 0.1,0.1" "--blades 5 --aperture disk"; do
    # shellcheck disable=SC2086
    expect 0 " is not used: it needs" -- "$cornell" $idle --width 8 --height 8 --spp 1 --out pair.exr
done
output=$("$program" "$cornell" --unit 0.001 --fstop 2 --tone agx --exposure 1 --width 8 --height 8 --spp 1 --out pair.png --out pair.exr 2>&1)
case $output in *"it needs"*) wrong "flags with a use: $output" ;; esac
refuse 2 "--blades 2: must be" -- "$cornell" --blades 2
refuse 2 "--anamorphic 0: must be" -- "$cornell" --anamorphic 0
refuse 2 "--filter lanczos: must be box" -- "$cornell" --filter lanczos
refuse 2 "--filter-width 0: must be" -- "$cornell" --filter-width 0
refuse 2 "the scene's name is empty: give the file" -- ""
for flag in gain extend settings environment to device record checkpoint display preview camera aperture; do
    refuse 2 "--$flag is empty: give " -- "$cornell" --quiet --spp 1 --width 8 --height 8 --$flag ""
done
expect 2 "--out is empty: give FILE, or leave it out" -- "$cornell" --out=
expect 2 "--out needs a value" -- "$cornell" --out
expect 2 "--out picture.bmp: must be a name that ends in" -- "$cornell" --out picture.bmp
expect 2 "--out .png: must be a name that ends in" -- "$cornell" --out .png

# Failures: 1.
refuse 1 "nowhere.obj: cannot be opened: No such file" -- nowhere.obj
refuse 1 "no OpenCL device is called \"toaster\"; there are: 0 " -- "$cornell" --quiet --device toaster
refuse 2 "--crop 0,0,0,0: must be four whole numbers, X0,X1,Y0,Y1, with X0 < X1" -- "$cornell" --crop 0,0,0,0
refuse 2 "crop 0,99,0,9" -- "$cornell" --quiet --width 32 --height 32 --crop 0,99,0,9
refuse 2 "focus-pixel 40,2 is outside the 32 x 32 image: give X 0 to 31 and Y 0 to 31" -- "$cornell" --quiet --width 32 --height 32 --focus-pixel 40,2
refuse 2 "replicates" -- "$cornell" --quiet --spp 2 --replicates 3
expect 1 "folder no/such/ cannot be written" -- "$cornell" --out no/such/folder.exr
output=$(OCL_ICD_VENDORS=/nonexistent "$program" "$cornell" --quiet --out refused.exr 2>&1)
case $?$output in 1*"no OpenCL device found; install"*"unset \$OCL_ICD_VENDORS"*) ;; *) wrong "no driver: $output" ;; esac
for files in 4 5 6 7 8; do # with too few, the program is not loaded either
    output=$(ulimit -n $files && "$program" "$cornell" --quiet --spp 4 --width 8 --height 8 --out few.exr 2>&1)
    case $?$output in 127*"shared libraries"* | 1*"may have $files files open (ulimit -n)"* | 0) ;; *) wrong "few files: $output" ;; esac
done

# Full outputs and formats that are too small.
output=$("$program" --list-samplers 2>&1 >/dev/full)
case $?$output in 1*"standard output: cannot be written"*) ;; *) wrong "/dev/full: $output" ;; esac
expect 1 "environment 1,2: neither R,G,B nor a file" -- "$cornell" --quiet --environment 1,2 --out refused.exr
echo text >words.hdrx
expect 1 "words.hdrx: not an image that can be read" -- "$cornell" --quiet --environment words.hdrx --out refused.exr
refuse 2 "sun: its direction has no length" -- "$cornell" --quiet --sun 0,0,0,1,1,1,1
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
    expect 0 "fewer --lens-rays take less" -- "$cornell" --width 64 --height 64 --spp 1 --replicates 1 \
        --lens-rays 256 --bounces 0 --stats --out b.exr
    expect 0 "rays " -- "$cornell" $small --stats --out b.exr
    for word in "bounds       -3.2,0,-559.2 to 552.8,548.8,0" "size         556 x 548.8 x 559.2, diagonal 960.7" \
        "focus        at depth 930" "lens         radius 25, f/" "px at infinity"; do
        case $output in *"$word"*) ;; *) wrong "no \"$word\" in: $output" ;; esac
    done
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
    mkdir -p apart/deeper
    cp "$cornell" apart/s.obj
    oiiotool --create 8x4 3 --fill:color=1,0,0 8x4 -o apart/sky.exr --create 8x4 3 --fill:color=0,1,0 8x4 -o sky.exr \
        --create 8x8 1 --fill:color=1 8x8 -o apart/deeper/iris.png --create 8x4 3 -o here.exr
    printf 'environment sky.exr\naperture deeper/iris.png\nto s.obj\n' >apart/s.flags
    expect 0 "" -- apart/s.obj $small --quiet --eye 276,274,800 --out d.exr
    info=$(oiiotool --info -v d.exr)
    case $info in *'clshear.environment: "apart/sky.exr"'*) ;; *) wrong "a sky beside the flags: $info" ;; esac
    echo 'environment here.exr' >apart/s.flags
    expect 0 "" -- apart/s.obj $small --quiet --eye 276,274,800 --out d.exr
    echo 'environment 0.5,0.5,0.5' >apart/s.flags
    expect 0 "" -- apart/s.obj $small --quiet --eye 276,274,800 --out d.exr
    refuse 1 "gone.flags: cannot be read" -- "$cornell" --settings gone.flags
    refuse 1 "/dev/zero: is no settings file" -- "$cornell" --settings /dev/zero
    expect 0 "" -- "$cornell" $small --quiet --settings <(echo "width 8") --out d.exr
}

# Apertures and filters, with what tells them in the metadata.
oiiotool --create 8x8 1 --fill:color=0 8x8 -o dark.exr --create 300x200 3 --fill:color=1,1,1 300x200 \
    -o bright.exr
# shellcheck disable=SC2086
{
    refuse 1 "gone.png" -- "$cornell" --quiet --aperture gone.png
    refuse 1 "aperture image: all black" -- "$cornell" --quiet --aperture dark.exr
    refuse 2 "the toroidal shear knows square and disk" -- "$cornell" --quiet --blades 5 --shear toroidal
    expect 0 "" -- "$cornell" $small --quiet --aperture ./bright.exr --filter tent --out l.exr
    expect 0 "" -- "$cornell" $small --quiet --aperture disk --blades 5 --blade-rotation 10 \
        --anamorphic 2 --filter gaussian --filter-width 2.5 --out l.exr
    info=$(oiiotool --info -v l.exr)
    for word in 'aperture: "polygon"' 'blades: 5' 'bladeRotation: 10' 'anamorphic: 2' \
        'filter: "gaussian"' 'filterWidth: 2.5'; do
        case $info in *"clshear.$word"*) ;; *) wrong "no $word in the metadata" ;; esac
    done
}

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

# Half a camera: the other half is told, and may be copied.
# shellcheck disable=SC2086
{
    expect 0 "no target given, the camera looks near the middle of the scene: --target " -- bare.obj $small --eye 1,2,5 \
        --out half.exr
    target=$(echo "$output" | sed -n 's/.*no target given.*--target //p')
    expect 0 "" -- bare.obj $small --eye 1,2,5 --target "$target" --out copied.exr
    case $output in *"no target"*) wrong "a target that is given is told: $output" ;; esac
    cmp -s <(oiiotool --dumpdata half.exr | tail -n +2) <(oiiotool --dumpdata copied.exr | tail -n +2) ||
        wrong "the target that is told is another"
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
# Parallel lines of sight, a tilted focal plane.
# shellcheck disable=SC2086
{
    expect 0 "--orthographic 2.16" -- bare.obj $small --orthographic 0 --orbit 0,0 --out k.exr
    expect 0 "--fov is not used: --orthographic comes after it" -- bare.obj $small --fov 30 --orthographic 3 --out k.exr
    refuse 2 "--tilt 90,0: must be two numbers" -- bare.obj --tilt 90,0
    refuse 2 "shutter 1,0: closes before it opens" -- bare.obj --shutter 1,0
    refuse 2 "tilt 80,0: at focal distance" -- bare.obj --quiet --orthographic 9 --focal-distance 2 --tilt 80,0
    expect 0 "--aov is not used: it needs an .exr among the outputs" -- bare.obj $small --aov albedo --out k.png
    expect 0 "--extendable is not used: it needs an .exr" -- bare.obj $small --extendable --out k.png
    expect 0 "" -- bare.obj $small --aov albedo --out k.png --out k.EXR
    case $output in *"--aov"*) wrong "a remark on channels that are kept: $output" ;; esac
}
# Pictures that cannot be meant are remarked on; others are not.
remarks="black|thousandth|brighter|everything is in focus"
# shellcheck disable=SC2086
{
    expect 0 "black: the camera does not see" -- bare.obj $small --eye 0,0,1e5 --target 0,0,2e5 \
        --light 0,0,9,1,1,1 --out k.exr
    expect 0 "does not see the scene, only what is around it" -- bare.obj $small --eye 0,0,9 --target 0,0,20 --out k.exr
    far="--eye 0,0,300 --target 0,0,0 --width 128 --height 128 --spp 2"
    expect 0 "the scene fills less than a thousandth of the picture, the rest is black; --orbit 0,0" -- bare.obj $far \
        --light 0,0,9,99,99,99 --out k.exr
    expect 0 "the scene fills less than a thousandth of the picture; --orbit" -- bare.obj $far --environment 1,1,1 --out k.exr
    expect 0 "" -- bare.obj $far --crop 60,128,0,128 --light 0,0,9,99,99,99 --out k.exr
    case $output in *thousandth*) wrong "a remark on a crop: $output" ;; esac
    expect 0 "black: no light reaches" -- bare.obj $small --light 1e6,1e6,1e6,0,0,0 --out k.exr
    expect 0 "--exposure -9 or --auto-exposure" -- bare.obj $small --environment 99,99,99 \
        --out k.exr
    expect 0 "" -- bare.obj $small --environment 99,99,99 --exposure -8 --out k.png
    if echo "$output" | grep -qE "$remarks"; then wrong "a remark on a dark exposure: $output"; fi
    expect 0 "of the scene is brighter than white" -- bare.obj $small --eye 0,0,30 --target 0,0,0 --light 0,0,9,1e6,1e6,1e6 --out k.exr
    expect 0 "nearly black in all but .exr; --exposure 1" -- bare.obj $small --environment 1e-4,1e-4,1e-4 --out k.exr
    expect 0 "nearly black in all but .exr; --exposure 1" -- bare.obj $small --environment 1e-4,0,0 --out k.exr
    expect 0 "" -- bare.obj $small --environment 1e-4,1e-4,1e-4 --exposure 12 --out k.png
    if echo "$output" | grep -qE "$remarks"; then wrong "a remark on a bright exposure: $output"; fi
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
    'renderTimeSeconds: ' 'worldToCamera: ' 'worldToNDC: ' 'screenWindowWidth: 0.6498' 'clshear.focalDistance: 930' 'clshear.device: "' \
    'clshear.driver: "' 'Variance.R' 'SampleVariance.B' 'Samples' 'Shear'; do
    case $info in *"$word"*) ;; *) wrong "no $word in the metadata" ;; esac
done
case $info in *"float openexr"*) ;; *) wrong "not float32" ;; esac

# Samplers: every name renders; a number that a sampler has not is raised, and said.
expect 0 "sobol-pairs" -- --list-samplers
echo "$output" | awk 'length > 80 { exit 1 }' || wrong "a line of --list-samplers is wider than 80"
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

# The oracle: rules, sharing out, and what the shear gains as a picture.
# shellcheck disable=SC2086
{
    refuse 2 "--oracle delphi: must be centre, median, near, far, pilot or edge" -- "$cornell" --oracle delphi
    expect 0 "" -- "$cornell" --width 32 --height 32 --spp 128 --quiet --adaptive --gain gain.png \
        --out gain.exr
    [ -s gain.png ] || wrong "no picture of the gain"
    case $(oiiotool --info -v gain.exr) in *"clshear.adaptive: 1"*) ;; *) wrong "adaptive untold" ;; esac
    case $output in *"Gain"*) wrong "said something" ;; esac
    refuse 2 "--gain gain.bmp: must be a name that ends in" -- "$cornell" --quiet --gain gain.bmp
    refuse 2 "cannot be extended" -- "$cornell" $small --quiet --adaptive --extendable
}

# A render goes on where it ended, and says so when it cannot.
# shellcheck disable=SC2086
{
    expect 0 "" -- "$cornell" $small --quiet --extendable --out more.exr
    expect 0 "" -- "$cornell" $small --quiet --extend more.exr --spp 64 --out more.exr
    case $(oiiotool --info -v more.exr) in *"samplesPerPixel: 64"*) ;; *) wrong "not extended" ;; esac
    refuse 2 "more.exr: was made with another seed" -- "$cornell" $small --quiet --extend more.exr --spp 128 --seed 4
    refuse 2 "more.exr: has 64 samples per pixel already" -- "$cornell" $small --quiet --extend more.exr
    refuse 2 "more.exr: shows other pixels" -- "$cornell" $small --quiet --extend more.exr --spp 128 --crop 0,8,0,8
    refuse 2 "more.exr: has no channel Albedo.R" -- "$cornell" $small --quiet --extend more.exr --spp 128 --aov albedo
    refuse 2 "more.exr: an adaptive render cannot extend it" -- "$cornell" $small --quiet --extend more.exr --spp 128 --adaptive
    refuse 2 "more.exr: sampler mj cannot extend it" -- "$cornell" $small --quiet --extend more.exr --spp 128 --sampler mj
    refuse 2 "more.exr: a shard cannot extend it" -- "$cornell" $small --quiet --extend more.exr --spp 128 --shard 1/2
    refuse 1 "a.exr: lacks the means of its patterns; it must be a complete EXR rendered with --extendable" -- \
        "$cornell" $small --quiet --extend a.exr --spp 128
    refuse 1 "gone.exr" -- "$cornell" $small --quiet --extend gone.exr --spp 128
}

# Rules that end a render say what they promised.
# shellcheck disable=SC2086
{
    expect 0 "ended by --noise at" -- "$cornell" $small --spp 4096 --noise 0.05 --out rule.exr
    expect 0 "would take about" -- "$cornell" $small --spp 64 --noise 0.0001 --out rule.exr
    case $(oiiotool --info -v rule.exr) in *'clshear.stoppedBy: "spp"'*) ;; *) wrong "rule untold" ;; esac
    refuse 2 "needs 2 replicates" -- "$cornell" $small --quiet --noise 0.1 --replicates 1
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
    refuse 2 "a file's name is empty: give the file" -- merge some.exr ""
    expect 2 "no --out given" -- merge shard-1.exr
    refuse 2 "shard 4/3: must be K/N" -- "$cornell" $small --quiet --shard 4/3
}

finish
