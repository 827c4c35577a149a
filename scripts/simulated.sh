# For other scripts, to be sourced: simulated recordings with other numbers in their specification.
# made FILE PRESET SEED SIZE SECTION.KEY=VALUE...: FILE, unless it is there. $verdigris is the program.
made() {
  local file=$1 preset=$2 seed=$3 size=$4 setting section key
  shift 4
  [ -e "$file" ] && return
  local spec=${file%.*}.toml draft
  draft=$(dirname "$file")/.draft
  "$verdigris" simulate --preset "$preset" --seed "$seed" --size "$size" -o "$draft.mkv" --frames 20 --quiet --force
  cp "$draft.spec.toml" "$spec"
  rm -f "$draft".*
  for setting in frames.count=984 frames.units=98.4 "$@"; do
    section=${setting%%.*} key=${setting%%=*}
    key=${key#*.}
    sed -i "/^\[$section\]/,/^$/ s|^$key = [^#]*|$key = ${setting#*=} |" "$spec"
    grep -q "^$key = ${setting#*=} " "$spec" || { echo "no $key in a specification" >&2; exit 1; }
  done
  "$verdigris" simulate --spec "$spec" -o "$file" --quiet
}
