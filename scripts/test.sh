#!/usr/bin/env bash
# Sets up, builds everything, tests included, and runs the tests.
# Usage: scripts/test.sh [more arguments for ctest, such as -R waves, or -L with exact, mesh, motion or program]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

"$root/scripts/setup.sh"
"$root/scripts/build.sh"
cd "$root/build"

ctest --output-on-failure -j2 "$@"
