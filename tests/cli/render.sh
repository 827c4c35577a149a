#!/usr/bin/env bash
# Pictures and videos of a result and of a folder of maps; bad input in one sentence.
source "$(dirname "$0")/lib.sh"
tiny=(--size 48 --noise 16 --quiet)
"$fixture" plate "$scratch/plate" 20 64
"$verdigris" age "$scratch/plate" -o "$scratch/aged" --horizons 5,10 --quiet 2>/dev/null
pack=$(find "$scratch/aged/textures" -maxdepth 1 -name '*_u010')

# Every scene, from a result and from a folder of maps; the same bytes on one thread.
for scene in plate sphere drape; do
  "$verdigris" render "$scratch/aged" -o "$scratch/$scene.png" --scene "$scene" "${tiny[@]}" ||
    fail "no $scene"
  "$verdigris" render "$scratch/aged" -o "$scratch/one/$scene.png" --scene "$scene" "${tiny[@]}" \
    --threads 1 || fail "no $scene on one thread"
  cmp -s "$scratch/$scene.png" "$scratch/one/$scene.png" || fail "$scene differs on one thread"
done
! cmp -s "$scratch/plate.png" "$scratch/sphere.png" || fail "all scenes look the same"
"$verdigris" render "$pack" -o "$scratch/pack.png" "${tiny[@]}" || fail "no folder of maps"
"$verdigris" render "$scratch/aged" -o "$scratch/shot.exr" "${tiny[@]}" || fail "no linear light"
[ "$(head -c 4 "$scratch/shot.exr" | od -An -tx1 | tr -d ' ')" = 762f3101 ] || fail "no OpenEXR"

# Several ages have them in their names, and look different.
"$verdigris" render "$scratch/aged" -o "$scratch/ages/shot.png" --horizons 10,0,7.5 --size 48 --noise 16 \
  --json >"$scratch/json" 2>/dev/null || fail "no ages"
for label in u000 u007_5 u010; do
  [ -s "$scratch/ages/shot_$label.png" ] || fail "shot_$label.png is missing"
done
[ ! -e "$scratch/ages/shot.png" ] || fail "a picture too many"
! cmp -s "$scratch/ages/shot_u000.png" "$scratch/ages/shot_u010.png" || fail "no age shows"
grep -q 'shot_u007_5.png' "$scratch/json" || fail "--json does not say what was written"
expect_no_partials "$scratch"

# Light and a model of one's own.
"$verdigris" render "$scratch/aged" -o "$scratch/sky.png" --light "$scratch/shot_sky.exr" "${tiny[@]}" \
  2>/dev/null && fail "a sky that is not there"
"$fixture" skies "$scratch/skies" || fail "no skies"
"$verdigris" render "$scratch/aged" -o "$scratch/sky.png" --light "$scratch/skies/good.exr" "${tiny[@]}" ||
  fail "no light from surroundings"
! cmp -s "$scratch/sky.png" "$scratch/sphere.png" || fail "the light does not matter"
cp "$scratch/aged/aged.glb" "$scratch/AGED.GLB"
"$verdigris" render "$scratch/aged" -o "$scratch/model.png" --scene "$scratch/AGED.GLB" "${tiny[@]}" ||
  fail "no model"

# Videos: as long as asked for.
for motion in turntable aging; do
  "$verdigris" render "$scratch/aged" -o "$scratch/$motion.mp4" --motion $motion --seconds 0.5 --fps 8 \
    "${tiny[@]}" || fail "no $motion"
  "$verdigris" inspect "$scratch/$motion.mp4" --json 2>/dev/null | grep -q '"frames": 4' ||
    fail "$motion.mp4 has not 4 frames"
done
! cmp -s "$scratch/turntable.mp4" "$scratch/aging.mp4" || fail "both motions are one"

# Nothing is replaced unless asked.
before=$(sha256sum <"$scratch/plate.png")
expect 4 "plate\.png.*--force" "$verdigris" render "$scratch/aged" -o "$scratch/plate.png" --size 48
[ "$(sha256sum <"$scratch/plate.png")" = "$before" ] || fail "plate.png was replaced"
"$verdigris" render "$scratch/aged" -o "$scratch/plate.png" --force "${tiny[@]}" || fail "--force"

# Not even with --force what the picture is made of.
cp -r "$pack" "$scratch/own"
cp "$scratch/skies/good.exr" "$scratch/own/sky.exr"
before=$(find "$scratch/own" -type f -exec sha256sum {} + | sort | sha256sum)
color=$(find "$scratch/own" -maxdepth 1 -name '*_Color.png')
expect 2 "_Color\.png: .*overwrite" "$verdigris" render "$scratch/own" -o "$color" --force --size 16
expect 2 "sky\.exr: .*overwrite" "$verdigris" render "$scratch/own" -o "$scratch/own/sky.exr" \
  --light "$scratch/own/sky.exr" --force --size 16
[ "$(find "$scratch/own" -type f -exec sha256sum {} + | sort | sha256sum)" = "$before" ] || fail "an input was overwritten"

# What makes no sense, and what is damaged: one sentence, nothing written.
bad() { # bad STATUS PATTERN ARGUMENTS...
  local status=$1 pattern=$2
  shift 2
  expect "$status" "$pattern" "$verdigris" render "$@" --size 48
  [ "$(grep -c . "$scratch/stderr")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/stderr")"
  expect_nothing "$scratch/bad"
}
out=(-o "$scratch/bad/x.png")
bad 2 "\.png" "$scratch/aged" -o "$scratch/bad/x.jpg"
bad 2 "teapot" "$scratch/aged" "${out[@]}" --scene teapot
bad 2 "motion" "$scratch/aged" "${out[@]}" --motion aging
bad 2 "one age" "$pack" "${out[@]}" --horizons 5
bad 2 "one horizon" "$scratch/aged" -o "$scratch/bad/x.mp4" --horizons 5,10
bad 2 "horizons.*range" "$scratch/aged" "${out[@]}" --horizons -1
bad 2 "exposure.*no number" "$scratch/aged" "${out[@]}" --exposure nan
bad 2 "seconds.*no number" "$scratch/aged" -o "$scratch/bad/x.mp4" --seconds nan
bad 2 "noise.*no number" "$scratch/aged" "${out[@]}" --noise nan
bad 2 "both be .*x_u003_333\.png" "$scratch/aged" "${out[@]}" --horizons 3.33333,3.3333333
bad 3 "nowhere" "$scratch/nowhere" "${out[@]}"
bad 3 "_Color" "$scratch/plate" "${out[@]}"
bad 3 "ages.*folder of maps" "$scratch/ages" "${out[@]}"
printf 'dear sir' >"$scratch/letter.glb"
bad 3 "letter\.glb: is not a GLB" "$scratch/aged" "${out[@]}" --scene "$scratch/letter.glb"
head -c 4000 "$scratch/aged/aged.glb" >"$scratch/cut.glb"
bad 3 "cut\.glb: is truncated" "$scratch/aged" "${out[@]}" --scene "$scratch/cut.glb"
sed 's/TEXCOORD_0/TEXCOORD_7/g' "$scratch/aged/aged.glb" >"$scratch/bare.glb"
bad 3 "bare\.glb: .*texture coordinates" "$scratch/aged" "${out[@]}" --scene "$scratch/bare.glb"
head -c 300 "$scratch/skies/good.exr" >"$scratch/cut.exr"
bad 3 "cut\.exr" "$scratch/aged" "${out[@]}" --light "$scratch/cut.exr"
bad 3 "nan\.exr: .*NaN" "$scratch/aged" "${out[@]}" --light "$scratch/skies/nan.exr"
bad 3 "inf\.exr: .*infinity" "$scratch/aged" "${out[@]}" --light "$scratch/skies/inf.exr"
bad 3 "black\.exr: .*black" "$scratch/aged" "${out[@]}" --light "$scratch/skies/black.exr"
bad 3 "giant\.exr" "$scratch/aged" "${out[@]}" --light "$scratch/skies/giant.exr"

# Maps that are cut or of another size.
cp -r "$pack" "$scratch/cutmap"
rm -rf "$scratch/cutmap/masters16"
rough=$(find "$scratch/cutmap" -name '*_Roughness.png')
head -c 200 "$(find "$pack" -maxdepth 1 -name '*_Roughness.png')" >"$rough"
bad 3 "_Roughness\.png" "$scratch/cutmap" "${out[@]}"
cp "$scratch/plate/0000.png" "$rough"
bad 3 "_Roughness\.png: has 64 x 64 pixels, but" "$scratch/cutmap" "${out[@]}"

# No room for it: nothing half-written.
(
  ulimit -f 2
  trap '' XFSZ
  for kind in png exr mp4; do
    expect 1 "x\.$kind: cannot be written" "$verdigris" render "$pack" -o "$scratch/bad/x.$kind" --size 128 \
      --noise 64 --seconds 0.1 --quiet
  done
  [ "$failures" -eq 0 ]
) || fail "file-size limit"
expect_nothing "$scratch/bad"
mkdir -p "$scratch/folder.png"
expect 1 "folder\.png: .*folder" "$verdigris" render "$pack" -o "$scratch/folder.png" --force --size 16 --quiet

# Interrupted: nothing half-written.
status=0
timeout --foreground --preserve-status -s INT 1 "$verdigris" render "$scratch/aged" -o "$scratch/bad/long.mp4" \
  --size 1024 --noise 0.1 --quiet || status=$?
[ "$status" -eq 130 ] || fail "status $status instead of 130 after an interrupt"
expect_nothing "$scratch/bad"
finish
