#!/usr/bin/env bash
# Configures and builds Voussoir (Release) in build/; the program is build/voussoir.
# Usage: scripts/build.sh [more arguments for cmake, such as -DCMAKE_BUILD_TYPE=Debug]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

options=(-DCMAKE_BUILD_TYPE=Release)
# An existing build directory keeps the generator it was configured with.
if [[ ! -f "$root/build/CMakeCache.txt" ]]; then
  options+=(-G Ninja)
fi
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi

cmake -S "$root" -B "$root/build" "${options[@]}" "$@"
cmake --build "$root/build" --parallel "$(nproc)"
