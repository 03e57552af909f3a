#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Configures and builds Voussoir in build/ (Release), file by file; the program is build/voussoir.
# With VOUSSOIR_UNITY=ON in the environment a new build directory compiles sources in groups: faster from scratch.
# Usage: scripts/build.sh [--configure-only] [--directory DIR] [--target NAME] [more arguments for cmake, such as
#        -DCMAKE_BUILD_TYPE=Debug]
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

directory="$root/build"
target=all
build=true
arguments=()
while (($#)); do
  case "$1" in
    --configure-only) build=false ;;
    --directory) directory=$2; shift ;;
    --target) target=$2; shift ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

options=()
# An existing build directory keeps its generator, its type and its way of compiling.
if [[ ! -f "$directory/CMakeCache.txt" ]]; then
  options+=(-G Ninja -DCMAKE_BUILD_TYPE=Release "-DVOUSSOIR_UNITY=${VOUSSOIR_UNITY:-OFF}")
fi
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi

cmake -S "$root" -B "$directory" "${options[@]}" "${arguments[@]}"
if [[ "$build" == true ]]; then
  cmake --build "$directory" --parallel "$(env -u OMP_NUM_THREADS nproc)" --target "$target"
fi
