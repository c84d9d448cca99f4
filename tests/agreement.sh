#!/bin/bash
# Agreement with Mitsuba 3, by the Python that MITSUBA_PYTHON names: agreement.sh PROGRAM ROOT. Skipped
# where there is none, since it takes minutes; scripts/agreement installs one.
set -u
python=${MITSUBA_PYTHON:-}
if [ -z "$python" ] || ! "$python" -c 'import mitsuba'; then
    echo "MITSUBA_PYTHON names no Python with Mitsuba"
    exit 77
fi
exec "$python" "$2/bench/compare/twins/agree.py" --program "$1"
