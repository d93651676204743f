#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Example: workflows/install_dependencies.sh
# Installs the Debian 12 packages that Talus is built with; only those that are missing, so that a second run needs
# neither network nor root. With --engine only what dem_gpu and talus-simulate need.
set -euo pipefail

engine_packages=(
  g++ cmake ninja-build make ccache git ca-certificates
  libsqlite3-dev zlib1g-dev libgtest-dev libtbb-dev libthrust-dev libhdf5-dev libtomlplusplus-dev
  nlohmann-json3-dev libcli11-dev valgrind
)
other_packages=(
  libpcl-dev libcgal-dev libeigen3-dev libassimp-dev libtiff-dev libvtk9-dev libopencv-dev
  xvfb xauth clang-format file
)

fail() {
  echo "install_dependencies: $1" >&2
  exit 1
}

packages=("${engine_packages[@]}" "${other_packages[@]}")
case "${1:-}" in
  "") ;;
  --engine) packages=("${engine_packages[@]}") ;;
  -h | --help)
    sed -n '3,5s/^# //p' "$0"
    exit 0
    ;;
  *)
    echo "install_dependencies: usage: unknown option $1; known: --engine, --help" >&2
    exit 2
    ;;
esac
[[ $# -le 1 ]] || { echo "install_dependencies: usage: at most one option" >&2; exit 2; }

command -v dpkg-query > /dev/null || fail "needs Debian 12 or one of its kin (no dpkg-query here); the lists in this script name the packages to install by hand"

missing=()
for package in "${packages[@]}"; do
  # One line for each architecture the package is known for; one that is installed is enough.
  state=$(dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2> /dev/null | sort -u | grep -x installed || true)
  [[ $state == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "install_dependencies: all ${#packages[@]} packages are there" >&2
  exit 0
fi
echo "install_dependencies: installing ${missing[*]}" >&2

as_root=()
if [[ $EUID -ne 0 ]]; then
  command -v sudo > /dev/null || fail "needs root or sudo; ask an administrator to run: apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q)
"${apt[@]}" update >&2 || fail "apt-get update failed; check the network and /etc/apt/sources.list, then run again"
"${apt[@]}" install --no-install-recommends "${missing[@]}" >&2 ||
  fail "apt-get could not install ${missing[*]}; its message stands above; mend that, then run again"
echo "install_dependencies: done" >&2
