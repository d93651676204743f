#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From scans to a discharging hopper and a turning mill, each with a report. Called by `make demo`; run again, it only does
# what is new.
#   BUILD  build folder with the executables        (build)
#   SCANS  folder with your own scans                (Debian's libcgal-demo and four virtual scans)
#   UNIT   their length unit, needed with SCANS      (m)
#   DEMO   where everything goes                     (demo, or demo-NAME for SCANS=.../NAME)
set -euo pipefail
cd "$(dirname "$0")/.."
repository=$PWD
talus=$repository/${BUILD:-build}/bin/talus
scans=${SCANS:-}
demo=${DEMO:-demo${scans:+-$(basename "$scans")}}

say() { printf '\n== %s\n' "$*"; }

# A batch ends with status 3 for a bad scan in it, with 4 for a shape with a check that did not pass, and goes on past
# either; anything else is the end.
allow_flaws() {
  local status=0
  "$@" || status=$?
  case $status in 0|3|4) ;; *) exit "$status" ;; esac
}

# Scanned clouds and meshes out of Debian's libcgal-demo, unpacked beside the build; nothing is installed for it.
fetch_scans() {
  if [ -f "$demo/scans/kitten.xyz" ]; then return 0; fi
  mkdir -p "$demo/download"
  (cd "$demo/download" && apt-get download -qq libcgal-demo 2>/dev/null) || return 1
  dpkg-deb -x "$demo"/download/libcgal-demo_*.deb "$demo/download/package"
  tar -C "$demo/download" -xzf "$demo/download/package/usr/share/doc/libcgal-dev/data.tar.gz"
  mkdir -p "$demo/scans.part"
  local data=$demo/download/data
  cp "$data/points_3/kitten.xyz" "$data/points_3/oni.ply" "$data/meshes/blobby.off" "$data/meshes/bear.off" "$demo/scans.part/"
  mv "$demo/scans.part" "$demo/scans"
  rm -rf "$demo/download"
}

digitize() {
  if [ -n "$scans" ]; then
    if [ -z "${UNIT:-}" ]; then
      echo "demo: SCANS=$scans needs its length unit: make demo SCANS=$scans UNIT=mm" >&2
      exit 2
    fi
    allow_flaws "$talus" digitize "$scans" --into "$demo/demo.talus" --unit "$UNIT"
    return
  fi
  if fetch_scans; then
    allow_flaws "$talus" digitize "$demo/scans" --into "$demo/demo.talus" --unit m --size '30 mm'
  else
    echo 'demo: libcgal-demo cannot be fetched (apt-get download); going on with virtual scans alone' >&2
  fi
  if [ ! -f "$demo/virtual/truth.json" ]; then
    "$talus" digitize --make-virtual-scans "$demo/virtual" --count 4 --seed 1
  fi
  allow_flaws "$talus" digitize "$demo/virtual" --into "$demo/demo.talus" --unit m --truth "$demo/virtual/truth.json"
}

simulate() {
  local run=$demo/runs/$1
  cp "workflows/scenes/$1.toml" "$demo/$1.toml"
  if [ -f "$run/run.json" ] && grep -q '"finished": true' "$run/run.json"; then
    echo "$run is there already; remove it to run it again"
  elif [ -f "$run/checkpoint.h5" ]; then
    "$talus" simulate --resume "$run"
  else
    rm -rf "$run"
    "$talus" simulate "$demo/$1.toml" --out "$run"
  fi
  "$talus" post "$run"
}

mkdir -p "$demo/runs"
say 'Digitise: scans to watertight meshes'
digitize
say 'Decompose: meshes to convex parts, 1 to 8 a grain'
allow_flaws "$talus" decompose "$demo/demo.talus" --parts 1,2,4,8 --vertices 16
say 'Catalogue'
"$talus" catalog list "$demo/demo.talus"
say 'Hopper: fill, settle, open the gate, discharge'
simulate hopper
say 'Mill: grains and steel balls, more than one turn'
simulate mill
say 'Done. Open the reports in a browser, the .pvd files in ParaView:'
for run in hopper mill; do
  echo "  $repository/$demo/runs/$run/report.html"
done
