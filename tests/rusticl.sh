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

# A sampler's name stands for its form _with_pdf as well.
[ $# -gt 0 ] || set -- $(cut -d' ' -f1 "$committed" | grep -v _with_pdf)
status=0 done=' '
for function in "$@"; do
    # --only takes parts of names: some functions are done already.
    case $done in *" $function "*) continue ;; esac
    got=$("$clvndf" check --digest $quick --device rusticl --only "$function") || {
        echo "$function: clvndf check --digest failed (status $?)"
        exit 1
    }
    done="$done$(echo "$got" | cut -d' ' -f1 | tr '\n' ' ')"
    if other=$(echo "$got" | grep -vxFf "$committed"); then
        echo "$other: NOT the same bits"
        status=1
    else
        echo "$function: same bits"
    fi
done
exit $status
