#!/usr/bin/env bash
# Remakes docs/images/copper_color_path.png, the colors of a growing oxide film.
set -euo pipefail
cd "$(dirname "$0")/.."
tool=build/ci/tests/copper/verdigris_draw_color_path
[ -x "$tool" ] || scripts/build.sh ci
mkdir -p docs/images
"$tool" docs/images/copper_color_path.png
