#!/usr/bin/env bash
# Networks trained, judged, handed to `age` and looked into, as a researcher would; then what must be
# refused. Tiny crops: what is tested is the program, not what networks can do.
source "$(dirname "$0")/lib.sh"
export GOMP_SPINCOUNT=0
for preset in chamber air; do
  "$verdigris" simulate --preset $preset --size 160x120 --frames 300 -o "$scratch/$preset.mkv" --quiet ||
    fail "simulate failed"
done
chamber=$scratch/chamber.mkv air=$scratch/air.mkv runs=$scratch/runs
few=(--size 32 --horizons 4)
train=("${few[@]}" --train-windows 8 --batch 4 --threads 1)

"$verdigris" train patinanet --source "$chamber" "${train[@]}" --epochs 2 -o "$runs/chamber" --json \
  >"$scratch/train.json" 2>/dev/null || fail "train failed"
for f in best.safetensors last.safetensors metrics.jsonl protocol.toml; do
  [ -s "$runs/chamber/$f" ] || fail "train left no $f"
done
! command -v gnuplot >/dev/null || [ -s "$runs/chamber/loss.svg" ] || fail "train drew no loss"
grep -q '"parameters": 170623' "$scratch/train.json" || fail "not the paper's size"
[ "$(wc -l <"$runs/chamber/metrics.jsonl")" -eq 2 ] || fail "not a line per epoch"
"$verdigris" train patinanet --source "$air" "${train[@]}" --epochs 1 -o "$runs/air" --quiet || fail "train failed"

# A protocol's area is for judging: it is not refused, and what is learned from is said.
sed 's/^area = .*/area = "specimen"/' "$runs/chamber/protocol.toml" >"$scratch/specimen.toml"
grep -q '^area = "specimen"' "$scratch/specimen.toml" || fail "a run's protocol has no area"
"$verdigris" train patinanet --source "$air" --protocol "$scratch/specimen.toml" --train-windows 4 --batch 4 --threads 1 \
  --epochs 1 -o "$runs/area" >"$scratch/said" || fail "train refused a protocol"
grep -q "whole frames: the protocol's area" "$scratch/said" || fail "train does not say what it learns from"

# Judged: each checkpoint on the recording that it did not learn from.
both=$runs/chamber/best.safetensors,$runs/air/best.safetensors,affinergb
"$verdigris" evaluate "$chamber" "$air" "${few[@]}" --windows 12 --forecasters "$both" -o "$scratch/ev" --json \
  >"$scratch/ev.json" 2>/dev/null || fail "evaluate failed"
[ "$(grep -c '"patinanet"' "$scratch/ev.json")" -ge 2 ] || fail "patinanet is not in both directions"
"$verdigris" audit "$scratch/ev" --quiet || fail "the audit finds fault with a clean result"
one=$runs/chamber/best.safetensors
expect 4 "no checkpoint of patinanet learned from" "$verdigris" evaluate "$chamber" "$air" "${few[@]}" \
  --windows 4 --forecasters "$one" -o "$scratch/refused"
"$verdigris" evaluate "$chamber" "$air" "${few[@]}" --windows 12 --forecasters "$one" --hold-out air \
  -o "$scratch/held" --json >"$scratch/held.json" 2>/dev/null || fail "--hold-out failed"
! grep -q '"air -> chamber"' "$scratch/held.json" || fail "--hold-out judged the other direction too"
expect 4 "at 32 x 32 pixels\); it would have to be chamber.*at 64 x 64 pixels.*same --size" "$verdigris" evaluate \
  "$chamber" "$air" --size 64 --horizons 4 --windows 4 --hold-out air --forecasters "$one" -o "$scratch/refused"
# What train says at its end can be done as it says.
"$verdigris" train patinanet --source "$chamber" "${train[@]}" --epochs 2 -o "$runs/chamber" --resume >"$scratch/said" ||
  fail "a finished run cannot be looked at again"
hint=$(sed -n 's/^Judge it *verdigris //p' "$scratch/said" | sed "s|RESULTS|$scratch/hint|; s|--hold-out OTHER|--hold-out air|; s|OTHER|$air|")
"$verdigris" $hint --windows 4 --quiet || fail "the hint is wrong: $hint"
expect 2 "no recording 'sea' to hold out" "$verdigris" evaluate "$chamber" "$air" "${few[@]}" --windows 4 \
  --hold-out sea -o "$scratch/refused"
expect 4 "is trained, and a single recording" "$verdigris" evaluate "$air" "${few[@]}" --single \
  --forecasters "$one" -o "$scratch/refused"
expect 2 "trained on contexts of 5" "$verdigris" evaluate "$chamber" "$air" "${few[@]}" --context 6 --windows 4 \
  --forecasters "$one" --hold-out air -o "$scratch/refused"
expect_nothing "$scratch/refused"

# Continues the specimen it knows; says so where it does not.
"$verdigris" age "$chamber" -o "$scratch/aged" --size 64 --horizons 1,2 --forecaster "$one" --force \
  >"$scratch/age.out" 2>"$scratch/age.err" || fail "age failed: $(head -c 400 "$scratch/age.err")"
expect_results "$scratch/aged"
! grep -q "learned from" "$scratch/age.err" || fail "age calls a known recording unknown"
"$verdigris" age "$air" -o "$scratch/aged2" --size 64 --horizons 1,2 --forecaster "$one" --force \
  >/dev/null 2>"$scratch/age.err" || fail "age failed on another recording"
grep -q "learned from chamber, not from air" "$scratch/age.err" || fail "age does not say what it learned from"

"$verdigris" susceptibility "$runs/chamber" "$chamber" "$air" "${few[@]}" -o "$scratch/rho" --json \
  >"$scratch/rho.json" 2>/dev/null || fail "susceptibility failed"
for f in report.html susceptibility.json maps.png tables/susceptibility.csv SHA256SUMS; do
  [ -s "$scratch/rho/$f" ] || fail "susceptibility left no $f"
done

# Interrupted, then gone on with: the same weights as without.
slow=(train convlstm --source "$chamber" "${train[@]}" --epochs 3)
"$verdigris" "${slow[@]}" -o "$runs/whole" --quiet || fail "train failed"
"$verdigris" "${slow[@]}" -o "$runs/broken" --quiet &
pid=$!
for _ in $(seq 600); do
  [ ! -s "$runs/broken/last.safetensors" ] || break
  sleep 0.05
done
kill -INT $pid
status=0
wait $pid || status=$?
[ $status -eq 130 ] || [ $status -eq 0 ] || fail "interrupted train gave $status"
expect_no_partials "$runs/broken"
"$verdigris" "${slow[@]}" -o "$runs/broken" --quiet --resume || fail "--resume failed"
cmp -s "$runs/whole/best.safetensors" "$runs/broken/best.safetensors" || fail "a resumed run is not the whole one"
expect 4 "holds a run already" "$verdigris" "${slow[@]}" -o "$runs/whole"
expect 4 "differs in --seed;" "$verdigris" "${slow[@]}" --seed 3 -o "$runs/whole" --resume
# Rules that the checkpoint does not carry: the run's own file has them, and keeps them.
rules=$(sha256sum "$runs/whole/protocol.toml")
expect 4 "other rules than are asked for .tau in its protocol.toml" "$verdigris" "${slow[@]}" --tau 0.0011 \
  -o "$runs/whole" --resume
[ "$rules" = "$(sha256sum "$runs/whole/protocol.toml")" ] || fail "a refused --resume changed the rules"

# A disk that is full: files of at most 3 MB, which a checkpoint of this network is above.
before=$(sha256sum "$runs/chamber/best.safetensors")
(
  ulimit -f 3000
  trap '' XFSZ
  expect 1 "disk is full|larger than the system allows" "$verdigris" train convlstm --source "$chamber" "${train[@]}" \
    --epochs 1 -o "$runs/full"
  [ "$failures" -eq 0 ]
) || fail "a full disk is not told"
[ ! -e "$runs/full/best.safetensors" ] || fail "half a checkpoint was left"
expect_no_partials "$runs/full"
[ "$before" = "$(sha256sum "$runs/chamber/best.safetensors")" ] || fail "another run's checkpoint changed"

# Bad input.
expect 2 "no network 'resnet'" "$verdigris" train resnet --source "$chamber" "${train[@]}" -o "$runs/x"
expect 2 "epochs must be" "$verdigris" train patinanet --source "$chamber" "${train[@]}" --epochs 0 -o "$runs/x"
expect 2 "train-windows limits" "$verdigris" train patinanet --source "$chamber" "${train[@]}" --windows 4 -o "$runs/x"
expect 2 "for judging" "$verdigris" train patinanet --source "$chamber" "${train[@]}" --area specimen -o "$runs/x"
expect 4 "is the same recording as chamber" "$verdigris" train patinanet --source "$chamber" "$chamber" "${train[@]}" \
  -o "$runs/x"
expect 1 "CUDA was asked for" "$verdigris" train patinanet --source "$chamber" "${train[@]}" --device cuda -o "$runs/x"
expect 2 "only patinanet" "$verdigris" susceptibility "$runs/whole" "$chamber" "${few[@]}" -o "$runs/x"
expect_nothing "$runs/x"
head -c 1000 "$one" >"$scratch/cut.safetensors"
printf '\377\377\377\377\377\377\377\177{}' >"$scratch/hostile.safetensors"
echo hello >"$scratch/text.safetensors"
for f in cut hostile text absent; do
  expect 3 "$f.safetensors" "$verdigris" evaluate "$chamber" "$air" "${few[@]}" \
    --forecasters "$scratch/$f.safetensors" -o "$scratch/refused"
  expect 3 "$f.safetensors" "$verdigris" age "$chamber" -o "$scratch/refused" --forecaster "$scratch/$f.safetensors"
done
expect_nothing "$scratch/refused"
finish
