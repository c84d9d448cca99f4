#!/bin/bash
# kill -9 at random moments: killed.sh PROGRAM ROOT SCRATCH KILLS. Each of three renders is killed that
# often and resumed, and begun anew where it ends before. It ends with the bits of one that was left alone,
# and never loses more than what was drawn since the last checkpoint: the part that is done, as the first
# line of progress of the next run says, does not come down by more than a tenth, in which progress is told.
# Moments are counted in the processor's time of the program, so that the test does the same on a machine
# that is busy: it needs half a second to begin, and some seconds to end.
set -u
program=$(realpath "$1") root=$2 scratch=$3 kills=$4
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1
RANDOM=17
failures=0

wrong() {
    echo "FAILED: $1"
    failures=$((failures + 1))
}

hash_of() { iinfo --hash "$1" | grep -o '[0-9A-F]\{40\}'; }

# percents: the parts that lines of progress have told, at each tenth; not the zero of pilots.
percents() { grep -o '^clshear: *[0-9]* %' said.txt | grep -o '[0-9]*' | grep -vx 0; }

# kill_after TICKS: kills the child when it has used so many hundredths of a second, if it lives so long.
kill_after() {
    local ticks=0 fields
    while [ "$ticks" -lt "$1" ]; do
        read -ra fields 2>/dev/null </proc/$child/stat || return 0
        [ "${fields[2]}" != Z ] || return 0
        ticks=$((fields[13] + fields[14]))
        sleep 0.01
    done
    kill -9 "$child" 2>/dev/null
}

# go_on NAME KILLS_LEFT FLAGS...: one run from the checkpoint on, killed if kills are left. Returns its code.
go_on() {
    local name=$1 left=$2 first code
    shift 2
    "$program" "$root/scenes/cornell.obj" "$@" --checkpoint state --every 0 --resume --out killed.exr \
        2>said.txt &
    child=$!
    [ "$left" -eq 0 ] || kill_after $((RANDOM % 150 + 5))
    wait $child 2>/dev/null
    code=$?
    first=$(percents | head -1)
    [ "${first:-100}" -ge "$((reached - 10))" ] || wrong "$name: from $reached % back to $first %"
    reached=$(percents | tail -1 | grep . || echo "$reached")
    case $name in noise) reached=0 ;; esac # parts of what is expected, which changes
    return $code
}

# torment NAME FLAGS...: renders once in peace and then with kills.
torment() {
    local name=$1 killed=0 pictures=0 reached=0 child code
    shift
    "$program" "$root/scenes/cornell.obj" --quiet "$@" --out "$name.exr" || wrong "$name in peace"
    while [ $killed -lt "$kills" ] || [ $pictures -eq 0 ] || [ -e state ]; do
        go_on "$name" $((kills - killed)) "$@"
        code=$?
        if [ $code -eq 137 ]; then
            killed=$((killed + 1))
            [ -e state ] && continue
            # Before the first checkpoint, or after the picture and before the end of the program.
            [ "$reached" -lt 50 ] || [ "$(hash_of "$name.exr")" = "$(hash_of killed.exr)" ] ||
                wrong "$name: neither checkpoint nor picture after $reached %"
            reached=0
            continue
        fi
        [ $code -eq 0 ] || { wrong "$name: exit $code, $(cat said.txt)"; break; }
        [ "$(hash_of "$name.exr")" = "$(hash_of killed.exr)" ] || wrong "$name: other bits after $killed kills"
        [ ! -e state ] || { wrong "$name: the checkpoint is left"; break; }
        pictures=$((pictures + 1)) reached=0
        rm -f killed.exr
    done
    echo "$name: $killed kills, $pictures pictures of the same bits"
    rm -f killed.exr state*
}

torment plain --width 64 --height 64 --spp 4096 --adaptive=0 --aov normal,direct
torment adaptive --width 64 --height 64 --spp 2048 --adaptive --replicates 4
torment noise --width 64 --height 64 --noise 0.001
[ $failures -eq 0 ] && echo "all as expected"
exit $((failures > 0))
