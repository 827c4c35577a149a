#!/usr/bin/env bash
# A made recording and its truth, from a preset and from a file; then the whole job on it.
source "$(dirname "$0")/lib.sh"
small=(--size 96x72 --frames 200)

"$verdigris" simulate --preset chamber --seed 7 "${small[@]}" -o "$scratch/a.mp4" \
  --truth "$scratch/truth" --json >"$scratch/json" 2>/dev/null || fail "simulate failed"
grep -q '"simulated": true' "$scratch/json" || fail "a simulation does not say that it is one"
for file in a.mp4 a.spec.toml truth/truth.json truth/susceptibility.npy truth/susceptibility.exr \
  truth/specimen.npy truth/reference.npy truth/gains.csv truth/cells/film_nm.npy; do
  [ -s "$scratch/$file" ] || fail "$file is missing"
done
expect_no_partials "$scratch"

# Its own resolved spec gives the same recording, on one thread as on all.
"$verdigris" simulate --spec "$scratch/a.spec.toml" -o "$scratch/b.mp4" --threads 1 --quiet ||
  fail "the resolved spec is not accepted"
cmp -s "$scratch/a.mp4" "$scratch/b.mp4" || fail "the resolved spec gives another recording"
cmp -s "$scratch/a.spec.toml" "$scratch/b.spec.toml" || fail "the resolved spec changed"
"$verdigris" simulate --preset chamber --seed 8 "${small[@]}" -o "$scratch/c.mp4" --quiet
! cmp -s "$scratch/a.mp4" "$scratch/c.mp4" || fail "another seed gives the same recording"

# A folder and a lossless video hold the same frames.
"$verdigris" simulate --preset spotted "${small[@]}" -o "$scratch/frames/" --quiet
"$verdigris" simulate --preset spotted "${small[@]}" -o "$scratch/d.mkv" --quiet
[ "$(find "$scratch/frames" -name '*.png' | wc -l)" -eq 200 ] || fail "not 200 frames"
[ -s "$scratch/frames.spec.toml" ] || fail "the spec is not beside the folder"
"$verdigris" inspect "$scratch/frames" --json >"$scratch/f.json" 2>/dev/null || fail "frames/ does not open"
"$verdigris" inspect "$scratch/d.mkv" --json >"$scratch/d.json" 2>/dev/null || fail "d.mkv does not open"
# (frames are picked by time, and Matroska rounds times to milliseconds: alike, not equal)
for key in specimen_change noise_sigma; do
  value() { sed -n "s/.*\"$key\": \([0-9.e-]*\).*/\1/p" "$1"; }
  awk -v a="$(value "$scratch/f.json")" -v b="$(value "$scratch/d.json")" \
    'BEGIN { exit !(a > 0 && b > 0 && a / b < 1.1 && b / a < 1.1) }' ||
    fail "$key differs between the folder and the lossless video"
done

# The job that a first user does with it.
"$verdigris" age "$scratch/a.mp4" -o "$scratch/aged" --quiet || fail "age failed on a simulated recording"
expect_results "$scratch/aged"

"$verdigris" simulate --preset air --print-spec >"$scratch/air.toml" || fail "--print-spec failed"
"$verdigris" simulate --spec "$scratch/air.toml" "${small[@]}" -o "$scratch/e.mp4" --quiet ||
  fail "what --print-spec prints is not accepted"

# Nothing is replaced unless asked.
before=$(sha256sum <"$scratch/a.mp4")
expect 4 "a\.(mp4|spec\.toml).*--force" "$verdigris" simulate "${small[@]}" -o "$scratch/a.mp4"
[ "$(sha256sum <"$scratch/a.mp4")" = "$before" ] || fail "a.mp4 was replaced"
mkdir "$scratch/mine" && touch "$scratch/mine/thesis.tex"
expect 4 "mine" "$verdigris" simulate "${small[@]}" -o "$scratch/g.mp4" --truth "$scratch/mine"
expect 4 "mine" "$verdigris" simulate "${small[@]}" -o "$scratch/mine"
[ "$(ls "$scratch/mine")" = thesis.tex ] || fail "wrote into a foreign folder"
"$verdigris" simulate "${small[@]}" --seed 8 -o "$scratch/a.mp4" --force --quiet || fail "--force did not replace"
cmp -s "$scratch/a.mp4" "$scratch/c.mp4" || fail "--force left the old recording"

# A spec beside the recording always says what made it: an override is not written over in silence.
"$verdigris" simulate "${small[@]}" -o "$scratch/own.mp4" --quiet
expect 4 "own\.spec\.toml.*another spec" "$verdigris" simulate --spec "$scratch/own.spec.toml" --seed 5 -o "$scratch/own.mp4"
"$verdigris" simulate --spec "$scratch/own.spec.toml" --seed 5 -o "$scratch/own.mp4" --force --quiet || fail "own.mp4 with --force"
grep -q '^seed = 5' "$scratch/own.spec.toml" || fail "the spec beside the recording is not what made it"
"$verdigris" simulate --spec "$scratch/own.spec.toml" -o "$scratch/own.mkv" --quiet || fail "the same spec for two recordings"
expect 2 "truth" "$verdigris" simulate "${small[@]}" -o "$scratch/both" --truth "$scratch/both/truth"
expect 2 "truth" "$verdigris" simulate "${small[@]}" -o "$scratch/both/" --truth "$scratch/both"
expect_nothing "$scratch/both"
printf 'grid = 1024\n[frames]\nunits = 500\n[nucleation]\ndiffusion = 0.01\ninitial = 0\n' >"$scratch/long.toml"
expect 4 "hours.*diffusion" "$verdigris" simulate --spec "$scratch/long.toml" -o "$scratch/long.mp4"

# Bad input: one sentence with the key, the line and the range; nothing is left.
bad() { # bad STATUS PATTERN SPEC-TEXT
  printf '%b' "$3" >"$scratch/bad.toml"
  expect "$1" "$2" "$verdigris" simulate --spec "$scratch/bad.toml" -o "$scratch/bad/x.mp4"
  [ "$(grep -c . "$scratch/stderr")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/stderr")"
  expect_nothing "$scratch/bad"
}
bad 3 "bad\.toml, line 2: there is no key in \[oxide\] 'thickness'" '[oxide]\nthickness = 3\n'
bad 3 "bad\.toml, line 3: oxide\.initial_nm is -3; allowed are 0 to 5000" '\n[oxide]\ninitial_nm = -3\n'
bad 3 "bad\.toml, line 2: oxide\.metal_table cannot be used.*gold\.csv.*allowed" '[oxide]\nmetal_table = "gold.csv"\n'
bad 3 "bad\.toml, line 1: is not TOML" 'oxide ='
bad 3 "line 1: preset" 'preset = "mars"\n'
expect 3 "nowhere\.toml" "$verdigris" simulate --spec "$scratch/nowhere.toml" -o "$scratch/bad/x.mp4"
for arguments in "--preset mars" "--size big" "--size 3x3" "--frames 1" "--seed -4" "--seed x" \
  "--size 97x72" "--preset air --spec x.toml"; do
  # shellcheck disable=SC2086
  expect 2 "." "$verdigris" simulate -o "$scratch/bad/x.mp4" $arguments
  expect_nothing "$scratch/bad"
done
expect 2 "name" "$verdigris" simulate
expect 2 "avi" "$verdigris" simulate "${small[@]}" -o "$scratch/bad/x.avi"
expect_nothing "$scratch/bad"

# Interrupted: nothing half-written.
status=0
timeout --foreground --preserve-status -s INT 1 "$verdigris" simulate -o "$scratch/bad/long.mp4" \
  --truth "$scratch/bad/truth" --quiet || status=$?
[ "$status" -eq 130 ] || fail "status $status instead of 130 after an interrupt"
expect_nothing "$scratch/bad"
finish
