#!/usr/bin/env bash
# How alike copies of a recording are, and different specimens: the table of docs/PROTOCOL.md.
#   scripts/near_copies.sh [FOLDER_OF_REAL_RECORDINGS]
# Needs ffmpeg; made recordings are kept in out/near-copies/.
set -euo pipefail
cd "$(dirname "$0")/.."
real=${1:-../shared/data/real}
build=${BUILD:-build/ci}
likeness=$(find "$build" -name verdigris_likeness -type f 2>/dev/null || true)
[ -n "$likeness" ] || { scripts/build.sh ci verdigris_cli verdigris_likeness; likeness=$(find "$build" -name verdigris_likeness -type f); }
out=out/near-copies
mkdir -p "$out"
for preset in chamber air; do
  for seed in 1 2; do
    [ -e "$out/$preset$seed.mkv" ] ||
      "$build/bin/verdigris" simulate --preset $preset --seed $seed --size 320x180 --frames 300 -o "$out/$preset$seed.mkv" --quiet
  done
  ffmpeg -v error -y -i "$out/${preset}1.mkv" -c:v libx264 -crf 30 -pix_fmt yuv420p "$out/${preset}_crf30.mp4"
  ffmpeg -v error -y -i "$out/${preset}1.mkv" -vf scale=iw/2:ih/2 -c:v ffv1 "$out/${preset}_half.mkv"
  ffmpeg -v error -y -i "$out/${preset}1.mkv" -vf scale=iw/2:ih/2 -c:v libx264 -crf 30 -pix_fmt yuv420p "$out/${preset}_half_crf30.mp4"
done
[ -e "$out/chamber_long.mkv" ] ||
  "$build/bin/verdigris" simulate --preset chamber --seed 1 -o "$out/chamber_long.mkv" --quiet
list=("$out"/chamber1.mkv "$out"/chamber_crf30.mp4 "$out"/chamber_half.mkv "$out"/chamber_half_crf30.mp4
  "$out"/chamber_long.mkv "$out"/chamber2.mkv "$out"/air1.mkv "$out"/air_crf30.mp4 "$out"/air_half.mkv
  "$out"/air_half_crf30.mp4 "$out"/air2.mkv)
for name in copper_patinating clay_solidifying; do
  [ ! -d "$real/$name" ] || list+=("$real/$name")
done
"$likeness" "${list[@]}"
