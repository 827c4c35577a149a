#!/usr/bin/env bash
# Remakes docs/images/simulated_presets.png, every preset at eight ages.
set -euo pipefail
cd "$(dirname "$0")/.."
tool=build/ci/tests/simulate/verdigris_draw_presets
[ -x "$tool" ] || scripts/build.sh ci
mkdir -p docs/images
"$tool" docs/images/simulated_presets.png
