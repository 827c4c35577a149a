#!/usr/bin/env bash
# Every [Key1999] or [Name] cited in a comment or a document is listed in REFERENCES.md, and every
# listed key is cited somewhere.  check_references.sh ROOT REFERENCES.md
set -euo pipefail
root=$1 list=$2
listed=$(grep -oE '^\* \[[A-Za-z0-9_-]+\]' "$list" | tr -d '*[] ' | sort -u || true)
# A key starts with a capital and has at least two letters before anything else: [Paper],
# [Sharma2005], [BT709]. Code subscripts are lower-case, attributes are [[..]], links are [..](..).
cited=$(find "$root" \( -name node_modules -o -name build -o -name dist -o -name planted -o -name out \) \
          -not -path "$root" -prune -o -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.ts' -o -path '*/docs/models/*.md' \) -print0 |
        xargs -0 -r grep -ohE '(^|[^]A-Za-z0-9_)\[])\[[A-Z][A-Za-z][A-Za-z0-9-]*(,[^]]*)?\]($|[^(\[])' |
        grep -oE '\[[A-Z][A-Za-z0-9-]+' | tr -d '[' | sort -u || true)
bad=0
[ -n "$cited" ] || { echo "no citation found at all: the check looked in the wrong place"; exit 1; }
for key in $cited; do
  grep -qx "$key" <<<"$listed" || { echo "[$key] is cited but not listed in $list"; bad=1; }
done
for key in $listed; do
  grep -qx "$key" <<<"$cited" || { echo "[$key] is listed in $list but cited nowhere"; bad=1; }
done
exit "$bad"
