#!/usr/bin/env bash
# The comparison can fail, and says what is needed to act on it.
#   mutations.sh COMPARE
set -euo pipefail
compare=$1
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
  echo "FAIL: $*" >&2
  exit 1
}
count=0
for golden in "$here"/*.png; do
  count=$((count + 1))
  name=$(basename "$golden" .png)
  "$compare" check "$golden" "$golden" 0 0 1 "$scratch/failed" >/dev/null ||
    fail "$name differs from itself"
  [ ! -e "$scratch/failed" ] || fail "a picture that agrees was written as failed"
  "$compare" nudge "$golden" "$scratch/$name.png" 5
  "$compare" check "$scratch/$name.png" "$golden" 5 0.2 1 "$scratch/failed" >/dev/null ||
    fail "$name: five codes are not within five"
  ! "$compare" check "$scratch/$name.png" "$golden" 4 255 1 "$scratch/failed" 2>"$scratch/said" ||
    fail "$name: a patch of five codes passes for four"
  grep -q "FAIL: $name: worst difference 5.00 of 255 at 0,0 (allowed 4), mean 0\.[0-9]* " \
    "$scratch/said" || fail "$name: the message does not give name and numbers: $(cat "$scratch/said")"
  for kind in actual difference; do
    grep -q "$scratch/failed/$name.$kind.png" "$scratch/said" || fail "$name: $kind is not named"
    [ -s "$scratch/failed/$name.$kind.png" ] || fail "$name: $kind was not written"
  done
  ! "$compare" check "$scratch/$name.png" "$golden" 255 0 1 "$scratch/failed" 2>/dev/null ||
    fail "$name: the mean is not held to"
  rm -rf "$scratch/failed"
done
[ "$count" -eq 9 ] || fail "$count golden pictures instead of 9"
! "$compare" check "$here/color.png" "$here/forecast_u010.png" 255 255 1 "$scratch/failed" \
  2>"$scratch/said" || fail "8 bits pass for 16"
grep -q "FAIL: forecast_u010: " "$scratch/said" || fail "another depth is not named"
! "$compare" check "$here/color.png" "$here/contact_sheet.png" 255 255 1 "$scratch/failed" \
  2>/dev/null || fail "another size passes"
