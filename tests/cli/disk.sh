#!/usr/bin/env bash
# A read-only folder, a full disk, a file-size limit.
source "$(dirname "$0")/lib.sh"
"$fixture" plate "$scratch/plate" 16 128

# Every file the run writes is cut at 4 blocks: the first larger one fails.
(
  ulimit -f 4
  trap '' XFSZ
  expect 1 "disk is full|too large|limit" "$verdigris" age "$scratch/plate" -o "$scratch/limited"
  [ "$failures" -eq 0 ]
) || fail "file-size limit"
expect_nothing "$scratch/limited"

ran=
if [ "$(id -u)" -ne 0 ]; then
  mkdir "$scratch/locked" && chmod 555 "$scratch/locked"
  expect 1 "permission|denied|read-only" "$verdigris" age "$scratch/plate" -o "$scratch/locked/out"
  ran=1
else
  # root ignores permissions: use real mounts where the machine allows them.
  mkdir "$scratch/small" "$scratch/readonly"
  if mount -t tmpfs -o size=256k tmpfs "$scratch/small" 2>/dev/null; then
    expect 1 "disk is full" "$verdigris" age "$scratch/plate" -o "$scratch/small/out"
    expect_nothing "$scratch/small/out"
    umount "$scratch/small"
    mount -t tmpfs -o ro tmpfs "$scratch/readonly"
    expect 1 "read-only" "$verdigris" age "$scratch/plate" -o "$scratch/readonly/out"
    umount "$scratch/readonly"
    ran=1
  fi
fi
[ -n "$ran" ] || echo "note: root without mount rights: only the file-size limit was tested"
touch "$scratch/a_file"
expect 1 "file, not a folder" "$verdigris" age "$scratch/plate" -o "$scratch/a_file"
finish
