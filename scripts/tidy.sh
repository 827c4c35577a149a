#!/usr/bin/env bash
# clang-tidy over every source of the library and the program (see .clang-tidy).
set -euo pipefail
cd "$(dirname "$0")/.."
[ -f build/ci/compile_commands.json ] || scripts/build.sh ci
tidy=$(command -v clang-tidy-14 || command -v clang-tidy)
find verdigris apps/cli -name '*.cpp' -not -name '*_test.cpp' -print0 |
  xargs -0 -P "$(nproc)" -n 4 "$tidy" -p build/ci --quiet 2>/dev/null
