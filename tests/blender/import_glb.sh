#!/usr/bin/env bash
# aged.glb of a made plate in Blender: every map on its socket, in its color space; and a file with
# something wrong is noticed.  import_glb.sh BLENDER VERDIGRIS FIXTURE
set -euo pipefail
blender=$1 verdigris=$2 fixture=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$fixture" plate "$scratch/plate" 20 64
"$verdigris" age "$scratch/plate" -o "$scratch/made" --horizons 5,10 --quiet 2>/dev/null

import() { # import FILE STATES
  "$blender" -b --factory-startup -noaudio --python "$here/import_glb.py" -- "$1" "$2" \
    >"$scratch/said" 2>&1
}
fail() {
  echo "FAIL: $*" >&2
  cat "$scratch/said" >&2
  exit 1
}
import "$scratch/made/aged.glb" 3 || fail "the import is not as wanted"
grep -q '^blender: fine$' "$scratch/said" || fail "Blender ended without a word"
! grep -iE '^(error|warning)|traceback' "$scratch/said" || fail "Blender complains"

# The JSON of a GLB stays valid if a name in it is misspelled at the same length.
misspelled() { # misspelled WORD INSTEAD PATTERN
  LC_ALL=C sed "s/\"$1\"/\"$2\"/g" "$scratch/made/aged.glb" >"$scratch/wrong.glb"
  ! cmp -s "$scratch/made/aged.glb" "$scratch/wrong.glb" || fail "there is no $1 to misspell"
  ! import "$scratch/wrong.glb" 3 || fail "without $1 nothing is said"
  grep -qE "WRONG: .*$3" "$scratch/said" || fail "without $1: no /$3/"
}
misspelled normalTexture xormalTexture "no normal map"
misspelled baseColorTexture xaseColorTexture "base color: no picture"
misspelled metallicRoughnessTexture xetallicRoughnessTexture "Roughness is not taken"
misspelled doubleSided xoubleSided "back is culled"
! import "$scratch/made/aged.glb" 4 || fail "a missing state is not noticed"
head -c 4000 "$scratch/made/aged.glb" >"$scratch/cut.glb"
! import "$scratch/cut.glb" 3 || fail "a cut file is not noticed"
grep -q "WRONG: the import failed" "$scratch/said" || fail "a cut file imports"
