#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Called by conda build with its environment.
set -euo pipefail
# shellcheck disable=SC2086,SC2154 # CMAKE_ARGS is a list of words; conda sets SRC_DIR, PREFIX and CXX
cmake -S "$SRC_DIR" -B build-conda -G Ninja ${CMAKE_ARGS:-} "-DCMAKE_CXX_COMPILER=$CXX" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" -DVOUSSOIR_UNITY=ON \
  -DVOUSSOIR_WITH_MPI=OFF -DVOUSSOIR_WITH_ARPACK=OFF -DVOUSSOIR_WITH_TRILINOS=OFF -DVOUSSOIR_WITH_FCLIB=OFF
cmake --build build-conda --target voussoir
cmake --install build-conda --component program
