#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tries the Debian packages in a clean Debian 12 (a minimal root by debootstrap, thrown away at the end): installs voussoir with its
# dependencies by the steps of container/voussoir.def, uses it (try_installed.sh), builds tests/user_project against
# voussoir-dev, removes both, and looks for what stayed behind.
# Usage: scripts/try_package.sh [--program] [DIRECTORY OF THE PACKAGES, by default build-package]       as root
#   --program  voussoir alone; voussoir-dev brings a compiler and the headers of deal.II, 3 GB
# VOUSSOIR_MIRROR: where apt gets its packages, by default deb.debian.org. VOUSSOIR_BASE: a directory that debootstrap has made, to
# start from a copy of it. TMPDIR: where the root goes (4 GB); /dev/shm is quicker.
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

# All in a namespace of mounts and processes of its own: nothing is left mounted or running.
if [[ -z "${VOUSSOIR_APART:-}" && $EUID == 0 ]]; then
  VOUSSOIR_APART=1 exec unshare --mount --pid --fork "$0" "$@"
fi
development=true
if [[ "${1:-}" == --program ]]; then
  development=false
  shift
fi
packages=${1:-$root/build-package}
shopt -s nullglob
found=("$packages"/voussoir_*.deb "$packages"/voussoir-dev_*.deb)
if ((${#found[@]} != 2)); then
  echo "try_package: there are not two packages in $packages: build them by scripts/package.sh" >&2
  exit 2
fi
if ((EUID != 0)) || ! command -v debootstrap >/dev/null; then
  echo "try_package: needs root and debootstrap (apt-get install debootstrap)" >&2
  exit 2
fi
clean=$(mktemp -d)
trap 'umount -l "$clean"/{proc,dev} 2>/dev/null || true; rm -rf --one-file-system "$clean"' EXIT
inside() # COMMAND...: in the clean root
{
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 OPENBLAS_NUM_THREADS=1 DEBIAN_FRONTEND=noninteractive \
    chroot "$clean" "$@"
}

mkdir -p "$root/build/logs"
if [[ -n "${VOUSSOIR_BASE:-}" ]]; then
  step 1/5 "Clean Debian 12: a copy of $VOUSSOIR_BASE" cp -a "$VOUSSOIR_BASE/." "$clean"
else
  step 1/5 "Clean Debian 12: debootstrap" \
    debootstrap --variant=minbase bookworm "$clean" "${VOUSSOIR_MIRROR:-http://deb.debian.org/debian}"
fi
mount -t proc proc "$clean/proc"
mount --bind /dev "$clean/dev"
cp /etc/resolv.conf "$clean/etc/"
echo force-unsafe-io >"$clean/etc/dpkg/dpkg.cfg.d/quick" # no waiting for the disk: the root is thrown away

mkdir "$clean/packages"
cp "${found[@]}" "$clean/packages/"
cp "$root/scripts/try_installed.sh" "$clean/packages/"
cp -r "$root/tests/user_project" "$clean/packages/"
# The steps of the Apptainer file, which finds the package in /tmp.
sed -n '/^%post$/,/^%environment$/{/^%/d;p}' "$root/container/voussoir.def" >"$clean/packages/post.sh"
cp "$packages"/voussoir_*.deb "$clean/tmp/"

step 2/5 "Install voussoir: the section %post of container/voussoir.def" inside sh -eu /packages/post.sh
size=$(du -sxm "$clean" | cut -f1)
step 3/5 "Use it: scripts/try_installed.sh" inside sh /packages/try_installed.sh
sed -n '/^--/p;/^try/p' "$root/build/logs/step_3.log"
echo "     A root with voussoir and all that it needs: $size MB"
if [[ $development == true ]]; then
  # shellcheck disable=SC2016
  step 4/5 "Install voussoir-dev, build a program with it: tests/user_project" inside sh -euc '
    apt-get update
    apt-get install -y --no-install-recommends /packages/voussoir-dev_*.deb cmake g++ ninja-build
    cmake -S /packages/user_project -B /tmp/user -G Ninja -DCMAKE_BUILD_TYPE=Release
    cmake --build /tmp/user
    test "$(/tmp/user/sliding_joint)" = "normal 1000 N, tangential -800 N"'
fi
# shellcheck disable=SC2016
step 5/5 "Remove it again" inside sh -euc 'dpkg --purge $(dpkg-query -W -f "\${Package} " "voussoir*"); dpkg --audit'
left=$(find "$clean"/usr "$clean"/etc "$clean"/var -iname '*voussoir*' -not -path '*/dpkg/*' -not -path '*/log/*')
if [[ -n "$left" ]]; then
  echo "try_package: this stayed behind: $left" >&2
  exit 1
fi
echo "The packages install, work and go without a trace."
