#!/usr/bin/env bash
# Installs, builds and runs every test: the checks of the house, each room's tests, the program on
# good and bad input, the glTF validator, the viewer in a real browser, and the same tests again
# under the address and undefined-behavior sanitizers.
#   scripts/test.sh          all
#   scripts/test.sh --quick  without the sanitizers and clang-tidy
set -euo pipefail
cd "$(dirname "$0")/.."
quick=
[ "${1:-}" != --quick ] || quick=1
scripts/install_packages.sh build viewer test
scripts/build.sh ci
ctest --preset ci -j2
if [ -z "$quick" ]; then
  scripts/build.sh sanitize
  ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1 \
    UBSAN_OPTIONS=print_stacktrace=1 ctest --preset sanitize -j2 -LE 'house|browser'
  scripts/tidy.sh
fi
echo "All tests passed."
