#!/usr/bin/env bash
# What each part and each constant of bandtrend (`auto`) is worth: the method as it is, then with one thing
# taken out or changed, on six kinds of simulated specimen and, where it is given, on real copper; as
# docs/models/bandtrend.md quotes it. Gain over holding still in percent, t+1 ... t+10; then at +20, +50, +85.
#   scripts/ablation_results.sh [SEED [FOLDER_OF_REAL_COPPER]]
# Reports are kept in out/ablation/.
set -euo pipefail
cd "$(dirname "$0")/.."
seed=${1:-401}
copper=${2:-}
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/ablation
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
parts=bandtrend
for part in light=0 relight=0 gray=0 global=0 split=0 local=0 bands=0 slowing=0 two-parts=0 bending=0 swing=0 \
  noise=0 events=0; do parts+=,bandtrend:$part; done
constants=bandtrend
for constant in confidence=0 confidence=0.5 confidence=2 global-count=1 global-count=6 band-count=30 \
  band-count=300 events=0.005 events=0.08 doubt=0 doubt=0.03 caution=0 caution=0.5; do
  constants+=,bandtrend:$constant
done

# at HORIZONS FOLDER: "forecaster,gain" over the windows of a result at these horizons.
at() {
  awk -F, -v horizons="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    index("," horizons ",", "," $column["horizon"] ",") {
      f = $column["forecaster"]; if (!(f in sum)) order[++n] = f; sum[f] += $column["foreground"] }
    END { for (i = 1; i <= n; ++i) print order[i] "," 1 - sum[order[i]] / sum["persistence"] }' \
    "$2/tables/windows_all.csv"
}
# table TITLE HORIZONS KIND NAMES...: a row per forecaster, a column per recording, percent.
table() {
  local title=$1 horizons=$2 kind=$3 name
  shift 3
  for name in "$@"; do at "$horizons" "$out/$name/$kind" | sed "s/^/$name,/"; done |
    awk -F, -v title="$title" '!($1 in known) { known[$1] = 1; names[++n] = $1 }
      !($2 in seen) { seen[$2] = 1; rows[++m] = $2 } { gain[$2, $1] = $3 }
      END { printf "\n%-26s", title; for (i = 1; i <= n; ++i) printf "%11s", names[i]; print ""
        for (r = 1; r <= m; ++r) { if (rows[r] == "persistence") continue
          printf "%-26s", rows[r]
          for (i = 1; i <= n; ++i) printf "%+11.1f", 100 * gain[rows[r], names[i]]; print "" } }'
}
presets=(chamber air uniform spotted reversal patina)
all=${parts},${constants#bandtrend,}
for preset in "${presets[@]}"; do
  recording=$out/$preset-$seed.mkv
  [ -e "$recording" ] || "$verdigris" simulate --preset "$preset" --seed "$seed" -o "$recording" --quiet
  mkdir -p "$out/$preset"
  "$verdigris" evaluate "$recording" --single --force --quiet -o "$out/$preset/near" --area specimen \
    --windows 40 --forecasters "persistence,affinergb,$all"
  "$verdigris" evaluate "$recording" --single --force --quiet -o "$out/$preset/far" --protocol "$out/far.toml" \
    --windows 10 --forecasters "persistence,affinergb,$constants"
done
columns=("${presets[@]}")
if [ -n "$copper" ]; then
  for n in 5 10; do
    mkdir -p "$out/copper-n$n"
    "$verdigris" evaluate "$copper" --single --stride 3 --context $n --force --quiet -o "$out/copper-n$n/near" \
      --forecasters "persistence,affinergb,$all"
    columns+=("copper-n$n")
  done
fi
table "t+1 ... t+10, seed $seed" "$(seq -s, 1 10)" near "${columns[@]}"
for h in 20 50 85; do table "t+$h, seed $seed" $h far "${presets[@]}"; done
