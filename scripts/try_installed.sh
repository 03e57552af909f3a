#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Uses an installed voussoir as a new user would, on small dams, in a directory of its own; ends with status 1 where anything fails.
# Needs nothing but the package; try_package.sh and try_container.sh run it in a clean system: sh -s < scripts/try_installed.sh
set -eu
share=/usr/share/voussoir
cd "$(mktemp -d)"

tried() # COMMAND...
{
  echo "-- $*"
  "$@" >output.txt 2>&1 || { cat output.txt; echo "try: failed: $*"; exit 1; }
  tail -n 3 output.txt
}

is_file() # FILE...
{
  for file in "$@"; do
    [ -s "$file" ] || { echo "try: $file was not written"; exit 1; }
  done
}

printf '%s\n' "include $share/prm/coarse.prm" 'subsection Motion' 'set Duration = 0.64' 'end' \
  'subsection Mesh' 'subsection Arch210' 'set Elements along = 12' 'set Elements up = 3' 'set Elements through = 1' 'end' 'end' >small.prm
tried voussoir --version
tried voussoir "$share/prm/quickstart.prm" --validate
tried voussoir small.prm --set 'Output/Solution interval=16' --output run
is_file run/summary.json run/solution.pvd run/figures/envelope_upstream.png run/figures/history.png
tried voussoir modes small.prm --count 2 --output modes
tried voussoir view small.prm --output view
is_file view/view.png
tried voussoir arcs "$share/meshes/morrow_point.csv" --output morrow_point.prm
tried voussoir modes morrow_point.prm --count 2
tried voussoir new dam.prm </dev/null
is_file morrow_point.prm dam.prm
tried voussoir report run
is_file run/report.html
tried python3 -c 'import voussoir; print(voussoir.run("small.prm", "again").summary["extremes"]["max_opening"])'
echo "try: all is well"
