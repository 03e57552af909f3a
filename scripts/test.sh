#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, checks the form of sources and scripts, builds the sources' documentation (doc) and everything else with warnings as
# errors, and runs the tests; then the quick ones again with the assertions of deal.II and of the C++ library (build-debug). What was skipped is listed at the end.
# Usage: scripts/test.sh [arguments for ctest, such as -R waves, or -L with exact, mesh, motion or program: then these tests only]
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
export VOUSSOIR_UNITY=ON # a new build directory: compile sources in groups

form() # format of the sources, checks of scripts and prose, mutants that fit
{
  cd "$root"
  mapfile -t sources < <(git ls-files '*.cc' '*.h')
  if [[ "$(clang-format --version)" == *" version 14."* ]]; then
    clang-format --dry-run -Werror "${sources[@]}"
  else
    echo "test: this is not clang-format 14: the form of the sources was not checked" >&2
  fi
  scripts/check_rooms.sh
  scripts/check_tree.py
  shellcheck scripts/*.sh .ci/run
  flake8 python scripts benchmarks meshes
  scripts/mutants.py --check
  scripts/check_prose.py --strings --total 2
}

# run_tests DIRECTORY [ARGUMENTS...]: of ctest; its output also goes to a file, which says what was skipped.
run_tests()
{
  local directory=$1
  shift
  (cd "$directory" && ctest --output-on-failure --no-tests=error -j2 "$@") | tee "$directory/tests.log"
}

skipped() # DIRECTORY...
{
  local directory
  for directory in "$@"; do
    if [[ -f "$directory/tests.log" ]]; then
      echo "Skipped in $directory: $(grep -c '\*\*\*Skipped' "$directory/tests.log" || true)"
      grep '\*\*\*Skipped' "$directory/tests.log" || true
    fi
  done
}

"$root/scripts/setup.sh"
form
"$root/scripts/build.sh" --target doc -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "${all_parts[@]}" # a warning of Doxygen is an error
"$root/scripts/build.sh" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "${all_parts[@]}"
if (($#)); then
  run_tests "$root/build" "$@"
  skipped "$root/build"
  exit 0
fi
run_tests "$root/build"
"$root/scripts/build.sh" --directory "$root/build-debug" --target quick -DCMAKE_BUILD_TYPE=Debug -DVOUSSOIR_DEBUG_INFO=OFF -DCMAKE_COMPILE_WARNING_AS_ERROR=ON \
  "${all_parts[@]}"
run_tests "$root/build-debug" -L quick
skipped "$root/build" "$root/build-debug"
