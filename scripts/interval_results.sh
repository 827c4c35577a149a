#!/usr/bin/env bash
# bandtrend (`auto`) on six kinds of simulated specimen, each by itself, as docs/RESULTS.md quotes it: gain
# over holding still at t+1 ... t+10 with the coverage of its own intervals, then at t+20, +50 and +85.
#   scripts/interval_results.sh [SEED]
# Reports are kept in out/intervals/.
set -euo pipefail
cd "$(dirname "$0")/.."
seed=${1:-302}
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/intervals
mkdir -p "$out"
cat >"$out/far.toml" <<'PROTOCOL'
# So long a span leaves no room to train, and none is needed.
train_fraction = 0.01
validation_fraction = 0.01
embargo = 0
horizons = 85
area = "specimen"
delta_e = false
PROTOCOL
judge() { "$verdigris" evaluate "$@" --single --forecasters persistence,affinergb,auto --force --quiet; }
for preset in chamber air uniform spotted reversal patina; do
  recording=$out/$preset-$seed.mkv
  [ -e "$recording" ] || "$verdigris" simulate --preset $preset --seed "$seed" -o "$recording" --quiet
  judge "$recording" -o "$out/$preset" --area specimen --windows 60
  judge "$recording" -o "$out/$preset-far" --protocol "$out/far.toml"
  echo "== $preset, seed $seed (simulated)"
  cut -d, -f2,6,7 "$out/$preset/tables/errors.csv"
  grep -E '(^|,)(horizon|all)(,|$)' "$out/$preset/tables/coverage.csv"
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    $column["horizon"] ~ /^(20|50|85)$/ {
      k = $column["horizon"]; sum[$column["forecaster"], k] += $column["foreground"] }
    END { for (k = 20; k <= 85; k += (k < 50 ? 30 : 35)) printf "t+%d: affinergb %+.0f %%, auto %+.0f %%\n", k,
      100 * (1 - sum["affinergb", k] / sum["persistence", k]), 100 * (1 - sum["auto", k] / sum["persistence", k]) }' \
    "$out/$preset-far/tables/windows_all.csv"
done
