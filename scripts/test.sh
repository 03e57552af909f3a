#!/usr/bin/env bash
# Sets up, builds everything (tests too: compiling must not count towards their time limit), runs the tests.
# Usage: scripts/test.sh [more arguments for ctest, such as -R joint]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

"$root/scripts/setup.sh"
"$root/scripts/build.sh"
cd "$root/build"

# deal.II keeps the executables of the tests out of "all": <folder>.<test>.release
mapfile -t executables < <(cmake --build . --target help |
  sed -nE 's/^(\.\.\. )?([A-Za-z0-9_-]+\.[A-Za-z0-9_-]+\.(release|debug))(: phony)?$/\2/p')
if ((${#executables[@]})); then
  cmake --build . --parallel "$(nproc)" --target "${executables[@]}"
fi

ctest --output-on-failure -j2 "$@"
