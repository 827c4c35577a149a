#!/usr/bin/env bash
# Two pictures compared, as a user does; then what must be refused.
source "$(dirname "$0")/lib.sh"
"$fixture" plate "$scratch/plate" 12 192
a=$scratch/plate/0000.png b=$scratch/plate/0011.png
json() { # json FILE KEY: the number or word behind it
  grep -oE "\"$2\": [^,]*" "$1" | head -1 | sed 's/.*: //'
}
near() { awk -v x="$1" -v y="$2" -v e="$3" 'BEGIN { exit !(x - y <= e && y - x <= e) }'; }

"$verdigris" compare "$a" "$b" --map "$scratch/map.png" --json >"$scratch/ab.json" 2>"$scratch/stderr" ||
  fail "compare failed: $(cat "$scratch/stderr")"
for key in reference test width height metrics unavailable map notes flip lpips ssim ms_ssim ciede2000 psnr mse; do
  grep -q "\"$key\"" "$scratch/ab.json" || fail "--json lacks $key"
done
[ "$(head -c 8 "$scratch/map.png" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "the map is no PNG"
! grep -qiE '\b(nan|inf|infinity)\b' "$scratch/ab.json" || fail "JSON has no such numbers"
grep -q '"lpips": null' "$scratch/ab.json" || fail "LPIPS without weights is not null"
! command -v python3 >/dev/null || python3 -m json.tool "$scratch/ab.json" >/dev/null || fail "no valid JSON"

# The other way around is the same; on one core are the same bytes.
"$verdigris" compare "$b" "$a" --json >"$scratch/ba.json" 2>/dev/null || fail "compare failed"
for key in mean median ssim ms_ssim percentile95 decibels mse; do
  near "$(json "$scratch/ab.json" $key)" "$(json "$scratch/ba.json" $key)" 1e-6 || fail "$key is not symmetric"
done
"$verdigris" compare "$a" "$b" --map "$scratch/one.png" --threads 1 --json >"$scratch/one.json" 2>/dev/null ||
  fail "compare failed on one thread"
cmp -s "$scratch/map.png" "$scratch/one.png" || fail "the map depends on the number of threads"
[ "$(sed 's/one\.png/map.png/' "$scratch/one.json")" = "$(cat "$scratch/ab.json")" ] ||
  fail "a number depends on the number of threads"

# A picture against itself: every measure at its best, and PSNR a word.
"$verdigris" compare "$a" "$a" --json >"$scratch/aa.json" 2>/dev/null || fail "compare with itself failed"
for pair in mean:0.0 maximum:0.0 ssim:1.0 ms_ssim:1.0 percentile95:0.0 mse:0.0 decibels:null identical:true; do
  [ "$(json "$scratch/aa.json" "${pair%:*}" | tr -d ' }\n')" = "${pair#*:}" ] ||
    fail "against itself ${pair%:*} is $(json "$scratch/aa.json" "${pair%:*}")"
done
"$verdigris" compare "$a" "$a" >"$scratch/aa.txt" 2>/dev/null || fail "compare failed"
grep -qE '^PSNR +identical' "$scratch/aa.txt" || fail "PSNR of equal pictures is not 'identical'"
grep -qE '^FLIP +0\.000000 .*67\.02 pixels per degree \(0\.7 m' "$scratch/aa.txt" ||
  fail "FLIP does not name its conditions"
grep -qE '^LPIPS +n/a ' "$scratch/aa.txt" || fail "LPIPS is not n/a"

# One metric alone is all that is told; a distance of one's own is.
"$verdigris" compare "$a" "$b" --metric psnr,flip --ppd 20 --json >"$scratch/two.json" 2>/dev/null || fail "--metric failed"
! grep -qE '"(ssim|lpips|ciede2000)"' "$scratch/two.json" || fail "--metric tells more than was asked"
[ "$(json "$scratch/two.json" pixels_per_degree | tr -d ' }\n')" = 20.0 ] || fail "--ppd is not told"
! near "$(json "$scratch/two.json" mean)" "$(json "$scratch/ab.json" mean)" 1e-4 || fail "--ppd changes nothing"

# Too small for five scales: a sentence, no number.
"$fixture" plate "$scratch/small" 2 64
"$verdigris" compare "$scratch/small/0000.png" "$scratch/small/0001.png" --json >"$scratch/small.json" 2>/dev/null ||
  fail "small pictures failed"
grep -q '"ms_ssim": null' "$scratch/small.json" || fail "MS-SSIM of a small picture is a number"
grep -q 'at least 161 x 161' "$scratch/small.json" || fail "MS-SSIM does not say what it needs"

# LPIPS: in a build that computes it a distance, elsewhere the reason why there is none.
"$fixture" lpips "$scratch/squeeze.safetensors"
echo hello >"$scratch/text.safetensors"
weights=(--metric lpips --lpips-weights "$scratch/squeeze.safetensors")
if "$verdigris" train --help | grep -q -- --epochs; then
  "$verdigris" compare "$a" "$b" "${weights[@]}" --json >"$scratch/lpips.json" 2>/dev/null || fail "LPIPS failed"
  grep -qE '"distance": 0\.0*[1-9]' "$scratch/lpips.json" || fail "LPIPS is no distance"
  "$verdigris" compare "$a" "$b" "${weights[@]}" --threads 1 --json 2>/dev/null | cmp -s - "$scratch/lpips.json" ||
    fail "LPIPS depends on the number of threads"
  grep -q '"net": "squeeze"' "$scratch/lpips.json" || fail "LPIPS does not name its net"
  "$verdigris" compare "$a" "$a" "${weights[@]}" --lpips-net squeeze >"$scratch/lpips.txt" || fail "LPIPS failed"
  grep -qE '^LPIPS +0\.000000 .*version 0\.1, squeeze' "$scratch/lpips.txt" || fail "LPIPS of equal pictures"
  expect 3 "squeeze\.safetensors.*holds the weights of squeeze, and vgg" \
    "$verdigris" compare "$a" "$b" "${weights[@]}" --lpips-net vgg
  expect 3 "text\.safetensors" "$verdigris" compare "$a" "$b" --metric lpips --lpips-weights "$scratch/text.safetensors"
  "$verdigris" compare "$a" "$b" --metric lpips >"$scratch/lpips.txt" || fail "LPIPS without weights is an error"
  grep -q 'n/a  no weights' "$scratch/lpips.txt" || fail "it does not ask for weights"
else
  "$verdigris" compare "$a" "$b" "${weights[@]}" >"$scratch/lpips.txt" || fail "LPIPS is an error here"
  grep -q 'n/a  this build has no libtorch' "$scratch/lpips.txt" || fail "it does not say why there is no LPIPS"
fi

# Alpha is ignored, and that is told.
if command -v ffmpeg >/dev/null; then
  ffmpeg -v error -i "$a" -vf 'format=rgba,colorchannelmixer=aa=0.3' "$scratch/alpha.png"
  "$verdigris" compare "$a" "$scratch/alpha.png" --metric psnr --json >"$scratch/alpha.json" 2>/dev/null ||
    fail "a picture with alpha failed"
  grep -q '"identical": true' "$scratch/alpha.json" || fail "alpha changes the colors"
  grep -q '"alpha\.png: the alpha channel is ignored' "$scratch/alpha.json" || fail "ignored alpha is not told, or its file is named twice"
fi

# What was limited, and where: each file once, shares in plain digits.
"$fixture" skies "$scratch/skies"
"$verdigris" compare "$scratch/skies/bright.exr" "$scratch/skies/bright.exr" --metric psnr 2>"$scratch/stderr" >/dev/null ||
  fail "a linear EXR failed"
grep -qE 'caution: bright\.exr: 100 % of its pixels' "$scratch/stderr" || fail "no plain share: $(cat "$scratch/stderr")"
grep -q 'note: bright\.exr: linear light' "$scratch/stderr" || fail "a conversion to sRGB is not told"
! grep -q 'exr: .*exr: ' "$scratch/stderr" || fail "a note names its file twice"

# Bad input: one sentence, the right status, no map.
"$fixture" hostile "$scratch/in"
bad() { # bad STATUS PATTERN ARGUMENTS...
  expect "$1" "$2" "$verdigris" compare "${@:3}" --map "$scratch/out/map.png"
  [ "$(grep -c . "$scratch/stderr")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/stderr")"
  expect_nothing "$scratch/out"
}
bad 3 "0000\.png.*192 x 192.*0000\.png.*64 x 64" "$a" "$scratch/small/0000.png"
bad 3 "nowhere\.png" "$a" "$scratch/nowhere.png"
bad 3 "plate" "$a" "$scratch/plate"
bad 3 "text\.mp4" "$scratch/in/text.mp4" "$a"
bad 3 "0005\.exr.*(NaN|not a number|finite)" "$scratch/in/nan/0005.exr" "$scratch/in/nan/0005.exr"
bad 2 "metric" "$a" "$b" --metric psnr,vmaf
bad 2 "add flip" "$a" "$b" --metric psnr
bad 2 "ppd" "$a" "$b" --ppd 0.5
bad 2 "lpips-net" "$a" "$b" --lpips-net resnet
expect 2 "map.*name is missing" "$verdigris" compare "$a" "$b" --map ""
expect_nothing "$scratch/out"
before=$(sha256sum <"$b")
expect 2 "0011\.png.*overwrite" "$verdigris" compare "$a" "$b" --map "$b"
[ "$(sha256sum <"$b")" = "$before" ] || fail "a picture was overwritten"
expect 2 "map\.jpg: .*\.png" "$verdigris" compare "$a" "$b" --map "$scratch/map.jpg"
[ ! -e "$scratch/map.jpg" ] || fail "a PNG is called .jpg"
: >"$scratch/file"
expect 1 "file/map\.png" "$verdigris" compare "$a" "$b" --map "$scratch/file/map.png"
[ ! -s "$scratch/stdout" ] || fail "results were told although the map failed"

# The authors' pair, if it is there.
if [ -d "$shared/flip" ]; then
  "$verdigris" compare "$shared/flip/tree-ref.png" "$shared/flip/tree-test.png" --ppd 67 --metric flip --json \
    >"$scratch/tree.json" 2>/dev/null || fail "the authors' pair failed"
  near "$(json "$scratch/tree.json" mean)" 0.133286 2e-6 || fail "FLIP of the authors' pair"
  near "$(json "$scratch/tree.json" median)" 0.333243 2e-5 || fail "its median"
fi
finish
