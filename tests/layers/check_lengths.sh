#!/usr/bin/env bash
# One idea, one file: none longer than the limit.  check_lengths.sh ROOT LIMIT
set -euo pipefail
cd "$1"
found=0 bad=0
while IFS= read -r -d '' file; do
  found=$((found + 1))
  lines=$(wc -l <"$file")
  if [ "$lines" -gt "$2" ]; then
    echo "$file has $lines lines, more than $2"
    bad=1
  fi
done < <(find verdigris apps tests bench scripts cmake \
           \( -name node_modules -o -name dist \) -prune -o -type f \
           \( -name '*.h' -o -name '*.cpp' -o -name '*.ts' -o -name '*.mjs' -o -name '*.sh' \
              -o -name '*.cmake' -o -name '*.css' -o -name '*.html' -o -name 'CMakeLists.txt' \
              -o -name '*.py' \) -print0)
[ "$found" -gt 20 ] || { echo "looked at only $found files: the wrong place"; exit 1; }
exit "$bad"
