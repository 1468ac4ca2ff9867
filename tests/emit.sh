#!/bin/sh
# What `clvndf emit` writes compiles without a warning in every language that it is for, with every compiler at hand, and
# computes the library's bits: by its own selftest on the CPU and on the default OpenCL device, and, all functions in one
# file, by the committed digests.
#
#   emit.sh [--quick] PROJECT BUILD WORK
#
# PROJECT: the source folder; BUILD: where it is built; WORK: a folder for what is made here. --quick: one function in
# sixteen, alone; without, every one: more than 1,000 compilations.
# Exit status: 0 all is well, 1 not, 2 wrong arguments or nothing built; 77 all is well as far as could be tried: compilers
# are missing, each named.
set -u

cannot() {
    echo "emit.sh: $*"
    exit 2
}

step=1
if [ "${1-}" = --quick ]; then
    step=16
    shift
fi
[ $# = 3 ] || cannot "usage: emit.sh [--quick] PROJECT BUILD WORK"
project=$1 build=$2 work=$3 clvndf=$2/clvndf
[ -f "$project/tests/data/digests_quick.txt" ] || cannot "no digests in $project/tests/data: it is not the source folder"
project=$(cd "$project" && pwd)
libraries="$build/host/libclvndf_host.a $build/host/reference/libclvndf_reference.a"
for file in $libraries "$clvndf"; do [ -f "$file" ] || cannot "no $file: build it first"; done
mkdir -p "$work" 2>/dev/null || cannot "$work: cannot make this folder"
warnings="-Wall -Wextra -Wunused -Werror"
strict="-ffp-contract=off -O1"
missing=0 status=0 compilations=0
PATH=$PATH:/usr/local/cuda/bin

failed() {
    echo "failed: $*"
    [ ! -f "$work/log" ] || head -20 "$work/log"
    status=1
}

have() {
    command -v "$1" >/dev/null && return
    case " $told " in *" $1 "*) ;; *) echo "skipped: $2: no $1" ;; esac
    told="$told $1"
    missing=77
    return 1
}
told=

# compiles COMMAND...: without a word.
compiles() {
    compilations=$((compilations + 1))
    "$@" >"$work/log" 2>&1 && [ ! -s "$work/log" ] || failed "$@"
}

emit() { "$clvndf" emit "$@" >"$work/log" 2>&1 || failed "clvndf emit $*"; }

opencl() {
    for standard in CL1.2 CL2.0 CL3.0; do
        for target in spir64 amdgcn nvptx64 x86_64; do
            compiles clang -x cl -cl-std=$standard -target $target -Xclang -finclude-default-header -fsyntax-only \
                $warnings "$1"
        done
    done
}

# selftest COMPILER OPTION...: the program of $work/$language answers as the library does.
selftest() {
    compiles "$@" -o "$work/selftest" -lm
    "$work/selftest" >"$work/log" 2>&1 || failed "other bits: $*"
}

main='int main(void) { int wrong[2]; vndf_selftest(wrong); return wrong[0] + wrong[1] != 0; }'

# one FUNCTION [--selftest] OPTION...: alone, in every language.
one() {
    test=
    if [ "${2-}" = --selftest ]; then test=yes; fi
    emit "$@" -o "$work/alone.cl"
    emit "$@" --as c -o "$work/alone.h"
    emit "$@" --as c++ -o "$work/alone.hpp"
    emit "$@" --as cuda -o "$work/alone.cu"
    emit "$@" --as string -o "$work/string_source.h"
    { echo '#include "alone.h"'; [ -z "$test" ] && echo 'int main(void) { return 0; }' || echo "$main"; } >"$work/alone.c"
    sed 's/alone\.h/alone.hpp/' "$work/alone.c" >"$work/alone.cpp"
    have clang "OpenCL C" && opencl "$work/alone.cl"
    for standard in c99 c11; do
        have gcc $standard && selftest gcc -std=$standard -pedantic $strict $warnings "$work/alone.c"
    done
    have clang C11 && selftest clang -std=c11 -pedantic $strict $warnings "$work/alone.c"
    for standard in c++11 c++14 c++17 c++20; do
        have g++ $standard && selftest g++ -std=$standard -pedantic $strict $warnings "$work/alone.cpp"
        have clang++ $standard && selftest clang++ -std=$standard -pedantic $strict $warnings "$work/alone.cpp"
    done
    have nvcc CUDA && compiles nvcc -arch=sm_80 -cubin -o /dev/null --Werror all-warnings "$work/alone.cu"
    [ -z "$test" ] || [ ! -x "$work/on_device" ] || "$work/on_device" "$work/alone.cl" >"$work/log" 2>&1 ||
        failed "$1 on the device"
    # The string is the file, but for the command that made it.
    if have g++ "strings"; then
        have gcc "strings in C" && compiles gcc -std=c99 -pedantic $warnings -fsyntax-only "$work/string_source.h"
        compiles g++ -std=c++17 $warnings -I "$work" "$project/tests/support/emitted_string.cpp" -o "$work/string"
        "$work/string" | sed -n '/MIT License/,$p' >"$work/string.cl"
        sed -n '/MIT License/,$p' "$work/alone.cl" | cmp -s - "$work/string.cl" || failed "$1 --as string is another text"
    fi
}

if have g++ "the device"; then
    g++ -std=c++17 -w "$project/tests/support/emitted_selftest.cpp" -o "$work/on_device" -lOpenCL >"$work/log" 2>&1 ||
        failed "emitted_selftest.cpp"
fi

# size NAME MOST CODE: bytes of the file, and without comments and empty lines.
size() {
    emit $1 -o "$work/size.cl"
    bytes=$(wc -c <"$work/size.cl") code=$(sed 's: *//.*::; /^$/d' "$work/size.cl" | wc -c)
    echo "$1: $bytes bytes, of which code $code"
    [ "$bytes" -le $2 ] && [ "$code" -le $3 ] || failed "$1: more than $2 bytes or $3 of code"
}
size vndf_ggx_sample_wm_dupuy2023 8000 4500
size vndf_ggx_sample_wm_dupuy2023_with_pdf 9000 5000

all=$("$clvndf" list | cut -d ' ' -f 1; sed -n 's/^VNDF_LOBE(\([a-z0-9_]*\),.*/\1/p' "$project/kernels/registry.def")
count=0
for function in $all; do
    count=$((count + 1))
    [ $((count % step)) = 0 ] || continue
    case $function in
    *_lobe | *_of) "$clvndf" list | grep -q "^$function " && one $function --selftest || one $function ;;
    *) one $function --selftest ;;
    esac
    # In double one of four, and in the sample none.
    [ $step = 1 ] && [ $((count % 4)) = 0 ] && one $function --selftest --real double
done
# Materials with some of their effects.
one vndf_bsdf_sample --effects conductor,tint,fresnel=f82
one vndf_bsdf_sample --effects dielectric,specular,thin_walled,lambert,rough_diffuse,coat,back_facing
if [ $step = 1 ]; then
    for effects in all lambert conductor dielectric,lambert,sampling=plain conductor,lambert,sampling=conic,fresnel=conductor \
        all,ndf=beckmann,masking=separable,fresnel=none dielectric,back_facing lambert,rough_diffuse conductor,coat lambert,coat \
        dielectric,specular dielectric,thin_walled,sampling=conic all,energy=turquin all,energy=kulla_conty,ndf=beckmann \
        conductor,energy=kulla_conty; do
        for function in vndf_bsdf_sample vndf_bsdf_eval vndf_bsdf_pdf vndf_bsdf_eval_pdf; do
            one $function --effects $effects
        done
    done
    one vndf_bsdf_transmittance --effects dielectric,absorption
fi
[ $compilations -ge 50 ] || failed "too few compilations to believe it: $compilations"

# Two files with different prefixes, types and languages' guards in one program, and nothing without its prefix.
if have g++ "two prefixes"; then
    emit ggx_sample_wi_conic2026_with_pdf ggx_g2 --as c++ --prefix one_ -o "$work/one.h"
    emit ggx_sample_wi_conic2026_with_pdf ggx_g2 --as c++ --prefix two_ --real double -o "$work/two.h"
    {
        printf '#include "one.h"\n#include "two.h"\n#include "vndf/vndf.h"\n'
        echo 'int main() { one_float2 a = {1, 1}; two_double2 b = {1, 1}; one_float3 w = {0, 0, 1}; two_double3 v = {0, 0, 1};'
        echo 'return one_ggx_g2(w, w, a) == 1 && two_ggx_g2(v, v, b) == 1 && vndf_ggx_g1({0, 0, 1}, {1, 1}) == 1 ? 0 : 1; }'
    } >"$work/both.cpp"
    compiles g++ -std=c++11 $warnings $strict -I "$project/kernels" "$work/both.cpp" -o "$work/both" && "$work/both" ||
        failed "two prefixes in one program"
    names() { g++ -std=c++11 -O0 -fkeep-inline-functions -fkeep-static-functions -c -x c++ "$1" -o "$work/names.o" &&
        nm -C --defined-only "$work/names.o" | sed 's/^[0-9a-f]* . //'; g++ -std=c++11 -E -dM -x c++ "$1" | sed 's/^#define //'; }
    printf '#include <math.h>\n#include <string.h>\n' >"$work/none.h"
    names "$work/none.h" | sort >"$work/none"
    names "$work/one.h" | sort | comm -13 "$work/none" - >"$work/leaks"
    [ "$(wc -l <"$work/leaks")" -ge 20 ] || failed "too few names to believe it"
    ! grep -vE '^(one|ONE)_' "$work/leaks" || failed "names without the prefix"
fi

# All functions in one file: the committed digests, as C and as C++.
if have g++ digests && have gcc digests; then
    for source in host/conformance/judge/digest.cpp host/conformance/inputs/points.cpp host/conformance/inputs/grids.cpp \
        tests/support/digest_host.cpp tests/support/language_host.cpp; do
        compiles g++ -std=c++20 $strict -I "$project/host" -I "$project" -c "$project/$source" \
            -o "$work/host_$(basename "$source" .cpp).o"
    done
    emit $all --as c -o "$work/all.h"
    emit $all --as c++ -o "$work/all.hpp"
    printf '#define EMITTED "%s"\n#include "%s"\n' "$work/all.h" "$project/tests/support/language_build.h" >"$work/all.c"
    sed 's/all\.h/all.hpp/' "$work/all.c" >"$work/all.cpp"
    compile_all() {
        compiles "$@" -c -o "$work/all.o"
        compiles g++ "$work"/host_*.o "$work/all.o" $libraries -lfmt -lOpenCL -pthread $cuda -o "$work/digest"
        "$work/digest" --quick 2>&1 | diff "$project/tests/data/digests_quick.txt" - >"$work/log" ||
            failed "NOT the same bits: $*"
    }
    cuda=
    compile_all gcc -std=c11 $strict $warnings "$work/all.c"
    compile_all g++ -std=c++11 $strict $warnings "$work/all.cpp"
    if have nvcc CUDA; then
        emit $all --as cuda -o "$work/all.cuh"
        sed 's/all\.h/all.cuh/' "$work/all.c" >"$work/all.cu"
        cuda="-L $(dirname "$(command -v nvcc)")/../lib64 -lcudart_static -ldl -lrt"
        compile_all nvcc -O1 -std=c++17 -Xcompiler -ffp-contract=off --Werror all-warnings "$work/all.cu"
    fi
fi

echo "$compilations compilations"
[ $status = 0 ] && exit $missing
exit $status
