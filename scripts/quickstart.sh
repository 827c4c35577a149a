#!/usr/bin/env bash
# From a fresh Debian 12 machine to aged copper in one command:
#   scripts/quickstart.sh RECORDING [OUT]
# RECORDING is a video or a folder of photographs from a fixed camera. Run it again at no cost:
# what is installed and built is kept.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  echo "usage: scripts/quickstart.sh RECORDING [OUT]" >&2
  echo "RECORDING is a video, or a folder of photographs, of copper in front of a fixed camera." >&2
  exit 2
fi
if [ ! -e "$1" ]; then
  echo "quickstart: $1: no such file or folder" >&2
  exit 3
fi
"$root/scripts/install_packages.sh" build viewer
"$root/scripts/build.sh" release verdigris_cli
name=$(basename "$1")
out=${2:-$root/out/${name%.*}}
mkdir -p "$(dirname "$out")"
echo
"$root/build/release/verdigris" age "$1" -o "$out"
echo
echo "The program is $root/build/release/verdigris (try: verdigris --help)"
