#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The checks before a release, some hours: all tests, the combinations of choices, sanitizers, all mutants, the benchmarks that judge themselves, line coverage, and
# the quick tests on Debian 13 (as root, with debootstrap).
# Goes on after a check that fails; build/full.md has date, machine and a row for each check, build/refused_pairs.md
# the refused pairs (for doc/generated), and build/logs what each printed. Exit status: 0 if all passed.
# Usage: scripts/full.sh [CHECK...]     tests, combinations, sanitizers, mutants, benchmarks, coverage, systems; all without one
# shellcheck disable=SC2317 # the checks are called by their names
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$root"

tests()
{
  scripts/test.sh
  (cd build && VOUSSOIR_START_SERVER=$PWD/tests/libstart_server.so "$root/tests/fuzz.py" voussoir)
}
sanitizers() { scripts/sanitize.sh; }
# Random mutants that survive are no failure; somebody must read them.
mutants()
{
  scripts/mutants.sh --invent 20 --seed "$(git rev-parse HEAD)" --table build/mutants_random.md || true
  scripts/mutants.sh --table build/mutants.md
}
systems() { scripts/try_release.sh trixie; }

combinations()
{
  scripts/build.sh
  VOUSSOIR_START_SERVER=$PWD/build/tests/libstart_server.so python3 tests/combinations build/voussoir --output build/combinations \
    --list-refused build/refused_pairs.md
}

# Those whose exit status says whether the physics came out, on one thread. calculix.py and peers.py skip (77) without their data.
benchmarks()
{
  scripts/build.sh
  local command status=0 code
  for command in "calculix.py benchmarks/calculix_arch210.prm --mass lumped" physics.py convergence.py key_limits.py \
    "keys.py --mesh coarse --motions 1" "ranks_equal.py --seconds 600" peers.py water_staggering.py rebound.py; do
    echo "benchmarks/$command"
    code=0
    # shellcheck disable=SC2086 # words of a command
    OMP_NUM_THREADS=1 benchmarks/$command || code=$?
    if ((code == 77)); then
      echo "benchmarks/${command%% *}: skipped"
    elif ((code)); then
      echo "benchmarks/${command%% *}: failed, status $code"
      status=1
    fi
  done
  return "$status"
}

# The tests of packages build their own programs.
coverage()
{
  local directory=$root/build-coverage flags="--coverage -fprofile-update=atomic" status=0
  scripts/build.sh --directory "$directory" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=$flags" "-DCMAKE_C_FLAGS=$flags"
  find "$directory" -name '*.gcda' -delete
  (cd "$directory" && ctest --output-on-failure --no-tests=error -j"$(nproc)" --timeout 1200 -E 'program_(install|packages)') || status=$?
  scripts/coverage.py "$directory" --missed build/missed_lines.txt | tee build/coverage.md
  return "$status"
}

# summary_of CHECK LOG: the numbers that a check ends with, on one line
summary_of()
{
  case $1 in
    tests | sanitizers | coverage) grep -E 'tests passed|^\| all \|' "$2" | tail -n 2 | sed 's/^| all | \(.*\) | \(.*\) | \(.*\) |$/\3 of \1 lines/' ;;
    combinations) grep 'pairs covered' "$2" | tail -n 1 ;;
    mutants) tail -n 1 "$2" ;;
    systems) grep '^| trixie' "$2" | sed 's/^| //; s/ |$//; s/ | /, /g' ;;
    benchmarks) grep -E ': (skipped|failed)' "$2" || echo "all within their limits" ;;
  esac | paste -sd ';' | sed 's/;/; /g'
}

mkdir -p build/logs
if (($# == 0)); then
  set -- tests combinations sanitizers mutants benchmarks coverage systems
fi
failed=0
{
  echo "$(date -u '+%-d %B %Y'), commit $(git rev-parse --short HEAD), $(nproc) cores, $(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -n 1):"
  printf '\n| check | result | numbers | minutes |\n|---|---|---|---|\n'
} >build/full.md
for check in "$@"; do
  begin=$SECONDS result=passed
  echo "full: $check"
  bash -c "$(declare -f tests combinations sanitizers mutants benchmarks coverage systems); root=$(printf %q "$root"); set -euo pipefail; $check" \
    >"build/logs/full_$check.log" 2>&1 </dev/null || { result=failed; failed=1; tail -n 20 "build/logs/full_$check.log" >&2; }
  echo "| $check | $result | $(summary_of "$check" "build/logs/full_$check.log" || true) | $(((SECONDS - begin + 59) / 60)) |" >>build/full.md
done
if [[ -f build/coverage.md ]]; then
  { echo; cat build/coverage.md; } >>build/full.md
fi
cat build/full.md
exit "$failed"
