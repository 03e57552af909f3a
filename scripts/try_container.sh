#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds container/Dockerfile with buildah (apt-get install buildah; docker and podman take the same file) and uses voussoir in it
# (try_installed.sh). Nothing is asked of a registry where VOUSSOIR_BASE names a directory that debootstrap has made of Debian 13: it
# then stands for the image debian:13.
# Usage: scripts/try_container.sh [--package]       as root
#   --package  the first stage takes the package of build-package/, built on Debian 13, instead of building it
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

if ! command -v buildah >/dev/null; then
  echo "try_container: needs buildah (apt-get install buildah)" >&2
  exit 2
fi

base_image() # the directory VOUSSOIR_BASE as the image debian:13
{
  local container
  container=$(buildah from scratch)
  buildah copy --quiet "$container" "$VOUSSOIR_BASE" /
  buildah config --cmd bash "$container"
  buildah commit --quiet --rm "$container" docker.io/library/debian:13
}

use() # in a container of the image that is thrown away
{
  local container status=0
  container=$(buildah from localhost/voussoir)
  buildah copy --quiet "$container" "$root/scripts/try_installed.sh" /tmp/
  buildah run --isolation chroot "$container" sh /tmp/try_installed.sh || status=$?
  buildah rm "$container" >/dev/null
  return "$status"
}

file=$root/container/Dockerfile
context=$root
if [[ "${1:-}" == --package ]]; then
  context=$(mktemp -d)
  trap 'rm -r "$context"' EXIT
  cp "$root"/build-package/voussoir_*.deb "$context/"
  file=$context/Dockerfile
  { printf '%s\n' 'FROM scratch AS build' 'COPY voussoir_*.deb /voussoir/build-package/'
    awk '/^FROM/ { ++stage } stage > 1' "$root/container/Dockerfile"; } >"$file"
fi
if [[ -n "${VOUSSOIR_BASE:-}" ]]; then
  step 1/3 "The image debian:13 from $VOUSSOIR_BASE" base_image
fi
step 2/3 "Build the image: container/Dockerfile" \
  buildah bud --isolation chroot --network host -t localhost/voussoir -f "$file" "$context"
step 3/3 "Use it: scripts/try_installed.sh" use
sed -n '/^--/p;/^try/p' "$root/build/logs/step_3.log"
buildah images localhost/voussoir
