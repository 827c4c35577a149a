# Sourced by the tests of the program. Arguments: the program, the fixture maker, the shared data.
set -euo pipefail
verdigris=$1 fixture=$2 shared=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

fail() {
  echo "FAIL: $*" >&2
  failures=$((failures + 1))
}

# expect STATUS 'PATTERN' COMMAND...: runs it; checks the exit status, that stderr is one short
# sentence matching PATTERN, and that no sanitizer or abort message is in it.
expect() {
  local status=$1 pattern=$2 got=0
  shift 2
  "$@" >"$scratch/stdout" 2>"$scratch/stderr" || got=$?
  [ "$got" -eq "$status" ] || fail "status $got instead of $status from: $* ($(head -c 600 "$scratch/stderr"))"
  grep -qE "$pattern" "$scratch/stderr" || fail "no /$pattern/ on stderr of: $* ($(head -c 600 "$scratch/stderr"))"
  ! grep -qE 'Sanitizer|runtime error|terminate called|internal error' "$scratch/stderr" ||
    fail "crashed: $* ($(head -c 2000 "$scratch/stderr"))"
}

# expect_nothing DIR: no result, no half-written file, no hidden leftover.
expect_nothing() {
  [ ! -e "$1" ] || [ -z "$(find "$1" -mindepth 1 -print -quit)" ] ||
    fail "left behind in $1: $(find "$1" | head -5 | tr '\n' ' ')"
}

expect_no_partials() {
  [ -z "$(find "$1" \( -name '.partial-*' -o -name '*.tmp' \) -print -quit)" ] ||
    fail "half-written files in $1: $(find "$1" \( -name '.partial-*' -o -name '*.tmp' \) | head -3)"
}

expect_results() {
  local f
  for f in contact_sheet.png aged.glb manifest.json; do
    [ -s "$1/$f" ] || fail "$1/$f is missing"
  done
  [ -n "$(ls "$1"/textures)" ] || fail "$1/textures is empty"
  expect_no_partials "$1"
}

finish() {
  [ "$failures" -eq 0 ] || { echo "$failures failures"; exit 1; }
  exit 0
}
