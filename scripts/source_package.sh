#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the Debian source package of the last commit in build-source/, and checks it with lintian. --binary also builds and checks the
# binary packages, with the quick tests. CPack's packages (scripts/package.sh) need none of this.
# Usage: scripts/source_package.sh [--binary]     needs dpkg-dev, debhelper, dh-python, lintian
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

for tool in dpkg-buildpackage dh dh_python3 lintian; do
  if ! command -v "$tool" >/dev/null; then
    echo "source_package: $tool is missing: apt-get install dpkg-dev debhelper dh-python lintian" >&2
    exit 2
  fi
done
version=$(sed -n 's/^project(voussoir VERSION \([0-9.]*\) .*/\1/p' "$root/CMakeLists.txt")
directory=$root/build-source tree=$root/build-source/voussoir-$version
rm -rf "$directory"
mkdir -p "$directory"
git -C "$root" archive --prefix="voussoir-$version/" HEAD | gzip -n >"$directory/voussoir_$version.orig.tar.gz"
tar -xf "$directory/voussoir_$version.orig.tar.gz" -C "$directory"
cp -r "$tree/packaging/debian" "$tree/debian"
cp "$tree/cmake/debian/copyright" "$tree/debian/"
cd "$tree"
dpkg-buildpackage --build=source --no-sign -d
lintian --fail-on error,warning --display-info ../*.dsc
if [[ "${1:-}" == --binary ]]; then
  dpkg-buildpackage --build=binary --no-sign
  lintian --fail-on error ../*.changes
fi
ls -l "$directory"
