#!/bin/bash
# Every header of cl/clshear/device compiles when it is the only one included, without any include
# path, as C17, C++17, OpenCL C 1.2 and 3.0; none of them defines a name without a prefix, and none changes the arithmetic of the
# code behind it. Without clang only the host's half is checked, and the result is "skipped".
set -eu
root=$1/cl
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$root"
headers=$(find clshear/device -name '*.h' | sort)
clang=
for name in clang clang-14 clang-15 clang-16; do
    [ -n "$clang" ] || clang=$(command -v $name || true)
done

c="-std=c17 -Wall -Wextra -Wpedantic -Wconversion -Werror -ffp-contract=off -fsyntax-only"
cpp="-x c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -ffp-contract=off -fsyntax-only"
opencl="-x cl -Wall -Wextra -Werror -Xclang -finclude-default-header -fsyntax-only"
for header in $headers; do
    only=$scratch/only.c
    printf '#include "%s"\nvoid something(void);\n' "$PWD/$header" >"$only"
    # shellcheck disable=SC2086
    {
        gcc $c "$only"
        g++ $cpp "$only"
        [ -n "$clang" ] || continue
        "$clang" $c "$only"
        for width in 1 4 8 16; do
            "$clang" $opencl -cl-std=CL1.2 -DCS_PACKET=$width "$only"
        done
        "$clang" $opencl -cl-std=CL1.2 "$only"
        "$clang" $opencl -cl-std=CL3.0 -DCS_PACKET=8 "$only"
    }
done

# Names: macros, functions, then types and enumerators.
all=$scratch/all.c
system=$scratch/system.c
printf '#include <math.h>\n#include <stdint.h>\n#include <string.h>\n' >"$system"
# shellcheck disable=SC2086
printf '#include "%s"\n' $headers >"$all"
bare() {
    [ -z "$2" ] || { echo "$1 without a prefix: $2"; exit 1; }
}
macros() {
    gcc -std=c17 -E -dM -I . "$1" | awk '{print $2}' | sed 's/(.*//' | sort -u
}
bare macros "$(comm -13 <(macros "$system") <(macros "$all") | grep -v '^\(CS_\|cs_\|CLSHEAR_DEVICE_\)' || true)"
gcc -std=c17 -fkeep-inline-functions -c -I . "$all" -o "$scratch/all.o"
functions=$(nm "$scratch/all.o" | awk '$2 ~ /[tT]/ {print $3}')
[ "$(echo "$functions" | wc -l)" -gt 50 ] || { echo "functions not found"; exit 1; }
bare functions "$(echo "$functions" | grep -v '^cs_' || true)"
text=$(gcc -std=c17 -E -P -D__OPENCL_VERSION__=120 -I . "$all" | grep -v '^#pragma')
bare types "$(echo "$text" | grep -oE '(struct|union|enum) +\w+|^\} \w+|typedef [^{(]* \w+(\[.*)?;' |
    sed 's/\[.*//; s/;//; s/.* //' | grep -v '^cs_' || true)"
bare constants "$(echo "$text" | grep -oE '\b[A-Z][A-Z0-9_]+\b' | grep -v '^CS_' || true)"
[ -n "$clang" ] || { echo "no clang here: OpenCL C not checked"; exit 77; }

# Arithmetic: no function of the headers is fused, what follows them is as if they were not there.
# Without "static" and "inline" the compiler emits them all.
sed -i '1i #define static\n#define inline' "$all"
printf 'float stranger(float a, float b, float c) { return a * b + c; }\n' >>"$all"
intermediate() {
    # shellcheck disable=SC2086
    "$clang" -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -S -emit-llvm -O0 -I . $1 "$all" -o - |
        awk '/^define/ { match($0, /@[a-z_0-9A-Z]+/); name = substr($0, RSTART + 1, RLENGTH - 1) }
             /@llvm.fmuladd/ && name != "" { print name }' | sort -u
}
fused=$(intermediate "")
[ "$fused" = stranger ] || { echo "fused, should be only the stranger's: $fused"; exit 1; }
fused=$(intermediate -DCS_KEEP_FP_CONTRACT_OFF)
[ -z "$fused" ] || { echo "fused, should be none: $fused"; exit 1; }
echo "$(echo "$headers" | wc -l) headers checked"
