#!/bin/bash
# kill -9 at random moments: killed.sh PROGRAM ROOT SCRATCH KILLS. Each of three renders is killed that
# often and resumed. It ends with the bits of one that was left alone, and never loses more than what
# was drawn since the last checkpoint: the part that is done, as the next run's first line of progress
# says, does not come down by more than the part of two intervals.
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

# torment NAME FLAGS...: renders once in peace and once with kills.
torment() {
    local name=$1 done_kills=0 reached=0 first child code
    shift
    "$program" "$root/scenes/cornell.obj" --quiet "$@" --out "$name.exr" || wrong "$name in peace"
    while :; do
        "$program" "$root/scenes/cornell.obj" "$@" --checkpoint state --every 0 --resume \
            --out killed.exr 2>said.txt &
        child=$!
        if [ "$done_kills" -lt "$kills" ]; then
            sleep "0.$((RANDOM % 85 + 14))"
            kill -9 $child 2>/dev/null && done_kills=$((done_kills + 1))
        fi
        wait $child 2>/dev/null
        code=$?
        first=$(grep -o '[0-9]* %' said.txt | head -1 | grep -o '[0-9]*')
        # Progress is told at each tenth.
        [ "${first:-100}" -ge "$((reached - 10))" ] || wrong "$name: from $reached % back to $first %"
        reached=$(grep -o '[0-9]* %' said.txt | tail -1 | grep -o '[0-9]*')
        reached=${reached:-0}
        case $name in noise) reached=0 ;; esac # parts of what is expected, which changes
        [ $code -eq 137 ] && continue
        [ $code -eq 0 ] || wrong "$name: exit $code, $(cat said.txt)"
        break
    done
    [ "$(hash_of "$name.exr")" = "$(hash_of killed.exr)" ] || wrong "$name: other bits after $done_kills kills"
    [ ! -e state ] || wrong "$name: the checkpoint is left"
    echo "$name: $done_kills kills"
    rm -f killed.exr state*
}

torment plain --width 64 --height 64 --spp 4096 --aov normal,direct
torment adaptive --width 64 --height 64 --spp 2048 --adaptive --replicates 4
torment noise --width 64 --height 64 --noise 0.001
[ $failures -eq 0 ] && echo "all as expected"
exit $((failures > 0))
