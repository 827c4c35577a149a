#!/usr/bin/env bash
# `inspect` says whether it is worth recording on, and always says something.
source "$(dirname "$0")/lib.sh"

# advice RECORDING: its line; inspect must not fail because of it.
advice() {
  "$verdigris" inspect "$1" 2>/dev/null >"$scratch/out" || fail "inspect fails on $1"
  [ "$(grep -c '^advice ' "$scratch/out")" -eq 1 ] || fail "not one line of advice on $1"
  sed -n 's/^advice  *//p' "$scratch/out"
}
id_of() {
  "$verdigris" inspect "$1" --json 2>/dev/null >"$scratch/json" || fail "inspect --json fails on $1"
  sed -n '/^  "advice": {/,$ s/^    "id": "\(.*\)",$/\1/p' "$scratch/json"
}

"$fixture" plate "$scratch/plate" 24 64
advice "$scratch/plate" | grep -qE '^Over the next ten units the forecast may be off by about [0-9.]+ % of full scale' ||
  fail "no expected error: $(advice "$scratch/plate")"
case $(id_of "$scratch/plate") in
enough | record_on | light | noise | unforeseen) ;;
*) fail "unknown advice $(id_of "$scratch/plate")" ;;
esac
for key in expected_error noise_share light_share unforeseen_share halved outlooks; do
  grep -q "\"$key\":" "$scratch/json" || fail "--json has no $key"
done
# The same at any number of threads.
"$verdigris" inspect "$scratch/plate" --json --threads 1 2>/dev/null >"$scratch/one"
cmp -s "$scratch/one" "$scratch/json" || fail "the advice depends on the number of threads"

# Too few; two frames that are one; a scene that is still.
frames() { find "$scratch/plate" -name '*.png' | sort; }
mkdir "$scratch/few" "$scratch/twins" "$scratch/still"
frames | head -3 | xargs -I{} cp {} "$scratch/few"
for i in 1 2; do cp "$(frames | head -1)" "$scratch/twins/$i.png"; done
for i in $(seq -w 12); do cp "$(frames | head -1)" "$scratch/still/$i.png"; done
[ "$(id_of "$scratch/few")" = too_few ] || fail "three frames: $(advice "$scratch/few")"
[ -n "$(advice "$scratch/twins")" ] || fail "two identical frames: no advice"
[ "$(id_of "$scratch/still")" = still ] || fail "a still scene: $(advice "$scratch/still")"
mkdir "$scratch/single"
cp "$(frames | head -1)" "$scratch/single/1.png"
[ "$(id_of "$scratch/single")" = too_few ] || fail "one frame: $(advice "$scratch/single")"
finish
