#!/usr/bin/env bash
# The whole job on a made plate: files, JSON, determinism over threads, reuse.
source "$(dirname "$0")/lib.sh"
"$fixture" plate "$scratch/plate" 40 96

"$verdigris" age "$scratch/plate" -o "$scratch/a" >"$scratch/out"
expect_results "$scratch/a"
grep -q contact_sheet.png "$scratch/out" || fail "age does not say where to look"
for h in u005 u010 u020 u050; do
  [ -s "$scratch/a/forecast/forecast_$h.png" ] || fail "no 16-bit forecast frame for $h"
done
[ -z "$(find "$scratch/a" -regextype posix-extended -regex '.*[._-]1[0-9]{3}\.(png|jpg|exr)$')" ] ||
  fail "a file name reads as a UDIM tile"

# Same bytes at any thread count.
"$verdigris" age "$scratch/plate" -o "$scratch/b" --threads 1 --quiet
(cd "$scratch/a" && find . -type f -exec sha256sum {} + | sort -k2) >"$scratch/a.sums"
(cd "$scratch/b" && find . -type f -exec sha256sum {} + | sort -k2) >"$scratch/b.sums"
diff "$scratch/a.sums" "$scratch/b.sums" >&2 || fail "one thread and many give different bytes"

# --json is one object with the promised fields; nothing else is on stdout.
"$verdigris" age "$scratch/plate" -o "$scratch/a" --horizons 7.5,3 --json >"$scratch/json" 2>"$scratch/err"
for field in '"options"' '"guards"' '"origins"' '"sha256"' '"noise"' '"version"'; do
  grep -q "$field" "$scratch/json" || fail "--json lacks $field"
done
[ "$(head -c 1 "$scratch/json")" = "{" ] || fail "--json prints more than an object"
[ -s "$scratch/a/forecast/forecast_u007_5.png" ] || fail "a fractional horizon has no frame"
[ ! -e "$scratch/a/forecast/forecast_u050.png" ] || fail "a frame of the earlier run is still there"

# The second run kept the observation of the first.
"$verdigris" age "$scratch/plate" -o "$scratch/a" >"$scratch/out"
grep -q "same input and options" "$scratch/out" || fail "an unchanged observation was made again"
printf 'x' >>"$scratch/plate/0003.png"
"$verdigris" age "$scratch/plate" -o "$scratch/a" >"$scratch/out" 2>&1
! grep -q "same input and options" "$scratch/out" || fail "changed input was not noticed"

# A planted drift is followed, not held; persistence holds exactly.
"$verdigris" age "$scratch/plate" -o "$scratch/hold" --forecaster persistence --quiet
cmp -s "$scratch/hold/forecast/forecast_u005.png" "$scratch/hold/forecast/forecast_u050.png" ||
  fail "persistence changed between +5 and +50"
grep -q '"forecaster"' "$scratch/a/manifest.json" || fail "the manifest does not name the forecaster"
finish
