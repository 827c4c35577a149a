#!/usr/bin/env bash
# What auto does with surfaces that are not copper (made by scripts/made_surfaces.py; synthetic): gain over
# holding still in percent (t+1 ... t+10, 40 windows over the recording), and the worst of the ten units, as
# docs/RESULTS.md quotes them.
#   scripts/surfaces_results.sh
# Needs python3-numpy (Debian). Recordings and reports are kept in out/surfaces/.
set -euo pipefail
cd "$(dirname "$0")/.."
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/surfaces
[ -s "$out/list.tsv" ] || {
  mkdir -p "$out"
  /usr/bin/python3 scripts/made_surfaces.py "$out" >"$out/list.part"
  mv "$out/list.part" "$out/list.tsv"
}
# judged NAME N: three cells of a table.
judged() {
  "$verdigris" evaluate "$out/$1.mkv" --single --context "$2" --area specimen --windows 40 -o "$out/$1-n$2" \
    --forecasters persistence,affinergb,auto --force --quiet
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { f = $column["forecaster"]; h = $column["horizon"]; e = $column["foreground"]; sum[f] += e; at[f, h] += e }
    END { worst = 9; for (h = 1; h <= 10; ++h) { g = 1 - at["auto", h] / at["persistence", h]; if (g < worst) worst = g }
      printf " %+.1f | %+.1f | %+.1f |", 100 * (1 - sum["affinergb"] / sum["persistence"]),
        100 * (1 - sum["auto"] / sum["persistence"]), 100 * worst }' "$out/$1-n$2/tables/windows_all.csv"
}
echo "| surface | n = 5: affinergb | auto | worst unit | n = 10: affinergb | auto | worst unit |"
echo "|---|---|---|---|---|---|---|"
while IFS=$'\t' read -r name what; do
  echo "| $name: $what |$(judged "$name" 5)$(judged "$name" 10)"
done <"$out/list.tsv"
