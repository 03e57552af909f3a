#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the Debian packages voussoir and voussoir-dev, with CPack, in build-package/ or another directory. Requires dpkg-dev.
# Usage: scripts/package.sh [--directory DIR] [more arguments for cmake]
# DEBFULLNAME and DEBEMAIL name the maintainer of the packages, as for Debian's own tools.
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
export VOUSSOIR_UNITY=ON # a new build directory: compile sources in groups

directory="$root/build-package"
if [[ "${1:-}" == --directory ]]; then
  directory=$2
  shift 2
fi
arguments=(-DCMAKE_INSTALL_PREFIX=/usr -DVOUSSOIR_PYTHON_DIR=lib/python3/dist-packages)
if [[ -n "${DEBEMAIL:-}" ]]; then
  arguments+=("-DVOUSSOIR_PACKAGER=${DEBFULLNAME:-The authors of Voussoir} <$DEBEMAIL>")
fi
"$root/scripts/build.sh" --directory "$directory" --target voussoir "${arguments[@]}" "$@"
rm -f "$directory"/voussoir*.deb
(cd "$directory" && cpack -G DEB)
ls -l "$directory"/voussoir*.deb
