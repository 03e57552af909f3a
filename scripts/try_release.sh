#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds and tests Voussoir on other releases of Debian or Ubuntu. For each: a root file system by debootstrap, scripts/setup.sh, the
# program with warnings as errors, the quick tests, and the coarse scene (test golden_coarse: stored tables, to 1e-5).
# Prints a table of the systems; VOUSSOIR_RELEASES/RELEASE-COMPILER.log has all output.
# Usage: scripts/try_release.sh [--compiler gcc|clang] RELEASE...     as root; bookworm, trixie, sid, noble, resolute; all without one
# Environment: VOUSSOIR_RELEASES directory of the root file systems (build-releases), about 4 GB each; they are kept and used again
#              VOUSSOIR_MIRROR   package mirror (deb.debian.org for Debian, archive.ubuntu.com for Ubuntu)
# Exit status: 0 if all releases passed, 77 if all that could be reached did.
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

# All in a namespace of mounts and processes of its own: nothing is left mounted or running.
if [[ -z "${VOUSSOIR_APART:-}" && $EUID == 0 ]]; then
  VOUSSOIR_APART=1 exec unshare --mount --pid --fork "$0" "$@"
fi
compiler=gcc
if [[ "${1:-}" == --compiler ]]; then
  compiler=$2
  shift 2
  if [[ "$compiler" != gcc && "$compiler" != clang ]]; then
    echo "try_release: --compiler $compiler: gcc or clang" >&2
    exit 2
  fi
fi
if ((EUID != 0)) || ! command -v debootstrap >/dev/null || ! command -v curl >/dev/null; then
  echo "try_release: needs root, debootstrap and curl (apt-get install debootstrap curl)" >&2
  exit 2
fi
if (($# == 0)); then
  set -- bookworm trixie sid noble resolute
fi
directory=${VOUSSOIR_RELEASES:-$root/build-releases}
mkdir -p "$directory"

mirror_of() # RELEASE
{
  case $1 in
    noble | resolute) echo "${VOUSSOIR_MIRROR:-http://archive.ubuntu.com/ubuntu}" ;;
    *) echo "${VOUSSOIR_MIRROR:-http://deb.debian.org/debian}" ;;
  esac
}

components_of() # RELEASE
{
  case $1 in
    noble | resolute) echo main,universe ;;
    *) echo main ;;
  esac
}

# make_system RELEASE SYSTEM: the root file system, with this system's certificates, proxies and keys of apt left out
make_system()
{
  local script=/usr/share/debootstrap/scripts/$1
  if [[ ! -e "$script" ]]; then # a newer release than this debootstrap
    case $1 in
      noble | resolute) script=/usr/share/debootstrap/scripts/gutsy ;;
      *) script=/usr/share/debootstrap/scripts/sid ;;
    esac
  fi
  rm -rf --one-file-system "$2.part"
  debootstrap --variant=minbase --components="$(components_of "$1")" --include=ca-certificates,git "$1" "$2.part" \
    "$(mirror_of "$1")" "$script" && cp -L /etc/resolv.conf "$2.part/etc/resolv.conf" && mv "$2.part" "$2"
}

# inside SYSTEM COMMAND...: in the root file system, as root
inside()
{
  local system=$1
  shift
  chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 OMP_NUM_THREADS="$OMP_NUM_THREADS" \
    OPENBLAS_NUM_THREADS="$OPENBLAS_NUM_THREADS" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "$@"
}

# The commands of one release, inside of it.
commands_of() # COMPILER
{
  echo 'set -euo pipefail; cd /voussoir; git config --global --add safe.directory /voussoir'
  echo 'scripts/setup.sh'
  case $1 in
    clang)
      echo 'apt-get install -y --no-install-recommends clang libomp-dev'
      echo 'compiler="-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang"' ;;
    *) echo 'compiler=' ;;
  esac
  # shellcheck disable=SC2016
  echo 'source scripts/environment.sh; scripts/build.sh --directory build-try --target quick -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "${all_parts[@]}" $compiler' \
    '; echo built; cd build-try; ctest -j2 --output-on-failure --no-tests=error -L quick; echo tested; ctest -j2 --output-on-failure' \
    '--no-tests=error -R "^golden_coarse"; echo same'
}

version_of() # SYSTEM PACKAGE: upstream version of an installed package
{
  chroot "$1" dpkg-query -W "$2" 2>/dev/null | cut -f 2 | sed 's/^[0-9]*://; s/[-+].*//' || true
}

table="| release | deal.II | compiler | builds without a warning | quick tests | tables of the coarse scene | run |
|---|---|---|---|---|---|---|"
failed=0 unreached=0
for release in "$@"; do
  system=$directory/$release log=$directory/$release-$compiler.log
  if [[ ! -d "$system" ]] && ! curl -sfIm 20 "$(mirror_of "$release")/dists/$release/Release" >/dev/null; then
    table+=$'\n'"| $release | | | not tried: $(mirror_of "$release") does not answer | | | |"
    unreached=77
    continue
  fi
  if [[ ! -d "$system" ]] && ! make_system "$release" "$system" >"$log" 2>&1; then
    table+=$'\n'"| $release | | | no root file system (see $log) | | | |"
    failed=1
    continue
  fi
  echo "try_release: $release, $compiler (log $log)"
  rm -rf --one-file-system "$system/voussoir"
  git -c safe.directory="$root/.git" clone --quiet --no-hardlinks "$root" "$system/voussoir"
  mountpoint -q "$system/proc" || mount -t proc proc "$system/proc"
  mountpoint -q "$system/dev" || mount --rbind /dev "$system/dev"
  mountpoint -q "$system/sys" || mount -t sysfs -o ro sysfs "$system/sys" # Open MPI reads the topology of the cores
  status=0
  inside "$system" bash -c "$(commands_of "$compiler")" >"$log" 2>&1 </dev/null || { status=1 failed=1; tail -n 30 "$log" >&2; }
  built=no tested=no same=no
  grep -q '^built$' "$log" && built=yes
  grep -q '^tested$' "$log" && tested="yes ($(sed -n 's/.*tests passed, 0 tests failed out of \([0-9]*\)/\1/p' "$log" | head -n 1))"
  ((status == 0)) && same=yes
  case $compiler in
    clang) version="clang $(version_of "$system" clang)" ;;
    *) version="gcc $(version_of "$system" g++)" ;;
  esac
  table+=$'\n'"| $release | $(version_of "$system" libdeal.ii-dev) | $version | $built | $tested | $same | $(date -u '+%-d %B %Y') |"
done
echo "$table"
exit "$((failed ? failed : unreached))"
