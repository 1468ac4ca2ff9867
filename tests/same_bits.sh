#!/bin/sh
# The host build has the same bits with every compiler and every level of optimisation: it is compiled with g++ and
# clang++ at -O0 to -O3, each with and without -march=native, inputs and hashes included, and its digests are compared
# with those of tests/data.
#
#   same_bits.sh [--quick] PROJECT BUILD WORK [COMPILER -OPTION...]...
#
# PROJECT: the source folder; BUILD: where it is built; WORK: a folder for what is compiled here. Each further argument is
# one compiler with its options ("clang++ -O3"); default: all 16. --quick: 2^12 inputs a function instead of 2^20.
# Exit status: 0 the same bits, 1 not, 2 nothing to compare: wrong arguments or nothing built; 77 the same bits as far as
# could be tried: a compiler is missing.
set -u

cannot() {
    echo "same_bits.sh: $*"
    exit 2
}

quick=
digests=digests.txt
if [ "${1-}" = --quick ]; then
    quick=--quick
    digests=digests_quick.txt
    shift
fi
[ $# -ge 3 ] || cannot "usage: same_bits.sh [--quick] PROJECT BUILD WORK [COMPILER -OPTION...]..."
project=$1 build=$2 work=$3
shift 3
committed=$project/tests/data/$digests
libraries="$build/host/libclvndf_host.a $build/host/reference/libclvndf_reference.a"
[ -f "$committed" ] || cannot "no $committed: $project is not the source folder"
for library in $libraries; do
    [ -f "$library" ] || cannot "no $library: build it first (cmake --build $build --target clvndf)"
done
mkdir -p "$work" 2>/dev/null || cannot "$work: cannot make this folder"

[ $# -gt 0 ] || set -- \
    "g++ -O0" "g++ -O1" "g++ -O2" "g++ -O3" \
    "g++ -O0 -march=native" "g++ -O1 -march=native" "g++ -O2 -march=native" "g++ -O3 -march=native" \
    "clang++ -O0" "clang++ -O1" "clang++ -O2" "clang++ -O3" \
    "clang++ -O0 -march=native" "clang++ -O1 -march=native" "clang++ -O2 -march=native" "clang++ -O3 -march=native"

# What the bits depend on; the rest comes from the libraries of BUILD.
sources="host/runtime/host_build.cpp host/conformance/judge/digest.cpp host/conformance/inputs/points.cpp host/conformance/inputs/grids.cpp
    tests/support/digest_host.cpp"

# digests_of COMPILER OPTION...: the digests of this build, on stdout.
digests_of() {
    objects=
    for source in $sources; do
        object=$work/$(basename "$source" .cpp).o
        "$@" -std=c++20 -ffp-contract=off -DVNDF_REAL=float -DVNDF_MATH=strict -I"$project" -I"$project/host" \
            -c "$project/$source" -o "$object" || return 1
        objects="$objects $object"
    done
    "$@" $objects $libraries -lfmt -lOpenCL -pthread \
        -o "$work/digest_host" || return 1
    "$work/digest_host" $quick
}

missing=0 status=0
for build_with in "$@"; do
    if ! command -v ${build_with%% *} >/dev/null; then
        echo "skipped: $build_with: no such compiler"
        missing=77
        continue
    fi
    if ! digests_of $build_with >"$work/digests.txt"; then
        echo "$build_with: does not build, or does not run"
        status=1
    elif diff "$committed" "$work/digests.txt"; then
        echo "$build_with: same bits"
    else
        echo "$build_with: NOT the same bits"
        status=1
    fi
done
[ $status = 0 ] && exit $missing
exit $status
