#!/bin/sh
# The promise of fast math: on the default OpenCL device with renderers' flags and with every pair of flags, and as C++ with
# every compiler at hand.
#
#   fast_math.sh [--quick] PROJECT BUILD WORK
#
# PROJECT: the source folder; BUILD: where it is built; WORK: a folder for what is made here. --quick: fewer points.
# Exit status: 0 the promise is kept, and broken where it must be; 1 not; 2 wrong arguments or nothing built; 77 kept as far
# as could be tried: a compiler is missing.
set -u

cannot() {
    echo "fast_math.sh: $*"
    exit 2
}

quick=
if [ "${1-}" = --quick ]; then
    quick=--quick
    shift
fi
[ $# = 3 ] || cannot "usage: fast_math.sh [--quick] PROJECT BUILD WORK"
project=$1 build=$2 work=$3 clvndf=$2/clvndf
[ -f "$project/tests/support/fast_math_build.cpp" ] || cannot "$project is not the source folder"
libraries="$build/host/libclvndf_host.a $build/host/reference/libclvndf_reference.a"
for file in $libraries "$clvndf"; do [ -f "$file" ] || cannot "no $file: build it first"; done
mkdir -p "$work" 2>/dev/null || cannot "$work: cannot make this folder"
missing=0 status=0

# measured NAME COMMAND...: its table goes into $work/table; says whether the promise is kept.
measured() {
    name=$1
    shift
    "$@" >"$work/table" 2>&1
    got=$?
    case $got in
    0) echo "$name: kept" ;;
    1) echo "$name: broken" && grep " BREAKS " "$work/table" ;;
    *) echo "$name: failed" && tail -5 "$work/table" && status=1 ;;
    esac
    return $got
}

policies() { measured "$1" "$clvndf" policies $quick --quiet --flags "$1"; }

policies renderers || status=1
policies pairs || status=1

# Told of reassociation alone, as clang for GPUs is, these and no others lose the promise, by their largest errors: where a
# last digit of a quotient decides over more (config.h).
measured "cycles, reassociation alone switched off" \
    "$clvndf" policies $quick --quiet --flags "cycles -DVNDF_IMPL_PRECISE=1"
broken=$(sed -n 's/^\([a-z0-9_]*\) .* BREAKS  *\(.*\)/\1 \2/p' "$work/table")
exempt="vndf_beckmann_sample_wm_heitz_deon2014 direction
vndf_beckmann_sample_wm_heitz_deon2014_with_pdf value, direction
vndf_beckmann_sample_wm_heitz_deon2014_lobe direction
vndf_beckmann_sample_wm_heitz_deon2014_lobe_with_pdf value, direction
vndf_beckmann_slope_cdf_inverse value
vndf_ggx_invert_wi_conic2026 value
vndf_tangent value
vndf_tangent_along value"
[ -n "$quick" ] || [ "$broken" = "$exempt" ] || { echo "not what is documented:" && echo "$broken" && status=1; }

# Where nothing is switched off the check fails.
measured "cycles, nothing switched off" "$clvndf" policies $quick --quiet --flags "cycles -DVNDF_IMPL_PRECISE=0" \
    --only walter2007 && echo "the check cannot fail" && status=1

# What `clvndf emit` writes for OpenCL answers with the bits of the library under Fluctus' flags; without the pragmas it does not.
if command -v g++ >/dev/null; then
    g++ -std=c++17 -w "$project/tests/support/emitted_selftest.cpp" -o "$work/on_device" -lOpenCL &&
        "$clvndf" emit beckmann_sample_wm_walter2007 jacobian_refract --selftest -o "$work/emitted.cl" &&
        grep -v float_control "$work/emitted.cl" >"$work/bare.cl" || status=1
    fluctus="-cl-denorms-are-zero -cl-fast-relaxed-math"
    echo "emitted: $("$work/on_device" "$work/emitted.cl" "$fluctus")"
    "$work/on_device" "$work/emitted.cl" "$fluctus" >/dev/null || status=1
    "$work/on_device" "$work/bare.cl" "$fluctus" >/dev/null && echo "the check of emitted files cannot fail" && status=1
fi

# cpp COMPILER OPTION...: the host build.
cpp() {
    options="-std=c++20 -DVNDF_ALLOW_FAST_MATH=1 -DVNDF_REAL=float -DVNDF_MATH=strict -Wall -Wextra -Werror -I$project
        -I$project/host -I$project/tests"
    if ! command -v "$1" >/dev/null; then
        echo "skipped: $*: no such compiler"
        missing=77
        return
    fi
    { "$@" $options -c "$project/tests/support/fast_math_build.cpp" -o "$work/fast.o" &&
        "$@" $options -c "$project/tests/support/fast_math_host.cpp" -o "$work/main.o" &&
        "$@" "$work/main.o" "$work/fast.o" $libraries -lfmt -lOpenCL -pthread -o "$work/fast_math_host"; } ||
        { echo "$*: does not build" && status=1 && return; }
    measured "$*" "$work/fast_math_host" "$*" $quick || status=1
}
for compiler in g++ clang++; do
    for level in -O2 -O3 "-O3 -march=native"; do cpp $compiler -ffast-math $level; done
done
if command -v g++ >/dev/null; then
    (status=0 && cpp g++ -ffast-math -O2 -DVNDF_IMPL_PRECISE=0 && exit $status) && echo "the check cannot fail" && status=1
fi
[ $status = 0 ] || exit $status
exit $missing
