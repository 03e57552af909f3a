#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Do the tests notice errors? Sets up, builds the program and the mutants, and runs the tests against them.
# Usage: scripts/mutants.sh [arguments of scripts/mutants.py, which see]
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

"$root/scripts/setup.sh"
"$root/scripts/build.sh" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON
exec "$root/scripts/mutants.py" "$@"
