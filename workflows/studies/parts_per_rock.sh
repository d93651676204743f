#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# How many parts does a rock need? Decomposes one scan at every level of detail, pours, tilts and empties the same bed of
# 300 such rocks at each, and writes a page with the table and the plots. Called by `make study`; what was stopped goes on.
#   SCAN   the scan, a closed mesh or a cloud           (needed)
#   UNIT   its length unit                              (needed)
#   BUILD  build folder with the executables            (build)
#   STUDY  folder for catalogue and figures             (study/ and the scan's name)
#   PAGE   page to write; its plots go beside it        (STUDY/parts_per_rock.md)
set -eu

: "${SCAN:?make study SCAN=rock.stl UNIT=mm: no SCAN given}"
: "${UNIT:?make study SCAN=$SCAN UNIT=mm: no UNIT given}" "${BUILD:=build}"
: "${STUDY:=study/$(basename "${SCAN%.*}")}"
: "${PAGE:=$STUDY/parts_per_rock.md}"
talus=$BUILD/bin/talus
parts=1,2,4,8,16,32
caps=16,32

mkdir -p "$STUDY" "$(dirname "$PAGE")/plots"
status=0
"$talus" digitize "$SCAN" --into "$STUDY/rock.talus" --unit "$UNIT" >&2 || status=$?
# 4: stored, with a check that did not pass, which digitize has named.
if [ "$status" -ne 0 ] && [ "$status" -ne 4 ]; then exit "$status"; fi
"$talus" decompose "$STUDY/rock.talus" --parts "$parts" --vertices "$caps" >&2
status=0
"$talus" bench parts --catalog "$STUDY/rock.talus" --threads 1 --json "$STUDY/parts.json" --resume >/dev/null || status=$?
if [ "$status" -ne 0 ] && [ "$status" -ne 4 ]; then exit "$status"; fi

# One row a level out of the bench's one row a figure.
level_table() {
  awk -F ' *[|] *' '
    $3 ~ /^[0-9]+ parts: / {
      split($3, words, ": ")
      cap = $2; sub(/.*-/, "", cap)
      level = words[1] " x " cap; sub(/ parts/, "", level)
      if (!(level in known)) { known[level] = 1; levels[++count] = level }
      if (!(words[2] in column)) { column[words[2]] = ++columns; heading[columns] = words[2] }
      value[level, column[words[2]]] = $4
    }
    END {
      line = "| parts x vertices |"; rule = "|---|"
      for (c = 1; c <= columns; ++c) { line = line " " heading[c] " |"; rule = rule "---:|" }
      print line; print rule
      for (l = 1; l <= count; ++l) {
        line = "| " levels[l] " |"
        for (c = 1; c <= columns; ++c) line = line " " value[levels[l], c] " |"
        print line
      }
    }' "$1"
}

spread_table() {
  printf '| answer | mean | standard deviation |\n|---|---:|---:|\n'
  awk -F ' *[|] *' '
    $3 ~ /^mean of / { name = substr($3, 9); mean[name] = $4; order[++count] = name }
    $3 ~ /^standard deviation of / { deviation[substr($3, 23)] = $4 }
    END { for (i = 1; i <= count; ++i) print "| " order[i] " | " mean[order[i]] " | " deviation[order[i]] " |" }' "$1"
}

{
  echo "# How many parts does a rock need?"
  echo
  echo "Written by \`make study SCAN=$(basename "$SCAN") UNIT=$UNIT\` on $(date -u +%Y-%m-%d), commit $(git rev-parse --short HEAD)," \
       "one thread of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)."
  echo
  echo "The same 300 rocks at every level of detail, in the same places and attitudes: poured into a box of 10 x 6" \
       "diameters, the box tilted until they slide (0.2 diameters on the mean), and, from the bed at rest, emptied" \
       "through half of its floor. Friction 0.5, restitution 0.3, default law, preset draft;" \
       "\`workflows/bench/parts/rock_bed.h\` has the rest. The packing fraction is over the floor and twice the height of" \
       "the common centre."
  echo
  level_table "$STUDY/parts.md"
  echo
  echo "Chance: other places and attitudes of the rocks, three beds at the cheapest level. A difference between two" \
       "levels of less than about three standard deviations says nothing about the levels."
  echo
  spread_table "$STUDY/parts.md"
  for plot in packing angle emptying left cost; do
    cp "$STUDY/parts_$plot.svg" "$(dirname "$PAGE")/plots/"
    printf '\n![%s](plots/parts_%s.svg)\n' "$plot" "$plot"
  done
} >"$PAGE.next"
mv "$PAGE.next" "$PAGE"
echo "wrote $PAGE"
