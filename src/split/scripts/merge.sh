#!/bin/sh
# Joins the parts. All are listed by name, so that the merge fails with the name of a missing one.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")"
lavalight=${LAVALIGHT:-@program@}
@merges@
rm -rf parts/running
