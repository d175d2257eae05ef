#!/bin/sh
# Joins the parts. Each is named, so that one which is missing fails by its name.
set -eu
cd "$(dirname "$0")"
lavalight=${LAVALIGHT:-@program@}
@merges@
rm -rf parts/running
