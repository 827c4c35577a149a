#!/usr/bin/env bash
# aged.glb of a made plate in three.js' loader: channels, orientation, variants.
set -euo pipefail
verdigris=$1 fixture=$2
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$fixture" plate "$scratch/plate" 20 64
"$verdigris" age "$scratch/plate" -o "$scratch/made" --quiet
node "$here/gltf_loads.mjs" "$scratch/made"
