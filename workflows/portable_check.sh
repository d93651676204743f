#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Example: workflows/portable_check.sh build-dem-portable
# Runs the same mill of cubes with the engine of each level of x86-64 that this machine has: each must be the one that
# the loader took, and the cubes must lie alike.
set -euo pipefail
[[ $# -eq 1 ]] || { echo "portable_check: usage: portable_check.sh BUILD_FOLDER" >&2; exit 2; }
program=$1/bin/time_scene
[[ -x $program ]] || { echo "portable_check: $program is not there; make portable builds it" >&2; exit 2; }
loader=$(ldd "$program" | sed -n 's|^[[:space:]]*\(/[^ ]*ld-linux[^ ]*\).*|\1|p')
levels=$("$loader" --help)
export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive

height_of_plain=
for level in x86-64 x86-64-v3 x86-64-v4; do
  if [[ $level != x86-64 ]] && ! grep -q "$level (supported" <<< "$levels"; then
    echo "$level: not on this machine"
    continue
  fi
  # A mask that no folder has leaves the plain library.
  mask=$level
  [[ $level == x86-64 ]] && mask=none
  library=$("$loader" --glibc-hwcaps-mask "$mask" --list "$program" | sed -n 's/.*libdem_engine.so => \([^ ]*\).*/\1/p')
  case $level in
    x86-64) [[ $library != *glibc-hwcaps* ]] ;;
    *) [[ $library == */glibc-hwcaps/$level/* ]] ;;
  esac || { echo "portable_check: $level: the loader takes $library" >&2; exit 1; }
  said=$("$loader" --glibc-hwcaps-mask "$mask" "$program" s4 --bodies 200 --settle 0.1 --window 0.02 --windows 1)
  time=$(sed -n 's/.* steps, \([0-9.]*\) ms each, .*/\1/p' <<< "$said" | tail -1)
  height=$(sed -n 's/.*mean height \(-\{0,1\}[0-9.]*\) m.*/\1/p' <<< "$said")
  echo "$level: $time ms a step, mean height $height m"
  [[ -n $height_of_plain ]] || height_of_plain=$height
  awk -v a="$height" -v b="$height_of_plain" 'BEGIN { exit !(a != 0 && (a / b - 1) ^ 2 < 1e-6) }' ||
    { echo "portable_check: $level: the cubes lie otherwise" >&2; exit 1; }
done
