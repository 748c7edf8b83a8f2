#!/usr/bin/env bash
# From a bare Debian 12 to a rendered image: installs, builds, renders SCENE into out/NAME.exr and out/NAME.png.
#   deploy/quickstart.sh [SCENE [RENDER OPTION...]]      by default the room of the tests
set -euo pipefail
cd "$(dirname "$0")/.."

scene="${1:-tests/scenes/room.gltf}"
shift || true

deploy/install_packages.sh
deploy/build.sh release

name="$(basename "${scene%.*}")"
mkdir -p out
build/release/bin/radfarm render "$scene" -o "out/$name.exr" --png "out/$name.png" "$@"
echo "rendered out/$name.exr and out/$name.png"
