#!/bin/sh
# Joins the parts that are done so far, at any time:
#
#     ./preview.sh
#
# A picture of fewer samples is noisier; nothing else is wrong with it.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")"
lavalight=${LAVALIGHT:-@program@}
preview() { # preview OUT.exr PARTS...
    out=$1
    shift
    for part in "$@"; do
        shift
        [ ! -e "$part" ] || set -- "$@" "$part"
    done
    case $# in
    0) echo "preview.sh: no part of $out is done yet" ;;
    1) cp "$1" "$out" ;;
    *) "$lavalight" merge @merge_options@"$@" -o "$out" ;;
    esac
}
@previews@
