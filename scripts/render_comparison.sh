#!/usr/bin/env bash
# The same maps on the same sphere and plate under the same surroundings by verdigris, by three.js (in
# headless Chromium) and by Cycles (Debian's Blender): docs/images/render_comparison.png, from the left, and
# how far apart they are in the middle of the object. What is not installed is left out, with a sentence.
#   scripts/render_comparison.sh [MAPS]      a folder of maps; without, those of a simulated specimen
set -euo pipefail
cd "$(dirname "$0")/.."
verdigris=build/ci/bin/verdigris size=320
[ -x "$verdigris" ] || scripts/build.sh ci
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
if [ $# -gt 0 ]; then
  cp -r "$1" "$scratch/maps"
else
  "$verdigris" simulate --preset chamber --size 512x512 --seed 7 --frames 120 -o "$scratch/made.mp4" --quiet
  "$verdigris" age "$scratch/made.mp4" -o "$scratch/aged" --clean-state context --forecaster affinergb \
    --crop auto --horizons 20 --quiet 2>/dev/null
  cp -r "$scratch"/aged/textures/*_u000 "$scratch/maps"
fi
[ -d tests/browser/node_modules ] || npm ci --prefix tests/browser --silent --no-audit --no-fund
rm -rf "$scratch/maps/masters16" "$scratch/maps/dx"   # all read the same 8 bits
node tests/browser/render_scene.mjs sky "$scratch/sky.exr"

# The middle of the object alone: backdrops differ, and edges are filtered differently.
middle() { ffmpeg -v error -y -i "$1" -vf "crop=iw*0.52:ih*0.52" "$2"; }
columns=()
for scene in sphere plate; do
  glb=$scratch/$scene.glb
  node tests/browser/render_scene.mjs "$scene" "$glb"
  "$verdigris" render "$scratch/maps" -o "$scratch/${scene}_verdigris.png" --scene "$glb" --light "$scratch/sky.exr" \
    --size $size --noise 1 --quiet
  node tests/browser/render_three.mjs "$scratch/maps" "$glb" "$scratch/sky.exr" $size "$scratch/${scene}_three.png" || true
  if command -v blender >/dev/null; then
    blender -b --factory-startup -noaudio --python-exit-code 1 --python tests/blender/render_glb.py -- \
      "$scratch/maps" "$glb" "$scratch/sky.exr" $size "$scratch/${scene}_cycles.png" >"$scratch/said" 2>&1 ||
      { echo "Blender failed:"; tail -5 "$scratch/said"; }
  else
    echo "no Blender found (Debian 12: apt-get install --no-install-recommends blender python3-numpy): Cycles is left out"
  fi
  row=()
  for by in verdigris three cycles; do
    [ -s "$scratch/${scene}_$by.png" ] || continue
    row+=(-i "$scratch/${scene}_$by.png")
    middle "$scratch/${scene}_$by.png" "$scratch/${scene}_${by}_middle.png"
    [ $by = verdigris ] && continue
    psnr=$(ffmpeg -hide_banner -i "$scratch/${scene}_verdigris_middle.png" -i "$scratch/${scene}_${by}_middle.png" \
      -lavfi psnr -f null - 2>&1 | grep -oE 'average:[0-9.inf]+' | cut -d: -f2)
    echo "$scene: verdigris against $by: PSNR $psnr dB"
    "$verdigris" compare "$scratch/${scene}_${by}_middle.png" "$scratch/${scene}_verdigris_middle.png" --metric flip,ssim
  done
  count=$((${#row[@]} / 2))
  [ $count -gt 1 ] || { echo "$scene: nothing to compare with; no picture is made"; exit 1; }
  ffmpeg -v error -y "${row[@]}" -filter_complex "hstack=inputs=$count" "$scratch/row_$scene.png"
  columns+=(-i "$scratch/row_$scene.png")
done
ffmpeg -v error -y "${columns[@]}" -filter_complex vstack=inputs=2 docs/images/render_comparison.png
echo "Look at docs/images/render_comparison.png"
