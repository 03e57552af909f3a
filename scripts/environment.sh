# shellcheck shell=bash disable=SC2034
# Sourced by the other scripts: the directory of the sources and the environment of a run.
# One BLAS thread: the program itself works on many small bodies in parallel.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-$(nproc)}
# Containers usually run as root, which Open MPI refuses unless told otherwise.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
