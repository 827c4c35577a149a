#!/usr/bin/env bash
# Installs what is missing of the named sections of packages.txt:  install_packages.sh build viewer
# Says what it is about to install; does nothing, quickly, when nothing is missing.
set -euo pipefail
cd "$(dirname "$0")"

section() { sed -n "/^\[$1\]/,/^\[/p" packages.txt | grep -vE '^\[|^#|^$' || true; }

# Node may come from elsewhere (a newer one than Debian's 18): then Debian's must not be forced on.
have_node() {
  command -v npm >/dev/null && command -v node >/dev/null &&
    [ "$(node -p 'process.versions.node.split(".")[0]')" -ge 18 ]
}

wanted=()
for name in "$@"; do
  if [ "$name" = viewer ] && have_node; then continue; fi
  for package in $(section "$name"); do wanted+=("$package"); done
done
missing=()
for package in "${wanted[@]}"; do
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
    missing+=("$package")
done
[ "${#missing[@]}" -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing, and installing them needs root or sudo:"
    printf '  %s\n' "${missing[@]}"
    exit 1
  } >&2
  as_root=(sudo)
fi
echo "Installing with apt: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
