#!/usr/bin/env bash
# Is the capture advice of `inspect` good? As docs/RESULTS.md quotes it: recordings of 98 frames are cut
# off after their first 10 and 20 frames, from every tenth frame on; what the advice expects of 10, 20
# and 30 more is held against the error of the ten frames that follow each cut. Medians over cuts; then how far
# off the ratios are, cut by cut, and how those would be who always said the same.
#   scripts/advice_results.sh "SEED..." [FOLDER_OF_RECORDINGS]
# What was measured of every cut is kept in out/advice/.
set -euo pipefail
cd "$(dirname "$0")/.."
seeds=${1:-703 704}
build=${BUILD:-build/ci}
[ -x "$build/verdigris_capture_advice_trial" ] || [ -x "$build/bench/verdigris_capture_advice_trial" ] ||
  cmake --build "$build" --target verdigris_capture_advice_trial verdigris_cli
trial=$(find "$build" -name verdigris_capture_advice_trial -type f | head -1)
out=out/advice
mkdir -p "$out"
for preset in chamber air uniform spotted reversal patina; do
  for seed in $seeds; do
    recording=$out/$preset-$seed.mkv
    [ -e "$recording" ] ||
      "$build/bin/verdigris" simulate --preset $preset --seed "$seed" --frames 98 -o "$recording" --quiet
    [ -s "$out/$preset-$seed.txt" ] || "$trial" 1 "$recording" >"$out/$preset-$seed.txt"
  done
done
for recording in ${2:+"$2"/*/}; do
  name=$(basename "$recording")
  [ -s "$out/$name.txt" ] || "$trial" 1 "${recording%/}" >"$out/$name.txt"
done
for preset in chamber air uniform spotted reversal patina; do
  for seed in $seeds; do cat "$out/$preset-$seed.txt"; done
done >"$out/all"
for recording in ${2:+"$2"/*/}; do cat "$out/$(basename "$recording").txt"; done >>"$out/all"
awk '
  function median(list, n, i, j, t) {
    for (i = 2; i <= n; ++i)
      for (j = i; j > 1 && list[j] < list[j - 1]; --j) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
    return n % 2 ? list[(n + 1) / 2] : (list[n / 2] + list[n / 2 + 1]) / 2
  }
  function log2(x) { return log(x) / log(2) }
  {
    name = $1; sub(/(-[0-9]+)?\.mkv$/, "", name)
    key = name " | " $3 " | " $4
    if (!(key in count)) keys[++all] = key
    k = ++count[key]; expected[key, k] = $7; found[key, k] = $8; told[key, k] = $5 / $6
    ++n; truth = log2($8); advice = log2($7); root = 0.5 * log2($3 / ($3 + $4))
    off += (truth - advice) ^ 2; off_one += truth ^ 2; off_root += (truth - root) ^ 2
    sum += truth; square += truth ^ 2
    within += (truth - advice) ^ 2 <= 1; within_one += truth ^ 2 <= 1
    said = advice <= -1; was = truth <= -1
    right += said && was; wrong += said && !was; missed += !said && was
  }
  END {
    print "| specimen | n | more | cuts | expected / measured error at n | ratio expected | ratio measured |"
    print "|---|---|---|---|---|---|---|"
    for (i = 1; i <= all; ++i) {
      key = keys[i]; split("", a); split("", b); split("", c)
      for (k = 1; k <= count[key]; ++k) { a[k] = expected[key, k]; b[k] = found[key, k]; c[k] = told[key, k] }
      printf "| %s | %d | %.2f | %.2f | %.2f |\n", key, count[key], median(c, count[key]),
        median(a, count[key]), median(b, count[key])
    }
    printf "%d cuts. Root mean square of log2(expected ratio / measured): advice %.2f; always 1: %.2f; square root of n / (n + m): %.2f.\n",
      n, sqrt(off / n), sqrt(off_one / n), sqrt(off_root / n)
    printf "The measured ratios themselves scatter by %.2f. Within a factor of two: advice %d, always 1 %d.\n",
      sqrt(square / n - (sum / n) ^ 2), within, within_one
    printf "Said to be halved: %d, of which %d were; of %d that were halved, not said: %d.\n",
      right + wrong, right, right + missed, missed
  }' "$out/all"
