#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what Voussoir needs on Debian and Ubuntu, by apt and only where a package is missing. An optional package that the
# release does not have keeps no other package away. Prints at the end which are missing, and what they are for.
# Usage: scripts/setup.sh [--program | --figures]
#   --program: what the build of the program needs; --figures: what a run needs for figures, report and other mesh formats;
#   without an option: both, and what the tests need
set -euo pipefail

# mold: deal.II of Debian 13 links with it, and its package does not depend on it; elsewhere it is faster.
program=(libdeal.ii-dev libsuitesparse-dev libopenblas-dev libgmsh-dev ninja-build cmake g++ mold git)
figures=(python3-matplotlib)
for_runs=("python3-meshio: meshes in the formats .inp and .med"
          "libjs-three: view of the moving dam in voussoir report" "libjs-dygraphs: histories beside this view")
case "${1:-}" in
  --program) required=("${program[@]}") optional=() ;;
  --figures) required=("${figures[@]}") optional=("${for_runs[@]}") ;;
  *)
    required=("${program[@]}" "${figures[@]}" gmsh numdiff ccache shellcheck flake8 doxygen)
    optional=("${for_runs[@]}" "libfclib-dev: FCLib files in voussoir-contact" "libhdf5-dev: with libfclib-dev"
              "clang-format: format of the sources" "calculix-ccx: benchmarks/calculix.py" "python3-siconos: benchmarks/contact.py"
              "python3-h5py: benchmarks/contact.py" "chromium: voussoir report --pdf and the test of its page"
              "snakemake: voussoir study" "mkdocs-material: scripts/site.py" "libjs-mathjax: formulas of scripts/site.py"
              "python3-jsonschema: test of the JSON schema of the scene")
    ;;
esac

is_installed() # PACKAGE
{
  [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" == installed ]]
}

if ! command -v apt-get >/dev/null; then
  echo "setup: this system has no apt-get. Install by other means: ${required[*]}" >&2
  exit 1
fi

needed=()
for package in "${required[@]}"; do
  is_installed "$package" || needed+=("$package")
done
wanted=()
for entry in "${optional[@]}"; do
  is_installed "${entry%%:*}" || wanted+=("$entry")
done
if ((${#needed[@]} + ${#wanted[@]} == 0)); then
  echo "setup: all packages are installed"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if command -v sudo >/dev/null; then
    as_root=(sudo)
  elif ((${#needed[@]})); then
    echo "setup: missing packages, and neither root nor sudo to install them. As root, run:" >&2
    echo "  apt-get install ${needed[*]}" >&2
    exit 1
  else
    printf 'setup: optional package is missing: %s\n' "${wanted[@]}" >&2
    exit 0
  fi
fi

apt() # ARGUMENTS...: apt-get without questions
{
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 "$@"
}

# A failed update is no reason to stop: the lists that are there may do.
apt update || echo "setup: warning: apt-get update failed; the present package lists are used" >&2
candidates=() missing=()
for entry in "${wanted[@]}"; do
  if [[ "$(LC_ALL=C apt-cache policy "${entry%%:*}")" == *"Candidate: "[!\(]* ]]; then
    candidates+=("${entry%%:*}")
  fi
done
# All packages at once, which is faster; the optional ones one by one if that fails.
echo "setup: installing ${needed[*]} ${candidates[*]}"
if ! apt install -y --no-install-recommends "${needed[@]}" "${candidates[@]}"; then
  if ((${#needed[@]})); then
    apt install -y --no-install-recommends "${needed[@]}"
  fi
  for package in "${candidates[@]}"; do
    apt install -y --no-install-recommends "$package" || true
  done
fi
for entry in "${wanted[@]}"; do
  is_installed "${entry%%:*}" || missing+=("$entry")
done
if ((${#missing[@]})); then
  echo "setup: optional packages that could not be installed, and their use:" >&2
  printf '  %s\n' "${missing[@]}" >&2
fi
