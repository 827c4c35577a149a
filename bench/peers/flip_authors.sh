#!/usr/bin/env bash
# FLIP against its authors' C++ code (a checkout of github.com/NVlabs/flip), as their build compiles
# it, on a pair of 8-bit pictures:
#   bench/peers/flip_authors.sh FLIP_CHECKOUT A.png B.png [BUILD=build/ci] [ROUNDS=5] [THREADS=2]
set -euo pipefail
theirs=$1 a=$2 b=$3 build=${4:-build/ci} rounds=${5:-5} threads=${6:-2}
here=$(cd "$(dirname "$0")/../.." && pwd)
program=$(mktemp)
trap 'rm -f "$program"' EXIT
rooms=()
for room in metrics files color pixels; do rooms+=("$build/verdigris/$room/libverdigris_$room.a"); done
c++ -std=c++20 -w -O3 -DNDEBUG -fopenmp -I"$here" -I"$theirs/src/cpp" "$here/bench/peers/flip_authors.cpp" \
  "${rooms[@]}" -lpng -ldeflate -ljpeg -ltiff -llcms2 -lexif -lcrypto $(pkg-config --libs OpenEXR) -lz -lfmt \
  -ltbb -lhwy -lopencv_imgproc -lopencv_core -o "$program"
GOMP_SPINCOUNT=0 "$program" "$a" "$b" "$rounds" "$threads"
