#!/bin/bash
# What the program says of PoCL's cache of kernels when it is damaged or full, and that deleting it
# helps; and of what else ends the process in PoCL: pocl_cache.sh PROGRAM ROOT SCRATCH. Skipped with
# other drivers.
set -u
program=$1 scene=$2/scenes/cornell.obj scratch=$3 failures=0
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1
export POCL_CACHE_DIR=$scratch/kernels
"$program" --list-devices | grep -q "pthread" || exit 77

wrong() {
    echo "wrong: $*"
    failures=$((failures + 1))
}

render() {
    output=$("$program" "$scene" --width 16 --height 16 --spp 4 --quiet --out out.exr 2>&1)
    code=$?
}

# refused WORDS: the last render failed in one line with them.
refused() {
    [ $code -eq 1 ] || wrong "exit $code: $output"
    [ "$(echo "$output" | wc -l)" -eq 1 ] || wrong "more than one line: $output"
    case $output in *"$1"*) ;; *) wrong "no \"$1\" in: $output" ;; esac
}

kernels() {
    find "$POCL_CACHE_DIR" -name 'cs_*.so'
}

# damage COMMAND: changes every cached kernel.
damage() {
    rm -rf "$POCL_CACHE_DIR"
    render
    [ $code -eq 0 ] || wrong "a new cache: $output"
    [ -n "$(kernels)" ] || wrong "no kernels in the cache"
    kernels | while read -r kernel; do "$1" "$kernel"; done
    render
    refused "delete the folder $POCL_CACHE_DIR"
}

shorten() { truncate -s 3000 "$1"; }
empty() { truncate -s 0 "$1"; }
replace() { echo junk >"$1"; }
damage shorten
damage empty
damage replace
rm -rf "$POCL_CACHE_DIR"
render
[ $code -eq 0 ] || wrong "after deleting it: $output"

# Kernels of others are not looked at.
mkdir -p "$POCL_CACHE_DIR/AB/CDEF/other/8-1-1"
echo junk >"$POCL_CACHE_DIR/AB/CDEF/other/8-1-1/other.so"
render
[ $code -eq 0 ] || wrong "another program's kernel: $output"

# Without a linker: nothing works with an empty cache, all with a full one.
rm -rf "$POCL_CACHE_DIR"
keep=$PATH PATH=/none
render
PATH=$keep
case $output in
*"which is in no folder of \$PATH"*)
    refused "PoCL links the kernels with ld"
    output=$(env -u PATH "$program" "$scene" --width 16 --height 16 --spp 4 --quiet --out out.exr 2>&1)
    code=$?
    refused "\$PATH is not set: set it to /usr/bin"
    ;;
*) [ $code -eq 0 ] || wrong "without ld: $output" ;; # of another PoCL than Debian's, which needs none
esac
render
PATH=/none
render
PATH=$keep
[ $code -eq 0 ] || wrong "kernels are there, ld is not: $output"

# Variables of PoCL with values for which it ends the process, or has no device.
# with VARIABLE=VALUE WORDS
with() {
    output=$(export "$1" && "$program" "$scene" --width 16 --height 16 --spp 4 --quiet --out out.exr 2>&1)
    code=$?
    refused "$2"
}
with POCL_CACHE_DIR= "\$POCL_CACHE_DIR is empty, for which PoCL would end the process if it is among the drivers: unset it"
with POCL_MAX_PTHREAD_COUNT=-1 "\$POCL_MAX_PTHREAD_COUNT is \"-1\", for which PoCL would end the process if it is among the drivers: unset it"
with POCL_MAX_PTHREAD_COUNT=99999999999999999999 "set it to a number from 0 to 4096"
with POCL_MAX_WORK_GROUP_SIZE=none "\$POCL_MAX_WORK_GROUP_SIZE is \"none\""
with POCL_DEVICES=toaster "\$POCL_DEVICES is \"toaster\": unset it"

# The limit of the stack is that of the first thread, not of PoCL's.
output=$(ulimit -s 256 && "$program" "$scene" --width 16 --height 16 --spp 4 --quiet --out out.exr 2>&1) ||
    wrong "a small stack: $output"

# A driver that does not fit into the memory that is allowed.
output=$(ulimit -v 600000 && "$program" "$scene" --spp 4 --quiet --out out.exr 2>&1) && wrong "within 600 MB"
case $output in *"memory is limited to 585 MB (ulimit -v)"* | *"shared libraries"* | *Sanitizer*) ;; *) wrong "600 MB: $output" ;; esac

rm -rf "$POCL_CACHE_DIR"
output=$(ulimit -f 0 && trap '' XFSZ && "$program" "$scene" --spp 4 --quiet --out out.exr 2>&1 | tail -n 1)
case $output in *"in its cache: make room there"*"$POCL_CACHE_DIR"*) ;; *) wrong "full: $output" ;; esac

[ $failures -eq 0 ] && echo "all as expected"
exit $((failures > 0))
