#!/bin/bash
# Capsules: what --record writes, tools/replay.c runs again to the bit on the same device; damaged ones
# are refused.
# shellcheck source=tests/cli_support.sh
. "$(dirname "$0")/cli_support.sh"
replay=$(realpath "$4")

# same LINE -- ARGUMENTS: records a render, and replays it with this result.
same() {
    local line=$1
    shift 2
    expect 0 "" -- "$cornell" --width 64 --height 64 --spp 16 --quiet --out film.exr --record one.capsule "$@"
    output=$("$replay" one.capsule 2>&1) || wrong "replay fails after $*: $output"
    case "$output" in
    *"$line"*) ;;
    *) wrong "replay after $*: no \"$line\" in: $output" ;;
    esac
}
same "equal, bit by bit" --
[ "$(stat -c %s one.capsule)" -lt 2000000 ] || wrong "the capsule is large"
cp one.capsule whole.capsule
same "equal, bit by bit" -- --bounces 0 --packet 4 --aov albedo
same "equal, bit by bit" -- --adaptive --spp 64

# spoiled WORDS COMMAND: refused with one line that has these words.
spoiled() {
    local words=$1
    shift
    "$@" <whole.capsule >bad.capsule
    output=$("$replay" bad.capsule 2>&1)
    [ $? -eq 1 ] || wrong "$*: is not refused"
    [ "$(echo "$output" | wc -l)" -eq 1 ] || wrong "$*: several lines: $output"
    case "$output" in *"$words"*) ;; *) wrong "$*: no \"$words\" in: $output" ;; esac
}
flip() { # the byte at this place
    head -c "$1" whole.capsule && printf '\377' && tail -c +"$(($1 + 2))" whole.capsule
}
spoiled "no capsule" head -c 3
spoiled "no capsule" cat "$root/README.md"
spoiled "checksum" head -c 100000
spoiled "checksum" flip 2000
spoiled "checksum" flip 690000
spoiled "another version" sed '1s/CLSHCAP1/CLSHCAP2/'

# With other kernels, here without bounces, the picture is another, and replay says so.
"$replay" whole.capsule --options "-UCS_FEATURES -DCS_FEATURES=8" >different 2>&1
[ $? -eq 1 ] || wrong "other kernels are not told: $(cat different)"

# One file, one line.
cc -std=c17 -Wall -Wextra -Wpedantic -Werror "$root/tools/replay.c" -lOpenCL -lm -o own 2>&1 ||
    wrong "tools/replay.c does not compile by itself"
[ "$(./own whole.capsule | tail -n 1)" = "equal, bit by bit" ] || wrong "it does not replay by itself"

refuse 2 "--record is of one picture" -- "$cornell" --quiet --frames 0,1 --record one.capsule
refuse 1 "none/ cannot be written" -- "$cornell" --quiet --record none/one.capsule
finish
