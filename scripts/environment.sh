# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# Sourced by the other scripts: the directory of the sources, the environment of a run, and steps that say what they do.
# One BLAS thread: the program itself works on many small bodies in parallel.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-$(nproc)}
# What was compiled once is taken from ccache in another directory, too, such as that of the mutants.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

# Containers usually run as root, which Open MPI refuses unless told otherwise.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# For builds that test: a part that is missing is an error.
all_parts=(-DVOUSSOIR_WITH_MPI=ON -DVOUSSOIR_WITH_TRILINOS=ON -DVOUSSOIR_WITH_ARPACK=ON -DVOUSSOIR_WITH_FCLIB=ON)

# step NUMBER TEXT COMMAND...: one line with the time that it takes; the output goes to build/logs, and its end to
# standard error if the command fails.
step()
{
  local number=$1 text=$2 log begin=$SECONDS
  shift 2
  mkdir -p "$root/build/logs"
  log="$root/build/logs/step_${number%%/*}.log"
  printf '%s  %-72s' "$number" "$text"
  if "$@" >"$log" 2>&1 </dev/null; then
    printf ' %4d s\n' $((SECONDS - begin))
  else
    local status=$?
    printf ' failed\n'
    { echo "The end of $log:"; tail -n 40 "$log"; } >&2
    return "$status"
  fi
}
