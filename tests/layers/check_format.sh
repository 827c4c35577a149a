#!/usr/bin/env bash
# All C++ is as clang-format leaves it.  check_format.sh ROOT CLANG_FORMAT
set -euo pipefail
cd "$1"
find verdigris apps tests bench -name node_modules -prune -o \
  \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 "$2" --dry-run -Werror
