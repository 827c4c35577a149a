#!/usr/bin/env bash
# The materials of forecasts judged by their pictures, on two made recordings; then what must be refused.
source "$(dirname "$0")/lib.sh"
for preset in chamber air; do
  "$verdigris" simulate --preset $preset --size 160x120 --frames 300 -o "$scratch/$preset.mkv" --quiet ||
    fail "simulate failed"
done
two=("$scratch/chamber.mkv" "$scratch/air.mkv")
small=(--size 48 --picture 48 --samples 8)
few=("${small[@]}" --windows 3)

"$verdigris" judge-materials "${two[@]}" "${few[@]}" -o "$scratch/jm" --horizons 20,2 --json \
  --forecasters affinergb,affinergb-clamped,affinergb-in-range,affinergb-ridge,bandtrend,auto \
  >"$scratch/jm.json" 2>"$scratch/stderr" || fail "judge-materials failed: $(cat "$scratch/stderr")"
for f in SHA256SUMS report.html protocol.toml record.json materials.json renders/u002.png renders/u020.png renders/frames-1.png renders/frames-2.png \
  tables/materials.csv tables/materials.json tables/materials.tex tables/materials-measures.json \
  tables/materials-limits.csv tables/materials-blocks.csv tables/windows_materials.csv; do
  [ -s "$scratch/jm/$f" ] || fail "$f is missing"
done
! command -v gnuplot >/dev/null || [ -s "$scratch/jm/figures/materials-flip.svg" ] || fail "no figure"
expect_no_partials "$scratch/jm"
(cd "$scratch/jm" && sha256sum --check --quiet --strict SHA256SUMS) || fail "sha256sum disagrees with SHA256SUMS"
head -c 8 "$scratch/jm/renders/u020.png" | grep -q PNG || fail "a sheet is no PNG"
for word in '"chamber -> air"' '"air -> chamber"' '"canvas"' '"affinergb-in-range"' '"lpips": null' '"verdict"'; do
  grep -q "$word" "$scratch/jm.json" || fail "--json lacks $word"
done
head -1 "$scratch/jm/tables/materials.csv" | grep -q 'flip_u2,.*gain_u2_lo.*flip_u20' || fail "the table's columns"
# 2 directions, 9 rows, 3 windows, 2 horizons, a header
[ "$(wc -l <"$scratch/jm/tables/windows_materials.csv")" -eq 109 ] || fail "not every window is in the table"

# Same bytes on one thread, into the same folder again.
sums=$(cat "$scratch/jm/SHA256SUMS")
"$verdigris" judge-materials "${two[@]}" "${few[@]}" -o "$scratch/jm" --horizons 2,20 --threads 1 --quiet \
  --forecasters affinergb,affinergb-clamped,affinergb-in-range,affinergb-ridge,bandtrend,auto ||
  fail "judge-materials on one thread failed"
[ "$(cat "$scratch/jm/SHA256SUMS")" = "$sums" ] || fail "one thread gives other bytes"

# One held out; one alone; other shapes and the other scale of coverage.
"$verdigris" judge-materials "${two[@]}" "${small[@]}" --windows 1 -o "$scratch/one" --horizons 5 --hold-out air --scene plate \
  --coverage-scale frame --whole --forecasters affinergb --json >"$scratch/one.json" 2>/dev/null || fail "--hold-out failed"
! grep -q '"air -> chamber"' "$scratch/one.json" || fail "--hold-out air judges the chamber"
grep -q '"coverage_scale": "frame"' "$scratch/one.json" || fail "--coverage-scale is not in the JSON"
"$verdigris" judge-materials "$scratch/air.mkv" "${small[@]}" --windows 1 -o "$scratch/single" --horizons 5 --single --quiet ||
  fail "--single failed"
grep -q 'within air' "$scratch/single/report.html" || fail "--single is not labeled so"

# A folder belongs to its command.
expect 4 "holds a result of .judge-materials." "$verdigris" evaluate "${two[@]}" -o "$scratch/jm" --force
echo mine >"$scratch/jm/renders/mine.png"
expect 4 "holds 'renders/mine.png'" "$verdigris" judge-materials "${two[@]}" "${few[@]}" -o "$scratch/jm" --force
expect 3 "is a result of .judge-materials., which audit does not take" "$verdigris" audit "$scratch/jm"

cp "${two[0]}" "$scratch/copy.mkv"
mkdir "$scratch/mine" && touch "$scratch/mine/thesis.tex"
bad() { # bad STATUS PATTERN ARGUMENT...
  expect "$1" "$2" "$verdigris" judge-materials "${@:3}" "${few[@]}" --quiet -o "$scratch/bad"
  [ "$(grep -c . "$scratch/stderr")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/stderr")"
  expect_nothing "$scratch/bad"
}
bad 4 "two copies of one recording" "${two[0]}" "$scratch/copy.mkv" --horizons 5
bad 4 "holds nothing out" "${two[0]}" --horizons 5
bad 3 "too short for \+200: behind 5 observed frames its furthest horizon is" "${two[@]}" --horizons 5,200
bad 2 "no forecaster 'magic'; choose one of" "${two[@]}" --forecasters affinergb,magic
bad 2 "no forecaster 'magic'; choose one of" "${two[@]}" --forecasters magic-in-range
bad 2 "two forecasters are named" "${two[@]}" --horizons 5 --forecasters affinergb,affinergb
bad 2 "horizons" "${two[@]}" --horizons 0
bad 2 "horizons" "${two[@]}" --horizons soon
bad 2 "scene" "${two[@]}" --scene teapot
bad 2 "samples" "${two[@]}" --samples 9
bad 3 "nowhere\.mkv" "${two[0]}" "$scratch/nowhere.mkv"
# Said before the first recording is observed, which takes long.
for late in "$scratch/nowhere.mkv" "${two[1]} --protocol ${two[0]}" "${two[1]} --ppd nan"; do
  # shellcheck disable=SC2086
  ! "$verdigris" judge-materials "${two[0]}" $late "${few[@]}" -o "$scratch/bad" >"$scratch/stdout" 2>/dev/null ||
    fail "accepted: $late"
  ! grep -q "^observed" "$scratch/stdout" || fail "told too late: $late"
done
bad 4 "leaves no window to judge" "${two[@]}" --horizons 5 --tau 1
expect 4 "thesis\.tex.*--force" "$verdigris" judge-materials "${two[@]}" -o "$scratch/mine"
[ "$(ls "$scratch/mine")" = thesis.tex ] || fail "wrote into a foreign folder"
finish
