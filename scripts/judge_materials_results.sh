#!/usr/bin/env bash
# The paper's Table 3 on simulated chamber and air, as docs/RESULTS.md quotes it:
#   scripts/judge_materials_results.sh
# The recordings are those of scripts/held_out_results.sh; the report is kept in out/held-out/.
set -euo pipefail
cd "$(dirname "$0")/.."
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/held-out
mkdir -p "$out"
for preset in chamber air; do
  [ -e "$out/$preset.mkv" ] ||
    "$verdigris" simulate --preset "$preset" --seed 1 -o "$out/$preset.mkv" --quiet
done
"$verdigris" judge-materials "$out/chamber.mkv" "$out/air.mkv" -o "$out/materials" \
  --forecasters affinergb,affinergb-clamped,affinergb-in-range,affinergb-ridge,backtest,auto
