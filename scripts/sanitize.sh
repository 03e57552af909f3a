#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The quick tests with AddressSanitizer and UndefinedBehaviorSanitizer, in build-sanitize. A part of .ci/run --full.
# Usage: scripts/sanitize.sh [arguments for ctest instead of -L quick]
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

"$root/scripts/setup.sh"
"$root/scripts/build.sh" --directory "$root/build-sanitize" -DVOUSSOIR_SANITIZE=ON
# MPI, HDF5 and gmsh keep what they have until the end; containers of libraries that are not instrumented look odd.
export ASAN_OPTIONS=detect_container_overflow=0:${ASAN_OPTIONS:-}
export LSAN_OPTIONS=suppressions=$root/scripts/leaks_of_others.txt:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
export OMP_NUM_THREADS=1
cd "$root/build-sanitize"
if (($# == 0)); then
  set -- -L quick
fi
ctest --output-on-failure --no-tests=error --timeout 1200 -j2 "$@"
