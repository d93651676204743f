#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes docs/accuracy.md and its plots: the tables of the validation tests and of the benches, each under the command
# that makes it.
#   workflows/accuracy_report.sh BUILD [BUILD_MIXED]
# BUILD, BUILD_MIXED: build folders of the double and the mixed precision engine with their tests. BENCHES and
# MIXED_BENCHES name the benches to run, or one case of one (bulk:drum-depth). Default: all that need neither catalogue
# nor scans, those of speed apart; in mixed precision those of polyhedra, since spheres are in double in either, and not the settling grains,
# whose reference alone takes 20 minutes.
set -eu

build=${1:?usage: workflows/accuracy_report.sh BUILD [BUILD_MIXED]}
mixed=${2:-}
page=docs/accuracy.md
plots=docs/results/plots
for folder in "$build" ${mixed:+"$mixed"}; do
  [ -x "$folder/bin/talus" ] || { echo "accuracy_report: no $folder/bin/talus; build it first" >&2; exit 2; }
done
: "${BENCHES:=$("$build/bin/talus" bench --list | sed -n '/^levels:/d; /^parts:/d; /^decomposition:/d; /^speed:/d; /^growth:/d; s/^\([a-z_]*\):.*/\1/p')}"
: "${MIXED_BENCHES:=overlap contact laws bulk:throw-depth bulk:throw-volume bulk:drum-depth bulk:drum-volume pile}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# What the validation tests of a build folder print, test by test; a failing test is named.
validation_tables() {
  ctest --test-dir "$1" -L validation --verbose --output-log "$work/log" >/dev/null || true
  echo "    ctest --test-dir $(basename "$1") -L validation --verbose"
  sed -n 's/^[0-9]*: //p' "$work/log" | awk '
    function close_block() { if (open) print "```"; open = 0 }
    /^\[ RUN      \]/ { name = $4; next }
    /^\[|^Running main|^Note: Google Test|^Test command|^Working Directory|^Test timeout|^Environment|^ *[A-Z_]+=|^ *$|^ *[0-9]+ FAILED/ { next }
    name != shown { close_block(); printf "\n**%s**\n\n```text\n", name; shown = name; open = 1 }
    { print }
    END { close_block() }'
  echo
  sed -n '/tests passed/p; /(Failed)/p; /(Timeout)/p' "$work/log"
}

# Tables of the named benches of a build folder; their plots go to a folder below docs/. Cases that have run since the
# benches were built are kept in BUILD/accuracy: what was stopped goes on.
bench_tables() {
  kept=$1/accuracy
  if [ ! -e "$kept/begun" ] || [ "$1/bin/talus-bench" -nt "$kept/begun" ]; then rm -rf "$kept"; fi
  mkdir -p "$kept" "$2"
  [ -e "$kept/begun" ] || touch "$kept/begun"
  for entry in $3; do
    bench=${entry%%:*}
    one=${entry#"$bench"}
    one=${one#:}
    name=$bench${one:+-$one}
    echo "accuracy_report: $(basename "$1"): talus bench $bench $one" >&2
    status=0
    "$1/bin/talus" bench "$bench" ${one:+--case "$one"} --json "$kept/$name.json" --resume >/dev/null || status=$?
    echo
    if [ "$status" -ne 0 ] && [ "$status" -ne 4 ]; then
      echo "**\`talus bench $name\` ended with status $status**"
      continue
    fi
    sed 's/^# /### /' "$kept/$name.md"
    for plot in "$kept/${name}"_*.svg; do
      [ -e "$plot" ] || continue  # no plot for cases that were not run
      cp "$plot" "$2/"
      printf '\n%s\n' "![$(basename "$plot" .svg)](${2#docs/}/$(basename "$plot"))"
    done
  done
}

{
  echo "# Accuracy"
  echo
  echo "Written by \`make accuracy\` on $(date -u +%Y-%m-%d), commit $(git rev-parse --short HEAD)," \
       "$(nproc) cores of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1). A figure of the validation tests" \
       "is the same on every machine; wall times are not."
  echo
  echo "## Validation, double precision"
  echo
  validation_tables "$build"
  if [ -n "$mixed" ]; then
    echo
    echo "## Validation, mixed precision"
    echo
    validation_tables "$mixed"
  fi
  echo
  echo "## Speed against error, double precision"
  bench_tables "$build" "$plots" "$BENCHES"
  if [ -n "$mixed" ]; then
    echo
    echo "## Speed against error, mixed precision"
    bench_tables "$mixed" "$plots/mixed" "$MIXED_BENCHES"
  fi
} >"$work/page"
mv "$work/page" "$page"
echo "wrote $page"
