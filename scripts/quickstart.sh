#!/usr/bin/env bash
# From a fresh Debian 12 machine to aged copper in one command:
#   scripts/quickstart.sh RECORDING [OUT]
#   scripts/quickstart.sh
# RECORDING is a video or a folder of photographs from a fixed camera; without one, a specimen is
# simulated first. Run it again at no cost: what is installed, built and simulated is kept.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
if [ $# -gt 2 ] || [ "${1:-}" = -h ] || [ "${1:-}" = --help ]; then
  echo "usage: scripts/quickstart.sh [RECORDING [OUT]]" >&2
  echo "RECORDING is a video, or a folder of photographs, of copper in front of a fixed camera;" >&2
  echo "without one, a made specimen is aged." >&2
  exit 2
fi
if [ $# -gt 0 ] && [ ! -e "$1" ]; then
  echo "quickstart: $1: no such file or folder" >&2
  exit 3
fi
"$root/scripts/install_packages.sh" build viewer report
"$root/scripts/build.sh" release verdigris_cli
verdigris="$root/build/release/bin/verdigris"
recording=${1:-$root/out/simulated.mp4}
name=$(basename "$recording")
out=${2:-$root/out/${name%.*}}
mkdir -p "$(dirname "$out")"
echo
if [ $# -eq 0 ] && [ ! -e "$recording" ]; then
  echo "No recording given: simulating a piece of copper (synthetic; about a quarter of a minute)."
  "$verdigris" simulate --preset spotted --seed 7 -o "$recording" --truth "$root/out/simulated-truth"
  echo
fi
"$verdigris" age "$recording" -o "$out"
echo
echo "The program is $verdigris. To type verdigris alone:"
echo "  export PATH=\"$root/build/release/bin:\$PATH\"; verdigris --help"
