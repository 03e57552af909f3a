#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what Voussoir needs on Debian 12, by apt and only where a package is missing.
# Usage: scripts/setup.sh [--program]     --program: what building and running the program needs, nothing for its tests
set -euo pipefail

required=(libdeal.ii-dev libsuitesparse-dev libopenblas-dev libgmsh-dev libfclib-dev libhdf5-dev
          ninja-build cmake g++ git python3-matplotlib)
optional=(python3-meshio) # reads .inp and .med
if [[ "${1:-}" != --program ]]; then
  required+=(gmsh numdiff ccache clang-format shellcheck flake8 doxygen)
  # Only benchmarks/calculix.py and contact.py, `voussoir study`, scripts/site.py, and the test that looks at the page of `voussoir report`, use them.
  optional+=(calculix-ccx python3-siconos python3-h5py chromium snakemake mkdocs python3-jsonschema)
fi

missing() # PACKAGE...: those that are not installed
{
  local package
  for package in "$@"; do
    [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" == installed ]] ||
      echo "$package"
  done
}

if ! command -v apt-get >/dev/null; then
  echo "setup: this is not a Debian system (no apt-get). Install by other means: ${required[*]}" >&2
  exit 1
fi

mapfile -t needed < <(missing "${required[@]}")
mapfile -t wanted < <(missing "${optional[@]}")
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
    echo "setup: warning: not installed (optional): ${wanted[*]}" >&2
    exit 0
  fi
fi

apt() # ARGUMENTS...: apt-get without questions
{
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "$@"
}

# A failed update is no reason to stop: the lists that are there may do.
apt update || echo "setup: warning: apt-get update failed, going on with the package lists there are" >&2
if ((${#needed[@]})); then
  echo "setup: installing ${needed[*]}"
  apt install -y --no-install-recommends "${needed[@]}"
fi
if ((${#wanted[@]})); then
  apt install -y --no-install-recommends "${wanted[@]}" ||
    echo "setup: warning: could not install ${wanted[*]}; what needs them will be skipped" >&2
fi
