#!/usr/bin/env bash
# The program's own maps and the viewer's shader, on a made plate and on the real copper frames.
set -euo pipefail
verdigris=$1 fixture=$2 shared=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$fixture" plate "$scratch/plate" 30 120
"$verdigris" age "$scratch/plate" -o "$scratch/made" --quiet
node "$here/compare_with_maps.mjs" "$scratch/made" | tee "$scratch/made.log"
grep -q 'half width: ' "$scratch/made.log" || { echo "no half width was compared"; exit 1; }
"$verdigris" age "$scratch/plate" -o "$scratch/bent" --quiet --forecaster affinergb-full-2 --horizons 3,8.5
node "$here/compare_with_maps.mjs" "$scratch/bent"
if [ -d "$shared/real/copper_patinating" ]; then
  "$verdigris" age "$shared/real/copper_patinating" -o "$scratch/real" --quiet --forecaster affinergb
  node "$here/compare_with_maps.mjs" "$scratch/real"
fi
