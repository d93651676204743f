#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# kernel_report.sh LOG: registers, stack and spills of each of the engine's kernels as a table in Markdown, from what a
# build with -Xptxas -v printed. Thrust's own kernels (sorts, scans) are left out.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: kernel_report.sh LOG" >&2; exit 2; }
printf '| kernel | registers | stack [bytes] | spill stores [bytes] | spill loads [bytes] |\n|---|---:|---:|---:|---:|\n'
c++filt < "$1" | awk '
  # The functor that the launch works off: the argument of the template run_kernel.
  function short_name(text) {
    if (!match(text, /run_kernel</)) return ""
    text = substr(text, RSTART + RLENGTH)
    sub(/ ?>\(.*/, "", text)
    gsub(/dem_gpu::/, "", text)
    gsub(/\(anonymous namespace\)::/, "", text)
    gsub(/ >/, ">", text)
    gsub(/\|/, "\\|", text)
    return text
  }
  /Compiling entry function/ { name = short_name($0) }
  /bytes stack frame/ { stack = $1; stores = $5; loads = $9 }
  /Used [0-9]+ registers/ {
    match($0, /Used [0-9]+/)
    if (name != "") print "| `" name "` | " substr($0, RSTART + 5, RLENGTH - 5) " | " stack " | " stores " | " loads " |"
    name = ""
  }' | sort -u
