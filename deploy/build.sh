#!/usr/bin/env bash
# Configures and builds a preset of CMakePresets.json into build/PRESET.
#   deploy/build.sh [PRESET [TARGET...]]      RADFARM_JOBS=N bounds the compilers at work, by default one a core
set -euo pipefail
cd "$(dirname "$0")/.."

preset="${1:-release}"
shift || true

# The presets name ccache; mold is found by common/module.cmake.
options=()
command -v ccache >/dev/null || options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=)
cmake --preset "$preset" "${options[@]}"

targets=()
[[ $# -eq 0 ]] || targets=(--target "$@")
cmake --build --preset "$preset" -j "${RADFARM_JOBS:-$(nproc)}" "${targets[@]}"
