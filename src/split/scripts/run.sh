#!/bin/sh
# Renders the parts on this machine, one after another, and joins them:
#
#     ./run.sh            all parts, then ./merge.sh
#     ./run.sh 0 3        parts 0 to 3 alone: give other machines, which share this folder, the others
set -eu
CDPATH='' cd -- "$(dirname -- "$0")"
first=${1:-0}
last=${2:-@last@}
number=$first
while [ "$number" -le "$last" ]; do
    ./part.sh "$number"
    number=$((number + 1))
done
[ $# -gt 0 ] || ./merge.sh
