#!/bin/sh
# The kernels are clean OpenCL C 1.2 at every packet width and with all features, by clang's warnings.
set -eu
root=$1
clang=
for name in clang clang-14 clang-15 clang-16; do
    [ -n "$clang" ] || clang=$(command -v $name || true)
done
[ -n "$clang" ] || { echo "no clang here: skipped"; exit 77; }
lint() { # width, features, kernel, processor
    "$clang" -x cl -cl-std=CL1.2 -Wall -Wextra -Werror -Xclang -finclude-default-header \
        -Wcast-align -fsyntax-only $4 -DCS_PACKET=$1 -DCS_FEATURES=$2 -DCS_KEEP_FP_CONTRACT_OFF -I "$root/cl" "$3"
}
for width in 1 4 8 16; do
    for kernel in "$root"/cl/kernels/*.cl; do
        lint $width 0 "$kernel" ""
    done
    for features in 1 2 3 5 7 8 13 24 32 34 61 63 64 65 67 127 128 384 517 1023 1025 1031 1663 2048 2055 4095; do # those that renders use, see cl/kernels/features.h
        lint $width $features "$root/cl/kernels/render.cl" ""
        lint $width $features "$root/cl/kernels/radiance.cl" ""
    done
done
# Some code is for a processor's own instructions.
if [ "$(uname -m)" = x86_64 ]; then
    for features in 1025 1663; do
        lint 16 $features "$root/cl/kernels/render.cl" -march=skylake-avx512
        lint 8 $features "$root/cl/kernels/render.cl" -march=haswell
    done
fi
