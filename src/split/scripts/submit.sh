#!/bin/sh
# Hands the job to Slurm: an array with a task for each part, and the merge after it. Options go to sbatch:
#
#     ./submit.sh --partition=cpu --cpus-per-task=32
#
# The folder has to lie where all nodes see it. `lavalight status .` says how far the parts are.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")"
mkdir -p logs
array=$(sbatch --parsable "$@" render.sbatch)
merge=$(sbatch --parsable --dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes "$@" merge.sbatch)
echo "parts: job $array; merge: job $merge"
