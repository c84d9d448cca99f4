#!/bin/sh
# The kernels are clean OpenCL C 1.2 at every packet width, by clang's warnings.
set -eu
root=$1
clang=
for name in clang clang-14 clang-15 clang-16; do
    [ -n "$clang" ] || clang=$(command -v $name || true)
done
[ -n "$clang" ] || { echo "no clang here: skipped"; exit 77; }
for width in 1 4 8 16; do
    for kernel in "$root"/cl/kernels/*.cl; do
        "$clang" -x cl -cl-std=CL1.2 -Wall -Wextra -Werror -Xclang -finclude-default-header \
            -fsyntax-only -DCS_PACKET=$width -DCS_KEEP_FP_CONTRACT_OFF -I "$root/cl" "$kernel"
    done
done
