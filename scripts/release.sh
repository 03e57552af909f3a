#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that all files state the same version (check), prints the notes of this version (notes), or makes its tag (tag). doc/release.md
# has all steps of a release. Exit status: 0, or 1 if a file states another version.
# Usage: scripts/release.sh check|notes|tag
set -euo pipefail
# shellcheck source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$root"
version=$(sed -n 's/^project(voussoir VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)

notes() # the section of this version in the change log
{
  awk -v head="## $version" '/^## /{on = ($0 == head || index($0, head " ") == 1)} on' doc/changes.md
}

check()
{
  local status=0 entry file expected
  for entry in "CITATION.cff:version: $version" "python/pyproject.toml:version = \"$version\"" "README.md:The version is $version " "packaging/conda/meta.yaml:set version = \"$version\"" \
    "packaging/debian/changelog:voussoir ($version-" "tests/user_project/CMakeLists.txt:Voussoir ${version%.*} "; do
    file=${entry%%:*} expected=${entry#*:}
    if ! grep -qF "$expected" "$file"; then
      echo "release: $file does not contain \"$expected\" (CMakeLists.txt has version $version)" >&2
      status=1
    fi
  done
  if [[ -z "$(notes)" ]]; then
    echo "release: doc/changes.md has no section \"## $version\"" >&2
    status=1
  fi
  return "$status"
}

case "${1:-}" in
  check) check ;;
  notes) notes ;;
  tag)
    check
    head=$(notes | sed -n 1p)
    if [[ "$head" == *"in work"* ]]; then
      echo "release: doc/changes.md says that $version is in work: write the date of the release instead" >&2
      exit 1
    fi
    if [[ -n "$(git status --porcelain)" ]]; then
      echo "release: commit all changes before the tag" >&2
      exit 1
    fi
    notes | sed 's/^## /Voussoir /; s/^### //' | git tag --annotate "v$version" --cleanup=verbatim --file=-
    ;;
  *)
    sed -n '3,6s/^# //p' "$0" >&2
    exit 2
    ;;
esac
