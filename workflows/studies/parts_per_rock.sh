#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# How many parts does a rock need? Decomposes one scan at every level of detail, pours, tilts and empties the same bed of
# 300 such rocks at each, and writes a page with the table and the plots. Called by `make study`; what was stopped goes on.
#   SCAN   the scan, a closed mesh or a cloud           (needed)
#   UNIT   its length unit                              (needed)
#   BUILD  build folder with the executables            (build)
#   STUDY  folder for catalogue and figures             (study/ and the scan's name)
#   OUT    folder for the page and its plots            (STUDY)
set -eu

: "${SCAN:?make study SCAN=rock.stl UNIT=mm: no SCAN given}"
: "${UNIT:?make study SCAN=$SCAN UNIT=mm: no UNIT given}" "${BUILD:=build}"
: "${STUDY:=study/$(basename "${SCAN%.*}")}"
: "${OUT:=$STUDY}"
talus=$BUILD/bin/talus
parts=1,2,4,8,16,32
caps=16,32,64

# Status 4: a check did not pass. The scan's are in the listing, a bed that failed is in the page.
go_on() {
  status=0
  "$@" || status=$?
  if [ "$status" -ne 0 ] && [ "$status" -ne 4 ]; then exit "$status"; fi
}

mkdir -p "$STUDY" "$OUT"
go_on "$talus" digitize "$SCAN" --into "$STUDY/rock.talus" --unit "$UNIT" >&2
go_on "$talus" decompose "$STUDY/rock.talus" --parts "$parts" --vertices "$caps" >&2
go_on "$talus" bench parts --catalog "$STUDY/rock.talus" --threads 1 --json "$STUDY/parts_per_rock.json" --out "$OUT" \
  --resume >/dev/null
echo "wrote $OUT/parts_per_rock.md"
