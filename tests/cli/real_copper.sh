#!/usr/bin/env bash
# The quickstart's job on the real copper frames, and on their transcodes.
source "$(dirname "$0")/lib.sh"
[ -d "$shared/real/copper_patinating" ] || { echo "skipped: no $shared/real"; exit 77; }
"$verdigris" age "$shared/real/copper_patinating" -o "$scratch/copper" --json >"$scratch/json"
expect_results "$scratch/copper"
grep -q '"fills_frame": true' "$scratch/json" || fail "the specimen fills the frame, but was cropped"
grep -q '"clipped_share\|"explanation"' "$scratch/json" || fail "no explanation of the choice"
for video in copper_h264.mp4 copper_mjpeg.avi copper_h264_vfr.mp4 copper_h264_rot90.mp4; do
  "$verdigris" age "$shared/video/$video" -o "$scratch/$video" --quiet --horizons 5 || fail "$video"
  expect_results "$scratch/$video"
done
"$verdigris" age "$shared/real/clay_solidifying" -o "$scratch/clay" --quiet || fail "clay"
expect_results "$scratch/clay"
finish
