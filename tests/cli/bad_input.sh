#!/usr/bin/env bash
# One clear sentence, the documented status, nothing left behind.
source "$(dirname "$0")/lib.sh"
"$fixture" hostile "$scratch/in"
out=$scratch/out

bad() { # bad STATUS PATTERN INPUT [OPTIONS...]
  local status=$1 pattern=$2 input=$3
  shift 3
  expect "$status" "$pattern" "$verdigris" age "$input" -o "$out" "$@"
  [ "$(grep -c . "$scratch/stderr")" -le 2 ] || fail "more than a sentence for $input: $(cat "$scratch/stderr")"
  expect_nothing "$out"
}

bad 3 "nowhere" "$scratch/nowhere"
bad 3 "empty.*picture" "$scratch/in/empty"
bad 3 "text\.mp4" "$scratch/in/text.mp4"
bad 3 "zero\.mp4" "$scratch/in/zero.mp4"
bad 3 "one_frame|0000\.png" "$scratch/in/one_frame"
bad 3 "0006\.png.*50.?x.?48|50.?x.?48.*0006\.png" "$scratch/in/mixed_sizes"
bad 3 "0001\.png.*65000" "$scratch/in/huge"
bad 3 "0005\.exr.*(NaN|not a number|finite)" "$scratch/in/nan"
bad 3 "0000\.png" "$scratch/in/one_frame/0000.png"

# Pictures without news are not an error, but nobody is told a forecast exists.
for still in single_color all_black; do
  "$verdigris" age "$scratch/in/$still" -o "$scratch/$still" --json >"$scratch/json" 2>"$scratch/stderr" || {
    [ $? -eq 3 ] || fail "$still: unexpected status ($(cat "$scratch/stderr"))"
    continue
  }
  grep -qE 'no_change|still|nothing changes' "$scratch/json" || fail "$still: not told that nothing changes"
  expect_results "$scratch/$still"
done

# A broken photograph costs that photograph, and is named.
"$verdigris" age "$scratch/in/truncated_png" -o "$scratch/damaged" --json >"$scratch/json" 2>/dev/null ||
  fail "one broken photograph cost them all"
grep -q '0007.png' "$scratch/json" || fail "the broken photograph is not named"

# Usage.
"$fixture" plate "$scratch/plate" 12 64
for arguments in "--crop 1,2,3" "--crop a,b,c,d" "--crop 0,0,0,5" "--size 0" "--size big" "--horizons 0" \
  "--horizons -3" "--horizons 5,x" "--horizons 1e9" "--forecaster wishful" "--ridge-k -1" \
  "--context 0" "--normal-scale nan" "--roughness-clean 2" "--nonsense" "--units -4" "--tau 3"; do
  # shellcheck disable=SC2086
  expect 2 "." "$verdigris" age "$scratch/plate" -o "$out" $arguments
  expect_nothing "$out"
done
expect 2 "." "$verdigris"
expect 2 "." "$verdigris" age
expect 3 "crop" "$verdigris" age "$scratch/plate" -o "$out" --crop 40,40,500,500
expect_nothing "$out"
expect 2 "inside" "$verdigris" age "$scratch/plate" -o "$scratch/plate/out"
mkdir "$scratch/foreign" && touch "$scratch/foreign/thesis.tex"
expect 4 "other files" "$verdigris" age "$scratch/plate" -o "$scratch/foreign"
[ "$(ls "$scratch/foreign")" = thesis.tex ] || fail "wrote into a foreign folder"

# times.csv
cp -r "$scratch/plate" "$scratch/timed"
printf 'file,time\n0000.png,not a time\n' >"$scratch/timed/times.csv"
expect 3 "times\.csv.*line 2" "$verdigris" age "$scratch/timed" -o "$out"
expect_nothing "$out"

if command -v ffmpeg >/dev/null; then
  ffmpeg -v error -f lavfi -i sine=d=1 -c:a aac "$scratch/in/sound.mp4"
  bad 3 "sound\.mp4.*video" "$scratch/in/sound.mp4"
  ffmpeg -v error -framerate 10 -i "$scratch/plate/%04d.png" -pix_fmt yuv420p "$scratch/in/plate.mp4"
  head -c $(($(stat -c %s "$scratch/in/plate.mp4") / 2)) "$scratch/in/plate.mp4" >"$scratch/in/cut.mp4"
  bad 3 "cut\.mp4" "$scratch/in/cut.mp4"
fi
if [ -d "$shared/video" ]; then
  "$verdigris" age "$shared/video/copper_h264_truncated.mp4" -o "$scratch/cut" --json >"$scratch/json" 2>/dev/null ||
    fail "a broken tail cost more than the tail"
  grep -q '"broken_tail"' "$scratch/json" || fail "the lost tail is not reported"
fi
finish
