#!/usr/bin/env bash
# Ctrl-C at many moments: status 130 (or a finished run), never half a file, and a rerun succeeds.
# --foreground: otherwise timeout signals the process and then its group, and the second signal, if it
# arrives apart, means what a second Ctrl-C means: end at once, and leave the partial folder to the
# next run.
source "$(dirname "$0")/lib.sh"
"$fixture" plate "$scratch/plate" 60 256
hit=0
for delay in 0.02 0.05 0.1 0.15 0.2 0.3 0.4 0.5 0.7 0.9 1.2; do
  rm -rf "$scratch/out"
  status=0
  timeout --foreground --preserve-status -s INT "$delay" "$verdigris" age "$scratch/plate" -o "$scratch/out" \
    >"$scratch/stdout" 2>"$scratch/stderr" || status=$?
  case $status in
    0) continue ;;
    130) hit=$((hit + 1)) ;;
    *) fail "status $status after an interrupt at $delay s: $(head -c 400 "$scratch/stderr")" ;;
  esac
  if [ -e "$scratch/out" ]; then
    expect_no_partials "$scratch/out"
    [ ! -e "$scratch/out/manifest.json" ] || fail "interrupted at $delay s, yet there is a manifest"
    [ ! -e "$scratch/out/observed" ] || [ -s "$scratch/out/observed/observation.json" ] ||
      fail "half an observation at $delay s"
  fi
done
[ "$hit" -gt 0 ] || fail "no run was slow enough to be interrupted: the test tests nothing"
"$verdigris" age "$scratch/plate" -o "$scratch/out" --quiet || fail "cannot be started again"
expect_results "$scratch/out"

# An interrupted second run leaves the first result whole.
(cd "$scratch/out" && sha256sum contact_sheet.png aged.glb manifest.json) >"$scratch/before"
timeout --foreground --preserve-status -s INT 0.15 "$verdigris" age "$scratch/plate" -o "$scratch/out" --horizons 7 \
  >/dev/null 2>&1 || true
if ! grep -q '"u007"\|7.0\|\b7\b' "$scratch/out/manifest.json" || [ -e "$scratch/out/forecast/forecast_u005.png" ]; then
  (cd "$scratch/out" && sha256sum -c --quiet "$scratch/before") || fail "an interrupted rerun damaged the result"
fi
expect_no_partials "$scratch/out"
finish
