#!/usr/bin/env bash
# The held-out protocol on simulated chamber and air, and on the real copper frames by themselves, as
# docs/RESULTS.md quotes it:
#   scripts/held_out_results.sh [FOLDER_OF_REAL_RECORDINGS]
# Reports are kept in out/held-out/.
set -euo pipefail
cd "$(dirname "$0")/.."
real=${1:-../shared/data/real}
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/held-out
mkdir -p "$out"
for preset in chamber air; do
  [ -e "$out/$preset.mkv" ] ||
    "$verdigris" simulate --preset "$preset" --seed 1 -o "$out/$preset.mkv" --quiet
done
"$verdigris" evaluate "$out/chamber.mkv" "$out/air.mkv" -o "$out/simulated" \
  --forecasters persistence,affinergb,affinergb-ridge,backtest,auto
"$verdigris" audit "$out/simulated"
if [ -d "$real/copper_patinating" ]; then
  "$verdigris" evaluate "$real/copper_patinating" -o "$out/copper" --single --stride 3 \
    --forecasters persistence,affinergb,affinergb-ridge,backtest,auto
  "$verdigris" evaluate "$real/copper_patinating" -o "$out/copper-10" --single --stride 3 \
    --context 10 --forecasters persistence,affinergb,backtest,auto
  "$verdigris" evaluate "$real/clay_solidifying" -o "$out/clay" --single --stride 3 \
    --forecasters persistence,affinergb,backtest,auto
fi
