#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks the folders: a room includes only itself and the rooms above, without circular includes. A function has at most 60 lines.
# check_classes.py checks the classes, check_imports.py the imports of Python.
# Usage: scripts/check_rooms.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
rooms=(base motion mesh contact solid joints dynamics rock foundation water dam output app)

# Edges "room/file room/file" of all sources and headers that include another file.
edges=$(grep -rHo '#include <voussoir/[a-z]*/[a-z0-9_]*' source include/voussoir |
  sed -E 's,^(source|include/voussoir)/([a-z]+/[a-z0-9_]+)\.(cc|h):#include <voussoir/,\2 ,' | awk '$1 != $2' | sort -u)
awk -v order="${rooms[*]}" '
  BEGIN { n = split(order, name, " "); for (i = 1; i <= n; i++) floor[name[i]] = i }
  { split($1, from, "/"); split($2, to, "/")
    if (!floor[from[1]] || floor[to[1]] > floor[from[1]]) { print "folders: " $1 " includes " $2 ", which is below it"; bad = 1 } }
  END { exit bad }' <<< "$edges"
tsort <<< "$edges" > /dev/null 2> >(sed 's/^tsort: /folders: files that need each other: /' >&2)
find source include/voussoir -name '*.cc' -o -name '*.h' | LC_ALL=C sort |
  xargs "${PYTHON:-python3}" scripts/function_lengths.py 60 | sed 's/^/folders: /'
find include/voussoir -name '*.h' | LC_ALL=C sort | xargs "${PYTHON:-python3}" scripts/check_classes.py | sed 's/^/folders: /'
"${PYTHON:-python3}" scripts/check_imports.py
