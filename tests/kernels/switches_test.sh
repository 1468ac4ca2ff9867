#!/bin/sh
# The headers refuse what they cannot keep their promises with: a value that a switch does not have, in OpenCL C and in
# C++, and a compiler option that changes results, where the compiler tells of it (config.h), unless VNDF_ALLOW_FAST_MATH
# is set. Each refusal is one error, which says what is wrong. Compilers that are missing are passed over; exits with 77
# (skipped) where all are.
#
#   switches_test.sh KERNELS_DIR
set -eu
kernels=${1-}
[ -f "$kernels/vndf/vndf.h" ] || { echo "switches_test.sh: no headers in '$kernels/vndf'" && exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo '#include "vndf/vndf.h"' >"$work/test.cpp"
cp "$work/test.cpp" "$work/test.cl"
status=0 tried=0

# The preprocessor sees nearly all of it; $mode is for what it does not.
mode=-E
compile() { "$@" $mode -I "$kernels" >/dev/null 2>"$work/log"; }

accepted() {
    compile "$@" || { echo "refused: $*" && head -20 "$work/log" && status=1; }
}

# refused TEXT COMPILER OPTION...: with one error, which contains TEXT.
refused() {
    text=$1
    shift
    if compile "$@"; then
        echo "accepted: $*"
        status=1
    elif [ "$(grep -c 'error:' "$work/log")" != 1 ] || ! grep 'error:' "$work/log" | grep -qF -e "$text"; then
        echo "not the one error \"$text\": $*"
        head -20 "$work/log"
        status=1
    fi
}

# values COMPILER OPTION...: what is the same in both languages.
values() {
    mode=-fsyntax-only
    accepted "$@" -DVNDF_REAL=float -DVNDF_MATH=builtin -DVNDF_SOFTWARE_FMA=0
    accepted "$@" -DVNDF_REAL=double -DVNDF_MATH=strict -DVNDF_SOFTWARE_FMA=1
    for value in half vndf_float 1 ''; do refused "float and double are allowed" "$@" -DVNDF_REAL=$value; done
    mode=-E
    for value in fast Strict 1 ''; do refused "strict, builtin and native are allowed" "$@" -DVNDF_MATH=$value; done
    for switch in VNDF_SOFTWARE_FMA VNDF_SOFTWARE_DIVIDE VNDF_ALLOW_FAST_MATH; do
        for value in yes 2 ''; do refused "unknown $switch; 0 and 1 are allowed" "$@" -D$switch=$value; done
    done
    refused "float only" "$@" -DVNDF_REAL=double -DVNDF_MATH=native
}

# changes TEXT COMPILER OPTION...: with these options results change, and the headers see it.
changes() {
    refused "$@"
    shift
    accepted "$@" -DVNDF_ALLOW_FAST_MATH
}

cpp() {
    values "$@"
    refused "OpenCL devices only" "$@" -DVNDF_MATH=native
    for macro in 'VNDF_MAKE2(x,y)=mine' 'VNDF_GET2(v,i)=v[i]'; do refused "define VNDF_REAL2, too" "$@" "-D$macro"; done
    for macro in 'VNDF_MAKE3(x,y,z)=mine' 'VNDF_GET3(v,i)=v[i]'; do refused "define VNDF_REAL3, too" "$@" "-D$macro"; done
    refused "define VNDF_REAL4, too" "$@" '-DVNDF_MAKE4(x,y,z,w)=mine'
    accepted "$@" -DVNDF_ALLOW_FAST_MATH=1
    for fast in -ffast-math -Ofast; do changes -ffast-math "$@" $fast; done
    changes -ffinite-math-only "$@" -ffinite-math-only
}

gcc() {
    cpp "$@"
    for unsafe in -funsafe-math-optimizations -freciprocal-math -fno-signed-zeros \
        "-fassociative-math -fno-signed-zeros -fno-trapping-math"; do
        changes -funsafe-math-optimizations "$@" $unsafe
    done
    case $(uname -m) in
    x86_64) for unit in 387 sse,387 both; do changes FLT_EVAL_METHOD "$@" -mfpmath=$unit; done ;;
    esac
    mode=-fsyntax-only
    changes -fsingle-precision-constant "$@" -fsingle-precision-constant -DVNDF_REAL=double
    mode=-E
    accepted "$@" -fno-math-errno -fno-trapping-math -frounding-math
}

# first COMMAND...: the first of these that is installed.
first() { for command in "$@"; do command -v "$command" && break; done; }

if compiler=$(first g++ g++-14 g++-12); then
    tried=$((tried + 1))
    gcc "$compiler" -std=c++20 -w "$work/test.cpp"
fi
if compiler=$(first clang++ clang++-19 clang++-16 clang++-15 clang++-14); then
    tried=$((tried + 1))
    cpp "$compiler" -std=c++20 -w "$work/test.cpp"
fi
if compiler=$(first clang clang-19 clang-16 clang-15 clang-14); then
    tried=$((tried + 1))
    set -- "$compiler" -x cl -cl-std=CL1.2 -target spir64 -Xclang -finclude-default-header -w "$work/test.cl"
    values "$@"
    accepted "$@" -DVNDF_MATH=native
    accepted "$@" -cl-fast-relaxed-math  # measured by clvndf policies
    set -- "$compiler" -x c -std=c99 -w "$work/test.cpp"
    refused "need C++" "$@" -DVNDF_REAL3=mine '-DVNDF_GET3(v,i)=v[i]'
fi
[ $tried -gt 0 ] || { echo "no compiler" && exit 77; }
exit $status
