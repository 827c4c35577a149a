#!/usr/bin/env bash
# Remakes docs/images/contact_sheet.png from the made plate of the tests. Needs ffmpeg to shrink it.
set -euo pipefail
cd "$(dirname "$0")/.."
[ -x build/ci/bin/verdigris ] || scripts/build.sh ci
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
build/ci/tests/cli/verdigris_fixture plate "$scratch/made_plate" 40 320
build/ci/bin/verdigris age "$scratch/made_plate" -o "$scratch/out" --quiet 2>/dev/null
mkdir -p docs/images
ffmpeg -v error -y -i "$scratch/out/contact_sheet.png" -vf scale=1400:-1:flags=area \
  -pred mixed -compression_level 9 docs/images/contact_sheet.png
