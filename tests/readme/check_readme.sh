#!/usr/bin/env bash
# The README promises what the program does: every command and option it shows exists, every
# subcommand is shown, every link leads somewhere.  check_readme.sh ROOT PROGRAM
set -euo pipefail
root=$1 verdigris=$2
bad=0
complain() { echo "$*"; bad=1; }

commands=$(grep -oE '^verdigris [a-z-]+' "$root/README.md" | awk '{print $2}' | sort -u)
[ "$(wc -w <<<"$commands")" -ge 8 ] || complain "found only these commands in the README: $commands"
for command in $commands; do
  "$verdigris" "$command" --help >/dev/null 2>&1 || complain "README shows '$command', which the program lacks"
done
for command in $("$verdigris" --help | sed -n '/^Subcommands/,/^[A-Z]/p' | awk '/^  [a-z]/ {print $1}'); do
  grep -qx "$command" <<<"$commands" || complain "the program has '$command', which the README does not show"
done
help=$("$verdigris" age --help)
for option in $(grep -A2 '^verdigris age' "$root/README.md" | grep -oE -- '--[a-z-]+' | sort -u); do
  grep -q -- "$option" <<<"$help" || complain "README shows $option, which 'age' lacks"
done
while IFS= read -r file; do
  folder=$(dirname "$file")
  for link in $(grep -oE '\]\([^)# ]+' "$file" | sed 's/^](//' | grep -v '^http' || true); do
    [ -e "$folder/$link" ] || complain "${file#"$root"/} links to $link, which is not there"
  done
done < <(find "$root" -maxdepth 1 -name '*.md'; find "$root/docs" -name '*.md')
for script in quickstart test; do
  [ -x "$root/scripts/$script.sh" ] || complain "scripts/$script.sh is not executable"
done
exit "$bad"
