#!/usr/bin/env bash
# What auto does with recordings that no forecaster should be shown: still scenes, noise, switched and
# flickering light, a moved tripod, a hand. Gain over holding still (t+1 ... t+10, percent), and the worst of
# the ten units, as docs/RESULTS.md quotes them. Made ones are simulated, then spoiled with ffmpeg.
#   scripts/junk_results.sh [RECORDING...]     more recordings, judged with --stride 3
# Reports are kept in out/junk/.
set -euo pipefail
cd "$(dirname "$0")/.."
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
out=out/junk
mkdir -p "$out"
. scripts/simulated.sh
# spoiled NAME FROM FILTER: a recording through a filter of ffmpeg, without loss.
spoiled() {
  [ -e "$out/$1.mkv" ] && return
  ffmpeg -nostdin -v error -i "$out/$2.mkv" -vf "$3" -c:v ffv1 -y "$out/.$1.mkv"
  mv "$out/.$1.mkv" "$out/$1.mkv"
}
made "$out/aging.mkv" chamber 501 320x240
made "$out/still.mkv" chamber 501 320x240 oxide.rate=1e-9
made "$out/noise.mkv" chamber 501 320x240 oxide.rate=1e-9 camera.read_noise=0.02
made "$out/jitter.mkv" chamber 501 320x240 oxide.rate=1e-9 camera.jitter=0.03
made "$out/jitter-aging.mkv" chamber 501 320x240 camera.jitter=0.03
made "$out/jitter-no-backdrop.mkv" chamber 501 320x240 camera.jitter=0.03 scene.width=8 scene.height=8
made "$out/bands.mkv" chamber 501 320x240 oxide.rate=1e-9 camera.flicker=0.05
made "$out/flicker-no-backdrop.mkv" chamber 501 320x240 oxide.rate=1e-9 camera.jitter=0.03 scene.width=8 scene.height=8
made "$out/drift.mkv" chamber 501 320x240 oxide.rate=1e-9 camera.light_drift=0.1
spoiled switched-on still "eq=brightness=0.2:enable='gte(n,492)'"
spoiled switched-on-aging aging "eq=brightness=0.2:enable='gte(n,492)'"
spoiled switching still "eq=brightness=0.1:enable='lt(mod(n,37),18)'"
spoiled tripod still "crop=300:220:'if(lt(n,492),4,14)':'if(lt(n,492),4,9)'"
spoiled tripod-aging aging "crop=300:220:'if(lt(n,492),4,14)':'if(lt(n,492),4,9)'"
spoiled shaking aging "crop=300:220:'10+3*sin(n*1.7)':'10+3*sin(n*2.3)'"
spoiled hand aging "drawbox=x=120:y=60:w=90:h=120:color=0x805040:t=fill:enable='lt(mod(n,53),4)'"
spoiled flash aging "eq=brightness=0.4:enable='lt(mod(n,41),2)'"
spoiled fade aging "fade=out:s=400:n=500"
spoiled reversed aging "reverse"
spoiled looped aging "select='lt(mod(n,200),100)',setpts=N/24/TB"
printf '%-26s %3s %12s %12s %8s\n' "recording" n "affinergb" auto worst
# judge NAME N ARGUMENTS...
judge() {
  local name=$1 n=$2
  shift 2
  if ! "$verdigris" evaluate "$@" --single --context "$n" -o "$out/$name-n$n" \
    --forecasters persistence,affinergb,auto --force --quiet 2>"$out/$name-n$n.err"; then
    printf '%-26s %3d   %s\n' "$name" "$n" "$(tail -n 1 "$out/$name-n$n.err")"
    return
  fi
  awk -F, -v name="$name" -v n="$n" 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { f = $column["forecaster"]; h = $column["horizon"]; e = $column["foreground"]; sum[f] += e; at[f, h] += e }
    END { worst = 9; for (h = 1; h <= 10; ++h) { g = 1 - at["auto", h] / at["persistence", h]; if (g < worst) worst = g }
      printf "%-26s %3d %+12.1f %+12.1f %+8.1f\n", name, n, 100 * (1 - sum["affinergb"] / sum["persistence"]),
        100 * (1 - sum["auto"] / sum["persistence"]), 100 * worst }' "$out/$name-n$n/tables/windows_all.csv"
}
for n in 5 10; do
  for file in "$out"/*.mkv; do
    name=$(basename "$file" .mkv)
    judge "$name" $n "$file" --windows 60
  done
  for file in "$@"; do judge "$(basename "$file")" $n "$file" --stride 3; done
done
