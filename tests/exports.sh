#!/bin/sh
# Only the public functions leave the shared library, and all of them do.
set -eu
library=$1
headers=$(dirname "$0")/../include
exported=$(nm -D --defined-only "$library" | awk '$2 ~ /[TDBRV]/ {print $3}' | sort -u)
others=$(echo "$exported" | grep -v '^clshear_' || true)
declared=$(grep -oh 'clshear_[a-z0-9_]*(' "$headers"/clshear/*.h | tr -d '(' | sort -u)
missing=$(for name in $declared; do echo "$exported" | grep -qx "$name" || echo "$name"; done)
[ -z "$others" ] || { echo "exported but not public: $others"; exit 1; }
[ -z "$missing" ] || { echo "declared but not exported: $missing"; exit 1; }
echo "$(echo "$exported" | wc -l) symbols, all public"
