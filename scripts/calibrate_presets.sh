#!/usr/bin/env bash
# Measures the presets `chamber` and `air` against what the paper prints (the table of
# docs/models/simulate.md), or looks for their tuned numbers:
#   scripts/calibrate_presets.sh [measure|search] [SEEDS]
set -euo pipefail
cd "$(dirname "$0")/.."
tool=build/ci/tests/simulate/verdigris_calibrate
[ -x "$tool" ] || scripts/build.sh ci
"$tool" "${1:-measure}" "${2:-10}"
