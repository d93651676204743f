#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Example: SETTLE=100 WINDOW=50 SCENES="box drum" tests/benchmark/peers/compare.sh build
# Runs S1 (box and drum) and S2 in Talus, LIGGGHTS, LAMMPS and YADE, those that are installed, one after the other on one
# thread, and prints the CPU time of a step, its ratio to Talus, and what shows that the work is the same. SETTLE and
# WINDOW: steps of 1e-4 s of S1 before and in each of the three windows; SCENES: some of "box drum s2".
set -euo pipefail

[[ $# -eq 1 && -x $1/bin/time_scene && -x $1/bin/write_particles ]] || {
  echo "compare.sh: usage: compare.sh BUILD_FOLDER with bin/time_scene and bin/write_particles in it" >&2
  exit 2
}
build=$(cd "$1" && pwd)
peers=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive
settle=${SETTLE:-6000} window=${WINDOW:-1000} scenes=" ${SCENES:-box drum s2} "
seconds() { awk -v steps="$1" 'BEGIN { print 1e-4 * steps }'; }

declare -A talus  # CPU time of a step by scene [ms]

# row SCENE CODE MS STATE: a line of the table, with the ratio to Talus.
row() {
  [[ $2 == Talus ]] && talus[$1]=$3
  awk -v scene="$1" -v code="$2" -v ms="$3" -v talus="${talus[$1]}" -v state="$4" \
    'BEGIN { printf "| %s | %s | %.3f | %.2f | %s |\n", scene, code, ms, ms / talus, state }'
}

# Median over three windows of STEPS of the CPU clock's lines in a file [ms a step].
median_step() {
  grep -o 'cpu [0-9.]*' "$1" | awk -v steps="$2" 'NR > 1 { print 1e3 * ($2 - last) / steps } { last = $2 }' | sort -g | sed -n 2p
}

run_talus() { # SCENE NAME [OPTIONS]
  local scene=$1 name=$2
  shift 2
  "$build/bin/time_scene" "$scene" "$@" > talus.txt
  row "$name" Talus "$(sed -n 's/.*each, \([0-9.]*\) ms of processors/\1/p' talus.txt | sort -g | sed -n 2p)" \
    "$(sed -n 's/^time .*bodies, \(.*\), [0-9]* list rebuilds/\1/p' talus.txt)"
}

run_lammps_kin() { # PROGRAM CODE SCENE NAME SUFFIX
  command -v "$1" > /dev/null || { echo "| $4 | $2 | not installed | | |"; return; }
  "$1" -in "$peers/$3.$5" -log none -var particles "$3.data" -var settle "$settle" -var window "$window" \
    -var clock "$peers/cpu_clock.sh" > peer.txt 2>&1 || { tail -5 peer.txt >&2; exit 1; }
  row "$4" "$2" "$(median_step peer.txt "$window")" \
    "$(awk '$2 == 10000 && NF == 4 { height = $3; touching = $4 } END { print touching " bodies touch one, mean height " height " m" }' peer.txt)"
}

run_yade() { # SCRIPT NAME PARTICLES SETTLE WINDOW
  command -v yade > /dev/null || { echo "| $2 | YADE | not installed | | |"; return; }
  yade -j1 -n -x "$peers/$1" "$3" "$4" "$5" > peer.txt 2>&1 || { tail -5 peer.txt >&2; exit 1; }
  row "$2" YADE "$(median_step peer.txt "$5")" "$(sed -n 's/^step [0-9]*, //p' peer.txt)"
}

echo "| scene | code | CPU ms a step | over Talus | at the end |"
echo "|---|---|---:|---:|---|"
for form in box drum; do
  [[ $scenes == *" $form "* ]] || continue
  "$build/bin/write_particles" "s1-$form" lammps > "s1_$form.data"
  run_talus "s1-$form" "S1 $form" --settle "$(seconds "$settle")" --window "$(seconds "$window")"
  run_lammps_kin liggghts LIGGGHTS "s1_$form" "S1 $form" liggghts
  run_lammps_kin lmp LAMMPS "s1_$form" "S1 $form" lammps
done
if [[ $scenes == *" box "* ]]; then # in shorter windows: YADE takes ten times as long
  "$build/bin/write_particles" s1-box table > s1_box.txt
  run_yade s1_box.yade.py "S1 box" s1_box.txt "$settle" $((window / 10))
fi
if [[ $scenes == *" s2 "* ]]; then # both from where Talus has settled it
  "$build/bin/write_particles" s2 table settled > s2.txt
  run_talus s2 S2 --law volume --settled --window 0.012
  run_yade s2.yade.py S2 s2.txt 3 3
fi
