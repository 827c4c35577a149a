#!/usr/bin/env bash
# A specimen that fills the frame, so that no backdrop shows the light, steady or with an exposure that jitters by
# 3 % from frame to frame: six simulated presets, gain over holding still in percent (t+1 ... t+10; and the worst
# of the ten units), as docs/models/bandtrend.md quotes it: affinergb, bandtrend without its gray part, bandtrend.
#   scripts/no_backdrop_results.sh [SEED]
# Recordings are kept in out/no_backdrop/.
set -euo pipefail
cd "$(dirname "$0")/.."
seed=${1:-601}
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/no_backdrop
mkdir -p "$out"
. scripts/simulated.sh
printf '%-14s %6s %3s %16s %16s %16s\n' preset jitter n affinergb "without gray" bandtrend
for preset in chamber air uniform spotted reversal patina; do
  for jitter in 0 0.03; do
    recording=$out/$preset-$seed-$jitter.mkv
    made "$recording" "$preset" "$seed" 160x120 camera.jitter=$jitter scene.width=8 scene.height=8
    for n in 5 10; do
      "$verdigris" evaluate "$recording" --single --context $n --windows 40 -o "$out/result" --force --quiet \
        --forecasters persistence,affinergb,bandtrend:gray=0,bandtrend
      awk -F, -v preset="$preset" -v jitter="$jitter" -v n="$n" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        { f = $column["forecaster"]; e = $column["foreground"]; sum[f] += e; at[f, $column["horizon"]] += e }
        function gain(f,   h, g, worst) {
          worst = 9
          for (h = 1; h <= 10; ++h) { g = 1 - at[f, h] / at["persistence", h]; if (g < worst) worst = g }
          return sprintf("%+7.1f (%+.1f)", 100 * (1 - sum[f] / sum["persistence"]), 100 * worst) }
        END { printf "%-14s %6s %3d %16s %16s %16s\n", preset, jitter, n, gain("affinergb"), gain("bandtrend:gray=0"),
          gain("bandtrend") }' "$out/result/tables/windows_all.csv"
    done
  done
done
