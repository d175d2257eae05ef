#!/bin/sh
# Renders the part on one line of parts.txt; lines count from 0:
#
#     ./part.sh 3 [more options of lavalight render]
#
# A part that is done is left alone. A part that was interrupted goes on from its checkpoint. Two processes that render one part
# do no harm: each writes its own files, and both give the finished film, whose bits are equal, the part's name.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")"
lavalight=${LAVALIGHT:-@program@}

[ $# -gt 0 ] || { echo "part.sh: cannot tell which part to render; try ./part.sh 0" >&2; exit 2; }
case $1 in
'' | *[!0-9]* | 0?*) echo "part.sh: cannot render part $1: it is not the number of a part; try ./part.sh 0" >&2; exit 2 ;;
esac
line=$(sed -n "$(($1 + 1))p" parts.txt)
[ -n "$line" ] || { echo "part.sh: cannot render part $1: parts.txt has no such line" >&2; exit 2; }
shift
# shellcheck disable=SC2086 # The line holds a name, then options.
set -- $line "$@"
name=$1
shift
part=parts/$name.exr
is_done() { [ -f "$part" ] && [ -s "$part" ]; }
if is_done; then
    echo "$part is done"
    exit 0
fi

mkdir -p parts/running
mine="parts/running/$name.$(uname -n)-$$"
: > "$mine.started" # lavalight status sees it
# A process that still writes its checkpoint must not be disturbed: this one goes on from a copy of the newest.
# shellcheck disable=SC2012 # The names have neither spaces nor line breaks.
left=$(ls -t parts/running/"$name".*.checkpoint.exr 2>/dev/null | head -n 1)
if [ -n "$left" ] && cp "$left" "$mine.copy"; then mv "$mine.copy" "$mine.checkpoint.exr"; fi

render() {
    "$lavalight" render @scene@@options@ "$@" --quiet \
        --checkpoint "$mine.checkpoint.exr" --checkpoint-every @interval@ --resume -o "$mine.done.exr"
}

trap : INT TERM # The program gets the signal, too, writes its checkpoint, and says so by its status.
status=0
render "$@" || status=$?
if [ "$status" -eq 1 ] && [ -n "$left" ] && ! is_done && cmp -s "$left" "$mine.checkpoint.exr"; then
    # A checkpoint may be damaged, or of another kind of processor, whose bits differ.
    echo "part.sh: $name starts from its first sample, without the checkpoint $left" >&2
    rm -f "$mine.checkpoint.exr"
    status=0
    render "$@" || status=$?
fi
if [ "$status" -ne 0 ]; then
    rm -f "$mine.started" "$mine.done.exr"
    ! is_done || exit 0 # by another process
    exit "$status"
fi
mv "$mine.done.exr" "$part" || is_done # The merge of another process removes what is in parts/running.
rm -f "$mine".* "$left"
