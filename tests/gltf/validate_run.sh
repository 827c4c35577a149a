#!/usr/bin/env bash
# Zero errors and zero warnings on a made plate and on the real copper; a damaged GLB is caught.
set -euo pipefail
verdigris=$1 fixture=$2 shared=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$fixture" plate "$scratch/plate" 20 64
"$verdigris" age "$scratch/plate" -o "$scratch/made" --quiet
files=("$scratch/made/aged.glb")
if [ -d "$shared/real/copper_patinating" ]; then
  "$verdigris" age "$shared/real/copper_patinating" -o "$scratch/real" --quiet
  files+=("$scratch/real/aged.glb")
fi
node "$here/validate.mjs" "${files[@]}"
head -c 4000 "$scratch/made/aged.glb" >"$scratch/cut.glb"
! node "$here/validate.mjs" "$scratch/cut.glb" >/dev/null 2>&1 || { echo "a cut GLB passes"; exit 1; }
