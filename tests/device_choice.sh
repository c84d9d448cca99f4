#!/bin/bash
# Which device is chosen, how it is tested before its first render, and what GPUs are given. The devices
# are PoCL's; tests/fault.c lets them say and compute other things.
# shellcheck source=tests/cli_support.sh
. "$(dirname "$0")/cli_support.sh"
"$program" --list-devices | grep -q "^0: pthread" || exit 77
replay=$(realpath "$4")
cc -shared -fPIC -O1 "$root/tests/fault.c" -o fault.so -ldl || exit 1
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-${XDG_CACHE_HOME:-$HOME/.cache}/pocl/kcache}
export XDG_CACHE_HOME=$scratch/cache
export POCL_MAX_PTHREAD_COUNT=2 # compute units of "pthread", whatever the machine and its user say; "basic" has one
quiet="$small --quiet"

# with FAULT DEVICES CODE WORDS -- ARGUMENTS: as expect, under a fault and with these devices of PoCL.
with() {
    export FAULT=$1 POCL_DEVICES=$2 LD_PRELOAD=$scratch/fault.so
    expect "${@:3}"
    unset FAULT POCL_DEVICES LD_PRELOAD
}
chosen() { # WORDS: the device that the last capsule was recorded on
    output=$("$replay" film.capsule 2>&1) || wrong "the capsule differs: $output"
    case "$output" in *"capsule: clshear "*" on $1"*) ;; *) wrong "not on $1: $output" ;; esac
}
capsule="$cornell $quiet --out film.exr --record film.capsule"

with bits pthread 1 "fails its test: coordinate 0 of sample 0 of sz is" -- $cornell $quiet --out film.exr
[ ! -e cache/clshear/devices ] || wrong "a device that fails is kept as good"
with bits pthread 0 "fails its test" -- $cornell $small --out film.exr --force
[ ! -e cache/clshear/devices ] || wrong "a device that is forced is kept as good"
with none pthread 0 "" -- $cornell $quiet --out film.exr
[ "$(cat cache/clshear/devices/* | grep -c passed)" -eq 1 ] || wrong "a device that passes is not kept"
with none "basic pthread" 0 "" -- $capsule
chosen pthread # more of the processor
with gpu "pthread basic" 0 "" -- $capsule
POCL_DEVICES=basic chosen basic # a GPU, though a small one
grep -aq -- "-DCS_PACKET=1 .*-DCS_WORK_GROUP=64" film.capsule || wrong "a GPU without its options"
with gpu "pthread basic" 0 "" -- $capsule --device pthread
chosen pthread
CLSHEAR_DEVICE=pthread with gpu "pthread basic" 0 "" -- $capsule
chosen pthread
with emulator pthread 1 "no OpenCL device but an emulator" -- $cornell $quiet --out film.exr
with emulator pthread 0 "" -- $cornell $quiet --out film.exr --device 0
with small pthread 1 "a buffer of 8 MB is too large (the device allows 1 MB)" -- $cornell $quiet --out film.exr
CLSHEAR_DEVICE=toaster expect 1 'no OpenCL device is called "toaster"; there are: 0' -- $cornell $quiet --out film.exr
finish
