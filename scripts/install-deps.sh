#!/usr/bin/env bash
# Installs what is missing to build EMCA and run its tests on Debian 12 (or a relative with the same package names).
# Asks for nothing and does nothing where all is there. Uses sudo unless run by root.
set -euo pipefail

packages=(
  # tools
  build-essential cmake ninja-build pkg-config git
  # libraries
  flatbuffers-compiler libflatbuffers-dev libasio-dev libzstd-dev libre2-dev zlib1g-dev
  libembree-dev libtbb-dev libpugixml-dev libopenimageio-dev libopenexr-dev libjpeg62-turbo-dev libboost-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev
  # explorer
  qtbase5-dev libqt5svg5-dev libqwt-qt5-dev libvtk9-dev libvtk9-qt-dev fonts-inter
  # Python package
  python3 python3-dev python3-numpy pybind11-dev python3-setuptools python3-wheel python3-pip python3-venv
  # tests and benchmarks
  libgtest-dev libgmock-dev libbenchmark-dev xvfb xauth libgl1-mesa-dri chromium
)

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install-deps.sh: this is no Debian-like system; install what docs/building.md lists, then build with CMake." >&2
  exit 3
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -eq 0 ] && exit 0

run=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps.sh: these packages are missing and only root can install them: ${missing[*]}" >&2
    exit 3
  fi
  run=(sudo)
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${run[@]}" apt-get update -qq
"${run[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
