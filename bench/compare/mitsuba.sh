#!/bin/bash
# clshear against Mitsuba 3 (llvm_ad_rgb) with the same scenes, cameras, lenses and lights: whether
# the pictures agree, samples per second, and the time to the same noise. Installs Mitsuba into
# build/mitsuba and LLVM 19 from Debian, which Mitsuba loads. Takes a quarter of an hour, in which
# build/ must stay as it is.
# Another script than bench/compare/mitsuba.py may be named instead; MITSUBA_PYTHON names another
# Python, which has Mitsuba.
# bench/compare/mitsuba.sh [SCRIPT.py] [FLAGS of the script]
set -eu
cd "$(dirname "$0")/../.."
environment=build/mitsuba
[ -x build/clshear ] || scripts/build
PATH=$PATH:/usr/sbin:/sbin # for ldconfig
if ! ldconfig -p | grep -q 'libLLVM.*19' || ! python3 -c 'import ensurepip' 2>/dev/null; then
    if [ "$(id -u)" -ne 0 ]; then
        echo "mitsuba.sh: apt-get install libllvm19 python3-venv, or run this as root" >&2
        exit 1
    fi
    apt-get update -qq
    apt-get install -y -qq libllvm19 python3-venv
fi
python=${MITSUBA_PYTHON:-$environment/bin/python}
if ! "$python" -c 'import mitsuba' 2>/dev/null; then
    python=$environment/bin/python
    python3 -m venv $environment
    $environment/bin/pip install -q mitsuba numpy
fi
DRJIT_LIBLLVM_PATH=$(ldconfig -p | awk '/libLLVM.*19/ { print $NF; exit }')
export DRJIT_LIBLLVM_PATH
script=bench/compare/mitsuba.py
case ${1:-} in *.py)
    script=$1
    shift
    ;;
esac
exec "$python" "$script" "$@"
