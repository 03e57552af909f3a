#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds and runs one scene, by default the quick start.
# Usage: scripts/run.sh [SCENE.prm] [more arguments for voussoir]
# Results: output/<scene name>/ in the source directory, unless --output says otherwise.
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
export VOUSSOIR_UNITY=ON # a new build directory: compile sources in groups

scene="$root/prm/quickstart.prm"
if (($#)) && [[ "$1" != -* ]]; then
  scene=$1
  shift
fi
if [[ ! -f "$scene" ]]; then
  echo "run: no such scene: $scene" >&2
  exit 2
fi

output="$root/output/$(basename "$scene" .prm)"
arguments=()
while (($#)); do
  if [[ "$1" == --output ]] && (($# > 1)); then
    output=$2
    shift 2
  else
    arguments+=("$1")
    shift
  fi
done

step 1/4 "Packages: deal.II and what else is missing (scripts/setup.sh)" "$root/scripts/setup.sh" --program
"$root/scripts/setup.sh" --figures >"$root/build/logs/figures.log" 2>&1 </dev/null & # during the build
figures=$!
step 2/4 "Configure: CMake" "$root/scripts/build.sh" --configure-only
step 3/4 "Build: the program, without its tests" "$root/scripts/build.sh" --target voussoir
wait "$figures" || echo "run: warning: packages of the figures are missing ($root/build/logs/figures.log)" >&2
begin=$SECONDS
echo "4/4  Run: $scene"
echo
mkdir -p "$(dirname "$output")"
"$root/build/voussoir" "$scene" --output "$output" "${arguments[@]}"

echo
printf '4/4  %-72s %4d s\n' "Run: done" $((SECONDS - begin))
if [[ -d "$output" ]]; then
  echo "Results: $output"
fi
if compgen -G "$output/figures/*.png" >/dev/null; then
  echo "Figures: $output/figures"
fi
