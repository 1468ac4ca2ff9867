#!/bin/sh
# The path tracer in full, and on every device: what tests/render/ shows in quick form.
#
#   sh tests/render.sh BUILD images    known answers, samplers, slopes with 16 times the samples (minutes)
#   sh tests/render.sh BUILD devices   the same bits on PoCL, Oclgrind and rusticl, of tiny images
#   sh tests/render.sh BUILD picture   the picture of README.md again, compared with the committed one
#
# Exit status: 0 as it should be, 1 not so, 2 wrong arguments, 77 nothing to run it on.
set -u
[ $# = 2 ] || { echo "usage: render.sh BUILD images|devices|picture" >&2; exit 2; }
build=$1
[ -x "$build/clvndf" ] || { echo "no $build/clvndf: build it first" >&2; exit 2; }
project=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# tiny NAME COMMAND...: an image's end, the pixels; its beginning tells of device and time.
tiny() {
    name=$1
    shift
    "$@" "$build/clvndf" --quiet render --size 8x4 --spp 1 --max-bounces 2 -o "$work/$name.exr" $option || exit 1
    tail -c 250 "$work/$name.exr" >"$work/$name"
}

case $2 in
images)
    CLVNDF_EFFORT=16 "$build/clvndf_tests" -\# "[#images_test]~[.]"
    ;;
devices)
    compared=
    option=
    tiny usual env
    if command -v oclgrind >/dev/null; then
        tiny oclgrind oclgrind --log "$work/log"
        [ ! -s "$work/log" ] || { cat "$work/log"; exit 1; }
        compared=oclgrind
    fi
    if RUSTICL_ENABLE=llvmpipe "$build/clvndf" devices 2>/dev/null | grep -q '^rusticl'; then
        option="--device rusticl"
        tiny rusticl env RUSTICL_ENABLE=llvmpipe
        compared="$compared rusticl"
    fi
    [ -n "$compared" ] || { echo "neither Oclgrind nor rusticl is installed"; exit 77; }
    for name in $compared; do
        cmp "$work/usual" "$work/$name" || { echo "$name: NOT the same bits"; exit 1; }
        echo "$name: same bits"
    done
    ;;
picture)
    "$build/clvndf" render --spp 256 -o "$work/orbs.png" && cmp "$work/orbs.png" "$project/host/render/orbs.png"
    ;;
*)
    echo "render.sh: '$2' is none of images, devices and picture" >&2
    exit 2
    ;;
esac
