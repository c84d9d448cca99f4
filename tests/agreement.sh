#!/bin/bash
# Agreement with Mitsuba 3, by the Python that MITSUBA_PYTHON names: agreement.sh PROGRAM ROOT [motion|models|lobes].
# Skipped where there is none, since it takes minutes; scripts/agreement installs one. Of motion and of model files, it
# is agreement with Cycles: skipped where there is no Blender. Of lobes that Mitsuba lacks, it is agreement with
# their formulas, which needs numpy only.
set -u
python=${MITSUBA_PYTHON:-}
if [ "${3:-}" = lobes ]; then
    # Debian's numpy is for the system's Python, which may not be the first one.
    for python in ${python:-python3 /usr/bin/python3}; do
        "$python" -c 'import numpy' 2>/dev/null &&
            exec "$python" "$2/bench/compare/lobes.py" --program "$1" --quick
    done
    echo "no Python with numpy"
    exit 77
fi
if [ -z "$python" ] || ! "$python" -c 'import mitsuba'; then
    echo "MITSUBA_PYTHON names no Python with Mitsuba"
    exit 77
fi
case ${3:-} in motion | models) command -v blender >/dev/null || { echo "no blender" && exit 77; } ;; esac
if [ "${3:-}" = motion ]; then
    exec "$python" "$2/bench/compare/twins/moving.py" --program "$1"
fi
if [ "${3:-}" = models ]; then
    # A square without gloss, where both programs have the same surface. It shows the lower half of a texture, which is
    # dark and red; the upper half, or no texture, is 1.7 times as bright in the mean. The means are 0.2 % apart.
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    oiiotool --create 64x64 3 --fill:color=0.9,0.9,0.9 64x32+0+0 --fill:color=0.5,0.1,0.1 64x32+0+32 -d uint8 -o "$folder/halves.png"
    printf 'newmtl a\nillum 1\nKd 1 1 1\nKs 0 0 0\nmap_Kd halves.png\n' >"$folder/square.mtl"
    printf 'mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 0.4\nvt 0 0.4\nusemtl a\nf 1/1 2/2 3/3 4/4\n' \
        >"$folder/square.obj"
    "$python" "$2/bench/compare/twins/models.py" --program "$1" --within 0.02 "$folder/square.obj"
    exit
fi
exec "$python" "$2/bench/compare/twins/agree.py" --program "$1"
