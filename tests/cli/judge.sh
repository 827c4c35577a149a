#!/usr/bin/env bash
# Forecasters judged on two made recordings, as a researcher would; then all that must be refused.
source "$(dirname "$0")/lib.sh"
for preset in chamber air; do
  "$verdigris" simulate --preset $preset --size 160x120 --frames 300 -o "$scratch/$preset.mkv" --quiet ||
    fail "simulate failed"
done
two=("$scratch/chamber.mkv" "$scratch/air.mkv")
few=(--size 64 --windows 12)

expect_files() { # expect_files FOLDER FILE...
  local folder=$1 f
  shift
  for f in report.html protocol.toml "$@"; do
    [ -s "$folder/$f" ] || fail "$folder/$f is missing"
  done
  expect_no_partials "$folder"
}
# Figures need gnuplot, which a machine may lack; then the report says so.
figures() { command -v gnuplot >/dev/null || return 0; printf 'figures/%s.svg\nfigures/%s.png\n' "$1" "$1"; }

"$verdigris" evaluate "${two[@]}" "${few[@]}" -o "$scratch/ev" --json >"$scratch/ev.json" 2>/dev/null ||
  fail "evaluate failed"
# shellcheck disable=SC2046
expect_files "$scratch/ev" SHA256SUMS evaluation.json record.json tables/errors.csv tables/errors.json \
  tables/errors.tex tables/windows_all.csv $(figures gains)
grep -q '"chamber -> air"' "$scratch/ev.json" || fail "evaluate --json lacks a direction"

"$verdigris" audit "$scratch/ev" --json >"$scratch/audit.json" 2>/dev/null || fail "a clean result is not clean"
grep -q '"clean": true' "$scratch/audit.json" || fail "audit --json does not say clean"
(cd "$scratch/ev" && sha256sum --check --quiet --strict SHA256SUMS) || fail "sha256sum disagrees with SHA256SUMS"

"$verdigris" characterize "${two[@]}" "${few[@]}" -o "$scratch/ch" --json >"$scratch/ch.json" 2>/dev/null ||
  fail "characterize failed"
# shellcheck disable=SC2046
expect_files "$scratch/ch" SHA256SUMS characterization.json tables/characterization.csv tables/long-horizons.tex \
  tables/windows_characterization.csv tables/windows_long.csv $(figures errors-far)
grep -q '"verdict"' "$scratch/ch.json" || fail "characterize --json lacks its verdict"
[ "$(grep -c '"axis"' "$scratch/ch.json")" -eq 20 ] || fail "not 20 settings"

"$verdigris" drift "${two[@]}" "${few[@]}" -o "$scratch/dr" --forecasters affinergb,auto --json \
  >"$scratch/dr.json" 2>/dev/null || fail "drift failed"
# shellcheck disable=SC2046
expect_files "$scratch/dr" SHA256SUMS drift.json drift_gains.csv tables/drift.csv tables/drift-gains.tex \
  tables/drift_series.csv tables/windows_drift.csv $(figures camera)
grep -q 'chamber: .*the camera is not drifting' "$scratch/dr.json" || fail "the chamber's light is steady"
grep -q 'air: .*is drifting' "$scratch/dr.json" || fail "the open air's light is not"
# The result folder is its own again, and one recording alone is enough for this command.
"$verdigris" drift "$scratch/air.mkv" "${few[@]}" -o "$scratch/dr" --quiet || fail "drift again failed"
"$verdigris" evaluate "$scratch/air.mkv" "${few[@]}" --single -o "$scratch/single" --json \
  >"$scratch/single.json" 2>/dev/null || fail "--single failed"
grep -q '"within air"' "$scratch/single.json" || fail "--single is not labeled so"

# A folder belongs to the command that made it, also with --force; what is the user's stays.
echo mine >"$scratch/ev/notes.txt"
before=$(cd "$scratch/ev" && find . -type f -exec sha256sum {} + | sort)
for command in characterize drift; do
  for force in "" --force; do
    # shellcheck disable=SC2086
    expect 4 "holds a result of .evaluate." "$verdigris" $command "${two[@]}" "${few[@]}" -o "$scratch/ev" $force
  done
done
expect 4 "holds a result of .drift." "$verdigris" evaluate "${two[@]}" "${few[@]}" -o "$scratch/dr"
[ "$(cd "$scratch/ev" && find . -type f -exec sha256sum {} + | sort)" = "$before" ] || fail "a refusal changed a result"
cp -r "$scratch/ev" "$scratch/again" && echo mine >"$scratch/again/tables/mine.csv"
expect 4 "holds 'tables/mine.csv'" "$verdigris" evaluate "${two[@]}" "${few[@]}" -o "$scratch/again" --force
rm "$scratch/again/tables/mine.csv"
"$verdigris" evaluate "${two[@]}" "${few[@]}" -o "$scratch/again" --forecasters persistence --json \
  >"$scratch/still.json" 2>/dev/null || fail "evaluate into its own folder failed"
[ "$(cat "$scratch/again/notes.txt")" = mine ] || fail "a file of the user's is gone from a result's folder"
[ ! -e "$scratch/again/figures/gains.svg" ] || fail "a figure of the result before is left"
[ ! -e "$scratch/again/tables/intervals.csv" ] || fail "a table of the result before is left"
grep -q "only holding still" "$scratch/again/report.html" || fail "a page of persistence alone says nothing"
expect 0 "notes\.txt" "$verdigris" audit "$scratch/again"

# Nothing to score is no result, from either command.
for command in evaluate characterize; do
  expect 4 "leaves no window to score" "$verdigris" $command "${two[@]}" "${few[@]}" --tau 1 -o "$scratch/nothing"
  expect_nothing "$scratch/nothing"
done

# The same specimen, encoded again or smaller, is the same recording; another specimen is not.
"$verdigris" simulate --preset chamber --size 160x120 --frames 300 -o "$scratch/coded.mp4" --quiet ||
  fail "simulate failed"
"$verdigris" simulate --preset chamber --size 120x90 --frames 300 -o "$scratch/smaller.mkv" --quiet ||
  fail "simulate failed"
"$verdigris" simulate --preset chamber --seed 2 --size 160x120 --frames 300 -o "$scratch/other.mkv" --quiet ||
  fail "simulate failed"
for command in evaluate characterize drift; do
  for copy in coded.mp4 smaller.mkv; do
    expect 4 "chamber and ${copy%.*} show one specimen .*near copies of one recording" \
      "$verdigris" $command "${two[0]}" "$scratch/$copy" "${few[@]}" -o "$scratch/near"
    expect_nothing "$scratch/near"
  done
done
"$verdigris" evaluate "${two[0]}" "$scratch/other.mkv" "${few[@]}" --forecasters affinergb -o "$scratch/two_seeds" \
  --quiet || fail "two specimens of one preset are taken for one"
"$verdigris" audit "$scratch/two_seeds" >"$scratch/stdout" || fail "two specimens of one preset are not clean"
grep -q "^surfaces  most alike are chamber and other" "$scratch/stdout" || fail "audit does not say how alike they are"

# Bad input: one sentence, the right status, nothing left.
cp "${two[0]}" "$scratch/copy.mkv"
for preset in chamber air; do
  "$verdigris" simulate --preset $preset --size 160x120 --frames 12 -o "$scratch/short_$preset.mkv" --quiet
done
printf 'grid = 0\ntrain_fraction = 0.9\n' >"$scratch/overlap.toml"
mkdir "$scratch/mine" && touch "$scratch/mine/thesis.tex"
bad() { # bad STATUS PATTERN COMMAND...
  expect "$1" "$2" "$verdigris" "${@:3}" -o "$scratch/bad"
  [ "$(grep -c . "$scratch/stderr")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/stderr")"
  expect_nothing "$scratch/bad"
}
for command in evaluate characterize drift; do
  [ $command = drift ] || bad 4 "holds nothing out.*--single" $command "${two[0]}" "${few[@]}"
  bad 4 "chamber and copy are two copies" $command "${two[0]}" "$scratch/copy.mkv" "${few[@]}"
  bad 3 "too short: 12 usable samples" $command "$scratch/short_chamber.mkv" "$scratch/short_air.mkv"
  bad 3 "overlap\.toml, line 2: .*splits overlap" $command "${two[@]}" --protocol "$scratch/overlap.toml"
  bad 3 "nowhere\.mkv" $command "${two[0]}" "$scratch/nowhere.mkv"
  bad 2 "windows" $command "${two[@]}" --windows some
  expect 4 "thesis\.tex.*--force" "$verdigris" $command "${two[@]}" -o "$scratch/mine"
  [ "$(ls "$scratch/mine")" = thesis.tex ] || fail "$command wrote into a foreign folder"
done
for command in evaluate drift; do
  bad 2 "net\.safetensors.*a network is judged by .evaluate|no trained forecasters" $command "${two[@]}" --forecasters net.safetensors
  bad 2 "no forecaster 'magic'; choose one of" $command "${two[@]}" --forecasters affinergb,magic
done
bad 2 "persistence gains nothing" drift "${two[@]}" --forecasters persistence

# An audit sees what was changed by hand, and says what is no result.
cp -r "$scratch/ev" "$scratch/tampered"
awk -F, -v OFS=, 'NR == 9 { $5 = 3 * $5 } { print }' "$scratch/ev/tables/windows_all.csv" \
  >"$scratch/tampered/tables/windows_all.csv"
expect 4 "evaluation\.json says the mean error" "$verdigris" audit "$scratch/tampered"
grep -q "findings that spoil" "$scratch/stderr" || fail "the findings are not counted"
expect 3 "is not there" "$verdigris" audit "$scratch/mine"
expect 3 "is not there" "$verdigris" audit "$scratch/nowhere"

# The list of files binds what the numbers do not; and the numbers, if the list is made again.
for f in report.html protocol.toml tables/errors.csv tables/blocks.tex; do
  cp "$scratch/ev/$f" "$scratch/kept" && echo " " >>"$scratch/ev/$f"
  expect 4 "$f is not the file that was delivered" "$verdigris" audit "$scratch/ev"
  rm "$scratch/ev/$f"
  case $f in protocol.toml) status=3 pattern=protocol.toml ;; *) status=4 pattern="$f is missing" ;; esac
  expect $status "$pattern" "$verdigris" audit "$scratch/ev"
  mv "$scratch/kept" "$scratch/ev/$f"
done
mv "$scratch/ev/SHA256SUMS" "$scratch/kept"
expect 4 "no SHA256SUMS" "$verdigris" audit "$scratch/ev"
mv "$scratch/kept" "$scratch/ev/SHA256SUMS"
"$verdigris" audit "$scratch/ev" --quiet || fail "a result put right is not clean"

# Other tampering: a gain, a window counted twice, the record of another evaluation.
tampered() { # tampered FILE SED-EXPRESSION
  rm -rf "$scratch/tampered" && cp -r "$scratch/judged" "$scratch/tampered"
  sed -i "$2" "$scratch/tampered/$1"
  ! cmp -s "$scratch/judged/$1" "$scratch/tampered/$1" || fail "nothing was tampered with in $1"
  expect 4 "$1 is not the file that was delivered" "$verdigris" audit "$scratch/tampered"
  # Whoever makes the list again still meets the numbers.
  (cd "$scratch/tampered" && sed 's/^[0-9a-f]*  //' "$scratch/judged/SHA256SUMS" | xargs sha256sum >SHA256SUMS)
  expect 4 "${3:-spoil}" "$verdigris" audit "$scratch/tampered"
}
"$verdigris" evaluate "$scratch/chamber.mkv" "$scratch/air.mkv" -o "$scratch/judged" --windows 30 --quiet ||
  fail "evaluate for the audit"
"$verdigris" audit "$scratch/judged" --quiet || fail "an untouched result is not clean"
tampered evaluation.json '0,/"gain": [-0-9.e]*/s//"gain": 0.99/'
tampered tables/windows_all.csv '2p'
tampered record.json 's/"starts":\[[0-9]*,/"starts":[/'
tampered record.json 's/"span":[0-9]*/"span":7/' "another span"
tampered record.json 's/"embargo":[0-9]*/"embargo":1/' "another embargo"
tampered protocol.toml 's/^max_windows = 30/max_windows = 29/' "other windows"

# A folder of somebody's own is not taken for a result of ours.
mkdir -p "$scratch/paper/figures" && echo mine >"$scratch/paper/figures/photo.txt"
for force in "" --force; do
  # shellcheck disable=SC2086
  expect 4 "figures" "$verdigris" evaluate "$scratch/chamber.mkv" --single -o "$scratch/paper" $force
done
[ -s "$scratch/paper/figures/photo.txt" ] || fail "a file of the user's is gone"

# Recordings whose units mean different numbers of samples are not judged together.
"$verdigris" simulate --size 64x48 --frames 984 -o "$scratch/long.mkv" --quiet
expect 4 "samples per unit" "$verdigris" evaluate "$scratch/chamber.mkv" "$scratch/long.mkv" -o "$scratch/mixed"
expect_nothing "$scratch/mixed"
finish
