#!/bin/sh
# Mesa's rusticl on llvmpipe keeps the bits: a compiler of its own (SPIR-V, NIR), no fma, and subnormal numbers flushed.
#
#   rusticl.sh [--quick] PROJECT BUILD [FUNCTION...]
#
# A program for each function: one with all of them takes its compiler a quarter of an hour. Default: all functions.
# --quick: 2^12 inputs a function instead of 2^20. Exit status: 0 the same bits, 1 not, 2 nothing to compare: wrong
# arguments, an unknown function or nothing built; 77 without rusticl.
set -u

cannot() {
    echo "rusticl.sh: $*"
    exit 2
}

quick=
digests=digests.txt
if [ "${1-}" = --quick ]; then
    quick=--quick
    digests=digests_quick.txt
    shift
fi
[ $# -ge 2 ] || cannot "usage: rusticl.sh [--quick] PROJECT BUILD [FUNCTION...]"
project=$1 build=$2
shift 2
clvndf=$build/clvndf
committed=$project/tests/data/$digests
[ -f "$committed" ] || cannot "no $committed: $project is not the source folder"
[ -x "$clvndf" ] || cannot "no $clvndf: build it first (cmake --build $build --target clvndf)"
for function in "$@"; do
    grep -q "^$function " "$committed" || cannot "no function $function in $committed"
done
export RUSTICL_ENABLE=llvmpipe
"$clvndf" devices 2>/dev/null | grep -q '^rusticl' || { echo "rusticl (mesa-opencl-icd, libclc-15) is not installed"; exit 77; }

[ $# -gt 0 ] || set -- $(cut -d' ' -f1 "$committed")
status=0
for function in "$@"; do
    # A pattern, which stands for this name alone; as part of names it would stand for others, too.
    got=$("$clvndf" check --digest $quick --device rusticl --only "*$function") || {
        echo "$function: clvndf check --digest failed (status $?)"
        exit 1
    }
    if [ "$got" = "$(grep "^$function " "$committed")" ]; then
        echo "$function: same bits"
    else
        echo "$function: NOT the same bits"
        status=1
    fi
done
exit $status
