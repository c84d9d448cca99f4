#!/bin/bash
# Agreement with Mitsuba 3, by the Python that MITSUBA_PYTHON names: agreement.sh PROGRAM ROOT [motion|lobes].
# Skipped where there is none, since it takes minutes; scripts/agreement installs one. Of motion, it is
# agreement with Cycles: skipped where there is no Blender. Of lobes that Mitsuba lacks, it is agreement with
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
if [ "${3:-}" = motion ]; then
    command -v blender >/dev/null || { echo "no blender" && exit 77; }
    exec "$python" "$2/bench/compare/twins/moving.py" --program "$1"
fi
exec "$python" "$2/bench/compare/twins/agree.py" --program "$1"
