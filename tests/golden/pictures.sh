#!/usr/bin/env bash
# The pictures of a run of the real program on the made plate, against the golden ones beside this
# script.  pictures.sh VERDIGRIS FIXTURE COMPARE FAILED_DIR
# With VERDIGRIS_UPDATE_GOLDEN=1 the golden ones are written instead: look at them before you commit.
set -euo pipefail
verdigris=$1 fixture=$2 compare=$3 failed=$4
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
rm -rf "$failed"
mkdir -p "$failed"
"$fixture" plate "$scratch/plate" 20 64
# A named forecaster and a named clean state: what `auto` decides has tests of its own, and a
# decision on the edge would change every picture at once.
"$verdigris" age "$scratch/plate" -o "$scratch/out" --forecaster affinergb --clean-state start \
  --horizons 10 --quiet 2>/dev/null
for scene in plate sphere drape; do
  "$verdigris" render "$scratch/out" -o "$scratch/out/render_$scene.png" --scene $scene --size 96 --quiet
done
bad=0

# picture NAME FILE WORST MEAN BLOCK, in codes of 255.
picture() {
  if [ "${VERDIGRIS_UPDATE_GOLDEN:-}" = 1 ]; then
    "$compare" update "$scratch/out/$2" "$here/$1.png" "$5"
    echo "updated $here/$1.png"
  else
    "$compare" check "$scratch/out/$2" "$here/$1.png" "$3" "$4" "$5" "$failed" || bad=1
  fi
}

# The plate is 8-bit: another libm may round some of its pixels by one code, and one code of the
# observed frame is about one of the forecast. Fused and separate multiply-adds differ by far less.
pack=textures/Plate_u010/Plate_u010
picture forecast_u010 forecast/forecast_u010.png 1.5 0.05 1
picture color "${pack}_Color.png" 2 0.05 1
# A slope is eight differences of neighbors [docs/models/material.md]: it multiplies such a code.
picture normal_gl "${pack}_NormalGL.png" 6 0.2 1
picture roughness "${pack}_Roughness.png" 4 0.1 1
picture metalness "${pack}_Metalness.png" 4 0.1 1
# Means over 4 x 4 pixels: cairo, FreeType and the DejaVu fonts draw the edge of a letter a little
# differently from version to version. Another face of DejaVu (Serif, Condensed) is 150 to 200 at
# worst and 0.9 to 1.1 in the mean here.
picture contact_sheet contact_sheet.png 20 0.4 4
# Means over 4 x 4 pixels: Embree picks its code by processor, so a ray here and there meets the
# neighboring triangle. (Rounding the golden means to whole codes is 0.25 in the mean.)
for scene in plate sphere drape; do
  picture "render_$scene" "render_$scene.png" 4 0.4 4
done

[ "$bad" -eq 0 ] || {
  echo "If the change is meant: VERDIGRIS_UPDATE_GOLDEN=1 ctest -R golden.pictures, and look at" \
    "tests/golden/*.png (CONTRIBUTING.md)" >&2
  exit 1
}
