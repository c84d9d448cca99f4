#!/bin/bash
# What becomes of files when a render is interrupted, and where there is no room; progress.
# shellcheck source=tests/cli_support.sh
. "$(dirname "$0")/cli_support.sh"

# Progress: a line per 10 % in a pipe, the last one 100 %.
output=$("$program" "$cornell" --width 64 --height 64 --spp 256 --out g.exr 2>&1 >/dev/null)
[ "$(echo "$output" | grep -c ' %')" -le 11 ] || wrong "too many lines of progress"
case $output in *"100 %"*) ;; *) wrong "never at 100 %: $output" ;; esac

# On a narrow terminal, no longer than it is wide.
output=$(script -qec "stty cols 20; '$program' '$cornell' --width 64 --height 64 --spp 256 --out g.exr" /dev/null)
case $output in *"100 %"*) ;; *) wrong "terminal: $output" ;; esac
longest=$(echo "$output" | tr '\r' '\n' | awk '/ %/ && length > most { most = length } END { print most }')
[ "$longest" -le 19 ] || wrong "a line of progress has $longest columns of 20"

# Ctrl-C, kill, a closed terminal and a spent limit of processor time: what was done is written, with
# true counts, and the exit code says so.
for signal in INT:130 TERM:143 HUP:129 XCPU:152; do
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

# A limit on the size of files is told, and costs no picture.
"$program" "$cornell" --quiet --spp 1 --replicates 1 --width 400 --height 400 --out big.exr
cp big.exr kept.exr
output=$(
    ulimit -f 2048 # PoCL's cache stays below
    "$program" "$cornell" --quiet --spp 1 --replicates 1 --width 400 --height 400 --out big.exr 2>&1
)
[ $? -eq 1 ] || wrong "limit of files: exit code"
case $output in *"File too large"*) ;; *) wrong "limit of files: $output" ;; esac
cmp -s big.exr kept.exr || wrong "limit of files: the picture is lost"

# SIGUSR1 asks for the picture so far; the render goes on, and its checkpoint is gone when it is done.
rm -f h.exr h.txt
"$program" "$cornell" --spp 60000 --width 64 --height 64 --checkpoint state --every 0 --out h.exr 2>h.txt &
child=$!
for _ in $(seq 600); do [ -s state ] && break; sleep 0.05; done
[ -s state ] || wrong "no checkpoint"
kill -USR1 $child
wait $child
[ $? -eq 0 ] || wrong "USR1: exit code"
grep -q "going on; h.exr holds the samples so far" h.txt || wrong "USR1: $(cat h.txt)"
case $(oiiotool --info -v h.exr) in *interrupted*) wrong "USR1: the picture is not complete" ;; esac
[ ! -e state ] || wrong "the checkpoint is left"

# Checkpoints that cannot be written, or are of something else.
# Settings files: what is for all commands, what is not for files, one of them.
printf 'quiet\nspp 2\n' >quiet.flags
expect 0 "" -- "$cornell" --settings quiet.flags --width 8 --height 8 --out one.png
[ -z "$output" ] || wrong "quiet in a settings file: $output"
echo 'settings quiet.flags' >nested.flags
refuse 2 "nested.flags:1: settings: is for the command line only" -- "$cornell" --settings nested.flags
refuse 2 "--settings is given twice" -- "$cornell" --settings quiet.flags --settings quiet.flags
expect 0 "the shard cannot be merged without an .exr among the outputs" -- "$cornell" $small --shard 1/2 --out one.png
printf '\033[31mred 1\n' >red.flags
refuse 2 "red.flags:1: unknown flag --?[31mred" -- "$cornell" --settings red.flags
printf 'r\302\233\302\240\303\251d 1\n' >red.flags # U+009B begins a code, U+00A0 and U+00E9 are letters
refuse 2 $'red.flags:1: unknown flag --r??\302\240\303\251d' -- "$cornell" --settings red.flags
strange=$'str\302\233ange.flags'
echo 'spp 1' >"$strange"
expect 0 "settings from str??ange.flags" -- "$cornell" $small --settings "$strange" --out one.png
case $output in *$'\302\233'*) wrong "a control character in the name of a settings file: $output" ;; esac
# No file is two things: a checkpoint is removed at the end, with the picture of its name.
expect 2 "--checkpoint ./one.exr: is the file of --out, too" -- "$cornell" $small --checkpoint ./one.exr --out one.exr
expect 2 "--gain one.png: is the file of --out, too" -- "$cornell" $small --gain one.png --out "$PWD/one.png"
cp "$cornell" copy.obj
expect 2 "--record copy.obj: is the file of the scene, too" -- copy.obj $small --record copy.obj
expect 2 "--record state2: is the file of --checkpoint, too" -- "$cornell" $small --record state2 --checkpoint state2 --out one.exr
expect 0 "" -- "$cornell" $small --quiet --preview one.png --out one.png
expect 2 "--out ./two.png: is the file of --out, too" -- "$cornell" $small --out two.png --out ./two.png
ln -s two.png link.png
expect 2 "--out two.png: is the file of --out, too" -- "$cornell" $small --out link.png --out two.png
[ ! -e two.png ] || wrong "two outputs in one: a picture"
expect 0 "" -- points --out - --quiet --count 4
# What is read is not written over, be it by the name that the picture has by default.
# spares FILE OWNER -- ARGUMENTS: they are refused, since one of their outputs is the file.
spares() {
    local file=$1 owner=$2
    cp "$file" kept
    expect 2 " $file: is the file of $owner, too; give it another" "${@:3}"
    cmp -s "$file" kept || wrong "$file is written over: ${*:4}"
}
cp "$cornell" scene.exr
spares scene.exr "the scene" -- scene.exr $small
spares scene.exr "the scene" -- scene.exr $small --out other.png --out scene.exr
expect 0 "" -- "$cornell" $small --quiet --out sky.exr --out iris.png
spares sky.exr --environment -- "$cornell" $small --environment ./sky.exr --out sky.exr
spares sky.exr --environment -- "$cornell" $small --environment sky.exr --out other.exr --gain sky.exr
spares scene.exr --to -- "$cornell" $small --to scene.exr --out other.exr --record scene.exr
spares iris.png --aperture -- "$cornell" $small --aperture=iris.png --out iris.png
spares sky.exr --extend -- "$cornell" $small --extend sky.exr --checkpoint sky.exr --out other.exr
spares sky.exr --extend -- "$cornell" $small --extend sky.exr --preview sky.exr --out other.exr
spares sky.exr --reference -- converge "$cornell" $small --reference sky.exr --map sky.exr
echo 'spp 2' >two.exr
spares two.exr "the settings" -- "$cornell" $small --settings two.exr --out two.exr
"$program" points --count 16 --sets 2 --quiet --out points.csv
spares points.csv --in -- points --in points.csv --out points.csv
spares points.csv --in -- spectrum --in points.csv --out - --out points.csv
cp sky.exr sky.0002.exr
spares sky.0002.exr --environment -- "$root/scenes/wheel.gltf" $small --quiet --frames 1,2 --environment sky.0002.exr --out sky.exr
expect 2 "--plot plane.png: is the file of --out, too" -- spectrum --count 16 --sets 2 --out plane.png --plot plane.png
expect 2 "--spectrum a.png: is the file of --out, too" -- slice "$cornell" --pixel 4,4 --out a.png --spectrum a.png
expect 2 "--out ./m.exr: is the file of --out, too" -- merge sky.exr --out m.exr --out ./m.exr
cp "$cornell" .hidden
expect 0 "" -- .hidden $small --quiet
[ -e .hidden.exr ] || wrong "no name for the picture of .hidden"
# Each frame has its files.
expect 0 "" -- "$root/scenes/wheel.gltf" $small --quiet --frames 1,2 --gain gain.png --out frame.png
[ -e frame.0002.png ] && [ -e gain.0001.png ] && [ -e gain.0002.png ] || wrong "files of frames: $(ls)"
refuse 1 "$cornell: is no EXR file, as clshear writes them" -- "$cornell" --quiet --extend "$cornell"
refuse 2 "resume: needs a checkpoint" -- "$cornell" --quiet --resume
refuse 1 "--checkpoint no/such/state: folder no/such/ cannot be written" -- "$cornell" --quiet --checkpoint no/such/state
echo "not a checkpoint" >state
refuse 2 "state: is there already" -- "$cornell" --quiet --checkpoint state
refuse 1 "state: is no whole checkpoint" -- "$cornell" --quiet --checkpoint state --resume
rm -f state

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

# Where hangups are ignored, as nohup has it, they stay so while the driver compiles its kernels anew.
mkdir compiled
trap '' HUP
POCL_CACHE_DIR=$PWD/compiled "$program" "$cornell" $small --quiet --out nohup.exr 2>h.txt &
child=$!
trap - HUP
while kill -HUP $child 2>/dev/null; do sleep 0.02; done
wait $child
[ $? -eq 0 ] || wrong "nohup: exit code, $(cat h.txt)"

# A reader of what is printed that leaves costs no picture.
rm -f piped.exr
# shellcheck disable=SC2086
"$program" "$cornell" $small --spp 1024 --out piped.exr 2>&1 | head -1 >piped.txt
[ "${PIPESTATUS[0]}" -eq 0 ] && [ -s piped.exr ] || wrong "a reader that leaves ends the render: $(cat piped.txt)"

# What is printed does not go into the files of a program whose standard streams are closed.
# shellcheck disable=SC2086
{
    expect 0 "" -- "$cornell" $small --threads 1 --record open.capsule --out open.exr
    "$program" "$cornell" $small --threads 1 --record closed.capsule --out closed.exr 2>&- <&-
    cmp -s open.capsule closed.capsule || wrong "progress is written into a file"
    "$program" "$cornell" $small --quiet --stats --out closed.exr 2>closed.txt >&-
    case $?$(cat closed.txt) in 1*"standard output: cannot be written"*) ;; *) wrong "closed output: $(cat closed.txt)" ;; esac
}

# A file that may not be written is not replaced, though its folder would allow it.
mkdir -m 777 open
cp "$cornell" open
echo kept >open/kept.png
chmod 444 open/kept.png
user=()
[ "$(id -u)" -ne 0 ] || user=(setpriv --reuid 65534 --regid 65534 --clear-groups)
if "${user[@]}" test -w open && "${user[@]}" test -x "$program"; then
    # shellcheck disable=SC2086
    output=$(POCL_CACHE_DIR=$PWD/open/cache "${user[@]}" "$program" open/cornell.obj $small --quiet --out open/kept.png 2>&1)
    case $?$output in 1*"--out open/kept.png: cannot be written: Permission denied"*) ;; *) wrong "a protected file: $output" ;; esac
    [ "$(cat open/kept.png)" = kept ] || wrong "a protected file is replaced"
fi

# A file that is replaced hands on its owner, its group and its permissions. Where the group cannot be
# given, the new group and others get the rights that both classes had.
# replaced OWNER:GROUP MODE WORDS [SETPRIV'S FLAGS]: the file before, and what stat says of it after.
replaced() {
    local before="$1 $2" words=$3
    echo old >open/kept.txt
    chown "$1" open/kept.txt
    chmod "$2" open/kept.txt
    output=$(setpriv "${@:4}" "$program" points --n 4 --out open/kept.txt 2>&1) || wrong "replacing $before: $output"
    output=$(stat -c '%u:%g %a' open/kept.txt)
    [ "$output" = "$words" ] || wrong "$before became $output, not $words"
    [ "$(cat open/kept.txt)" != old ] || wrong "$before is not replaced"
}
if [ "$(id -u)" -ne 0 ]; then
    echo "skipped: files of other owners, which only root can make"
elif ! "${user[@]}" test -x "$program"; then
    echo "skipped: files of other owners, who may not run $program"
else
    other=(--reuid 65534 --regid 65534)
    replaced 65534:65533 640 "65534:65533 640"
    replaced 65534:65533 640 "65534:65534 600" "${other[@]}" --clear-groups
    replaced 65534:65533 654 "65534:65534 644" "${other[@]}" --clear-groups
    replaced 65534:65533 640 "65534:65533 640" "${other[@]}" --groups 65533
    replaced 0:65533 660 "65534:65533 660" "${other[@]}" --groups 65533
    replaced 0:65533 606 "65534:65534 600" "${other[@]}" --clear-groups
fi

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

finish
