#!/usr/bin/env bash
# What `auto` says on the real recordings, as a table for docs/RESULTS.md:
#   scripts/real_results.sh FOLDER_OF_RECORDINGS
set -euo pipefail
cd "$(dirname "$0")/.."
verdigris=${VERDIGRIS:-build/release/bin/verdigris}
[ -x "$verdigris" ] || scripts/build.sh release
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo "| recording | context | what it said of itself |"
echo "|---|---|---|"
for recording in "$1"/*/; do
  name=$(basename "$recording")
  for context in 5 10 20 30; do
    said=$("$verdigris" age "$recording" -o "$scratch/$name" --context "$context" --json 2>/dev/null |
      sed -n 's/^  "explanation": "\(.*\)",\{0,1\}$/\1/p')
    echo "| $name | $context | $said |"
  done
done
