# shellcheck shell=bash
# Shared by the tests of the program: their arguments, a scratch folder, and what is expected.
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

# finish: says how it went, by the exit code too.
finish() {
    [ $failures -eq 0 ] && echo "all as expected"
    exit $((failures > 0))
}
