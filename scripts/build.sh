#!/usr/bin/env bash
# Configures and builds one preset:  build.sh [release|dev|sanitize|ci] [targets...]
# Quiet when all goes well; build.log has the rest.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
shift || true
mkdir -p "build/$preset"
log="build/$preset/build.log"
targets=()
[ $# -eq 0 ] || targets=(--target "$@")
echo "Building ($preset); the first time takes a few minutes. Log: $log"
if ! { cmake --preset "$preset" && cmake --build "build/$preset" "${targets[@]}"; } >"$log" 2>&1; then
  echo "The build failed; its last lines:" >&2
  tail -n 40 "$log" >&2
  exit 1
fi
