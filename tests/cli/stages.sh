#!/usr/bin/env bash
# Stage by stage gives the same files as `age`; each stage says what it needs.
source "$(dirname "$0")/lib.sh"
"$fixture" plate "$scratch/plate" 24 64
"$verdigris" age "$scratch/plate" -o "$scratch/age" --quiet

expect 3 "run .verdigris observe" "$verdigris" forecast "$scratch/plate"
expect 3 "no such result folder" "$verdigris" forecast "$scratch/nowhere"
"$verdigris" observe "$scratch/plate" -o "$scratch/steps" --quiet
expect 3 "run .verdigris forecast" "$verdigris" materialize "$scratch/steps"
"$verdigris" forecast "$scratch/steps" --quiet
expect 3 "run .verdigris materialize" "$verdigris" deliver "$scratch/steps"
"$verdigris" materialize "$scratch/steps" --quiet
"$verdigris" deliver "$scratch/steps" --quiet
expect_results "$scratch/steps"
(cd "$scratch/age" && find . -type f -exec sha256sum {} + | sort -k2) >"$scratch/age.sums"
(cd "$scratch/steps" && find . -type f -exec sha256sum {} + | sort -k2) >"$scratch/steps.sums"
diff "$scratch/age.sums" "$scratch/steps.sums" >&2 || fail "the stages and age differ"

"$verdigris" inspect "$scratch/plate" >"$scratch/out"
for word in frames times color exposure clipped verdict; do
  grep -q "^$word" "$scratch/out" || fail "inspect says nothing about $word"
done
"$verdigris" inspect "$scratch/plate" --json >"$scratch/out"
grep -q '"verdict"' "$scratch/out" || fail "inspect --json"
"$verdigris" doctor >"$scratch/out"
grep -q "processor" "$scratch/out" && grep -q "networks" "$scratch/out" || fail "doctor"
"$verdigris" doctor --json >"$scratch/out"
grep -q '"simd"' "$scratch/out" || fail "doctor --json"
if [ -e "$scratch/age/viewer.html" ]; then
  "$verdigris" view "$scratch/age" --print >"$scratch/out"
  grep -q viewer.html "$scratch/out" || fail "view --print"
fi
# The limit of the code: 1.5 times 98.4.
"$verdigris" age --help | tr -s ' \n' '  ' | grep -q "fewer than 148 frames" ||
  fail "--help gives another number of frames than the code"
# What takes much memory is announced before it is taken. Four frames: refused right after, so that
# the test does not take it.
"$verdigris" forecast "$scratch/steps" >"$scratch/out"
! grep -q "GB of memory" "$scratch/out" || fail "a small run is said to take much memory"
"$fixture" plate "$scratch/four" 4 64
"$verdigris" observe "$scratch/four" -o "$scratch/wide" --size 3400 --quiet
"$verdigris" forecast "$scratch/wide" >"$scratch/out" 2>/dev/null && fail "four frames are enough"
grep -q "3400x3400 pixels with a context of 4 take about 2.3 GB of memory" "$scratch/out" ||
  fail "much memory is not announced: $(cat "$scratch/out")"
# Guards.
"$verdigris" age "$scratch/plate" -o "$scratch/long" --horizons 5,200 --quiet --json >"$scratch/out"
grep -q long_horizon "$scratch/out" ||
  fail "a horizon far beyond the context is not flagged"
expect 4 "force" "$verdigris" age "$scratch/plate" -o "$scratch/few" --context 3
"$verdigris" age "$scratch/plate" -o "$scratch/few" --context 3 --force --quiet || fail "--force"
expect_results "$scratch/few"
finish
