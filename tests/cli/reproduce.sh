#!/usr/bin/env bash
# The paper's tables by one command, at its smallest: stopped, killed, gone on with, and a second run
# that does nothing. Then what must be refused.
source "$(dirname "$0")/lib.sh"
export GOMP_SPINCOUNT=0
for preset in chamber air; do
  "$verdigris" simulate --preset $preset --size 160x120 --frames 300 -o "$scratch/$preset.mkv" --quiet ||
    fail "simulate failed"
done
two=(--recordings "$scratch/chamber.mkv" "$scratch/air.mkv")
out=$scratch/out

# Ctrl-C once a task runs: 130, nobody left behind, and what was done is known.
"$verdigris" reproduce "${two[@]}" --quick --jobs 2 -o "$out" >/dev/null 2>"$scratch/first.err" &
pid=$!
for _ in $(seq 600); do
  ! grep -qs '"state": "done"' "$out"/tasks/*.json || break
  sleep 0.1
done
expect 4 "is being worked on by another process" "$verdigris" reproduce "${two[@]}" --quick -o "$out"
kill -INT $pid
status=0
wait $pid || status=$?
[ $status -eq 130 ] || fail "status $status after an interrupt: $(tail -3 "$scratch/first.err")"
! pgrep -P $pid >/dev/null || fail "a task outlives an interrupted run"
grep -q "tasks of .* on 2 cores by itself that takes about" "$scratch/first.err" || fail "no estimate before it starts"
[ ! -e "$out/report.html" ] || fail "an interrupted run left a report"
done_before=$(grep -l '"state": "done"' "$out"/tasks/*.json | sort)
[ -n "$done_before" ] || fail "nothing was done before the interrupt: the test tests nothing"
declare -A when
for f in $done_before; do when[$f]=$(stat -c %y "$f"); done

# Killed outright, with its tasks; then to the end.
"$verdigris" reproduce "${two[@]}" --quick --jobs 2 -o "$out" >/dev/null 2>&1 &
pid=$!
for _ in $(seq 200); do
  ! grep -qs '"state": "begun"' "$out"/tasks/*.json || break
  sleep 0.1
done
sleep 1
kill -KILL $pid
wait $pid 2>/dev/null || true
"$verdigris" reproduce "${two[@]}" --quick --jobs 2 -o "$out" --json >"$scratch/run.json" 2>"$scratch/stderr" ||
  fail "did not go on: $(tail -3 "$scratch/stderr")"
for f in $done_before; do
  [ "${when[$f]}" = "$(stat -c %y "$f")" ] || fail "${f##*/} was done again though nothing changed"
done
for f in report.html reproduction.json commands.json SHA256SUMS tables/table1.tex tables/table2.csv \
  tables/table3.json tables/figure4-gains.tex tables/figure5.tex tables/training.tex audits/evaluate.json; do
  [ -s "$out/$f" ] || fail "reproduce left no $f"
done
! command -v gnuplot >/dev/null || [ -s "$out/figures/figure3.svg" ] || fail "no figure 3"
expect_no_partials "$out"
grep -q "not the paper's settings" "$out/tables/table1.tex" || fail "a quick table does not say so"
grep -q ",horizonnet,0.00831,[^,]*,-37.85," "$out/tables/table1.csv" || fail "the paper's value is not beside ours"
! grep -q '"state": "failed"' "$scratch/run.json" || fail "a task failed: $(grep -B3 -A2 '"failed"' "$scratch/run.json")"
if "$verdigris" train --help | grep -q -- --epochs; then
  grep -q '"id": "evaluate-patinanet"' "$scratch/run.json" || fail "no network was judged"
else
  grep -q "no trained forecasters" "$out/report.html" || fail "the page does not say why there is no network"
fi
# A number of the page is that of the command beside it.
command=$(sed -n 's/^ *"command": "verdigris \(evaluate .*-o evaluate .*\)",$/\1/p' "$scratch/run.json")
(cd "$out" && "$verdigris" ${command/-o evaluate/-o $scratch/by_hand} --quiet) || fail "not a command: $command"
cmp -s "$out/evaluate/evaluation.json" "$scratch/by_hand/evaluation.json" || fail "a command by hand gives other numbers"

# Again: nothing is done. With a damaged result: only that, and what follows from it.
"$verdigris" reproduce "${two[@]}" --quick -o "$out" >"$scratch/stdout" 2>/dev/null || fail "a second run failed"
grep -q "^Tasks *0 done" "$scratch/stdout" || fail "a second run did something: $(grep Tasks "$scratch/stdout")"
echo " " >>"$out/drift/drift.json"
"$verdigris" reproduce "${two[@]}" --quick -o "$out" >"$scratch/stdout" 2>/dev/null || fail "a third run failed"
grep -q "^Tasks *1 done" "$scratch/stdout" || fail "not only drift was done again: $(grep Tasks "$scratch/stdout")"

# A task that fails does not take the rest along: the second recording is too short to be judged.
"$verdigris" simulate --preset air --size 160x120 --frames 12 -o "$scratch/short.mkv" --quiet
expect 1 "tasks? failed.* the rest is done" "$verdigris" reproduce --recordings "$scratch/chamber.mkv" \
  "$scratch/short.mkv" --quick --jobs 2 -o "$scratch/failing" --quiet
grep -q "failed: .*short" "$scratch/failing/report.html" || fail "the page does not say what failed"
[ ! -e "$scratch/failing/evaluate" ] || fail "a failed task left a result"

# Bad input: one sentence, the right status, nothing left.
bad() { # bad STATUS PATTERN ARGUMENTS...
  expect "$1" "$2" "$verdigris" reproduce --quick "${@:3}" -o "$scratch/bad"
  [ "$(grep -c . "$scratch/stderr")" -eq 1 ] || fail "more than a sentence: $(cat "$scratch/stderr")"
  expect_nothing "$scratch/bad"
}
cp "$scratch/chamber.mkv" "$scratch/copy.mkv"
bad 3 "nowhere\.mkv: there is no such file" --recordings "$scratch/chamber.mkv" "$scratch/nowhere.mkv"
bad 3 "nocopper: there is no such file" "${two[@]}" --copper "$scratch/nocopper"
bad 4 "chamber\.mkv: is the same recording" --recordings "$scratch/chamber.mkv" "$scratch/chamber.mkv"
bad 4 "copy\.mkv: is the same recording as chamber\.mkv" --recordings "$scratch/chamber.mkv" "$scratch/copy.mkv"
echo "dear sir" >"$scratch/letter.mkv"
bad 3 "letter\.mkv: is not a video" --recordings "$scratch/chamber.mkv" "$scratch/letter.mkv"
bad 3 "letter\.mkv: is not a video" "${two[@]}" --copper "$scratch/letter.mkv"
bad 2 "recordings" --recordings "$scratch/chamber.mkv"
expect 1 "file/sub: " "$verdigris" reproduce --quick "${two[@]}" -o "$scratch/copy.mkv/file/sub"
expect 4 "begun with --quick" "$verdigris" reproduce "${two[@]}" -o "$out"
expect 4 "with other recordings" "$verdigris" reproduce --quick -o "$out"
expect 4 "holds a result of .evaluate." "$verdigris" reproduce --quick "${two[@]}" -o "$out/evaluate"
expect 4 "holds a result of .reproduce." "$verdigris" evaluate "${two[@]:1}" -o "$out"
for damaged in '' '[]' '{"settings":5}' '{"settings":{}}' '{"settings":{"quick":"yes","recordings":[]}}'; do
  mkdir -p "$scratch/damaged" && printf '%s' "$damaged" >"$scratch/damaged/reproduction.json"
  expect 3 "reproduction\.json: is not what .reproduce. writes" \
    "$verdigris" reproduce --quick "${two[@]}" -o "$scratch/damaged"
done
mkdir "$scratch/mine" && echo mine >"$scratch/mine/thesis.tex"
expect 4 "thesis\.tex" "$verdigris" reproduce --quick "${two[@]}" -o "$scratch/mine"
[ "$(ls "$scratch/mine")" = thesis.tex ] || fail "reproduce wrote into a foreign folder"
finish
