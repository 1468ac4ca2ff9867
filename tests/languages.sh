#!/bin/sh
# The headers in every language that they can be in, with every compiler at hand: compiled without a warning, and, where it
# can run here, with the bits of the committed digests.
#
#   languages.sh PROJECT BUILD WORK
#
# PROJECT: the source folder; BUILD: where it is built; WORK: a folder for what is compiled here.
# Exit status: 0 all is well, 1 not, 2 wrong arguments or nothing built; 77 all is well as far as could be tried: compilers
# are missing, each named.
set -u

cannot() {
    echo "languages.sh: $*"
    exit 2
}

[ $# = 3 ] || cannot "usage: languages.sh PROJECT BUILD WORK"
project=$1 build=$2 work=$3
committed=$project/tests/data/digests_quick.txt
libraries="$build/host/libclvndf_host.a $build/host/reference/libclvndf_reference.a"
[ -f "$committed" ] || cannot "no $committed: $project is not the source folder"
project=$(cd "$project" && pwd)  # files of WORK include what is there
for library in $libraries; do
    [ -f "$library" ] || cannot "no $library: build it first (cmake --build $build --target clvndf)"
done
mkdir -p "$work" 2>/dev/null || cannot "$work: cannot make this folder"
strict="-I $project/kernels -ffp-contract=off"
warnings="-Wall -Wextra -Werror"
missing=0 status=0 more=

failed() {
    echo "failed: $*"
    head -20 "$work/log"
    status=1
}

# have COMMAND WHAT: whether there is one; says so if not.
have() {
    command -v "$1" >/dev/null && return
    echo "skipped: $2: no $1"
    missing=77
    return 1
}

# compiles COMMAND...: without a word.
compiles() {
    "$@" >"$work/log" 2>&1 && [ ! -s "$work/log" ] || failed "$@"
}

# The part that is C++ whatever the headers are in.
host() {
    for source in host/conformance/judge/digest.cpp host/conformance/inputs/points.cpp host/conformance/inputs/grids.cpp \
        tests/support/digest_host.cpp tests/support/language_host.cpp; do
        g++ -std=c++20 -O1 -ffp-contract=off -I "$project/host" -I "$project" -c "$project/$source" \
            -o "$work/host_$(basename "$source" .cpp).o" >"$work/log" 2>&1 || failed "$source"
    done
}

# same_bits NAME COMPILER OPTION...: as that language.
same_bits() {
    name=$1
    shift
    if ! "$@" -c "$work/language.$name" -o "$work/language.o" >"$work/log" 2>&1 || [ -s "$work/log" ]; then
        failed "$@"
    elif ! g++ "$work"/host_*.o "$work/language.o" $libraries -lfmt -lOpenCL -pthread $more -o "$work/digest_language" \
        >"$work/log" 2>&1; then
        failed "linking $*"
    elif "$work/digest_language" --quick 2>&1 | diff "$committed" - >"$work/log"; then
        echo "same bits: $*"
    else
        failed "NOT the same bits: $*"
    fi
}

for extension in c cpp cu; do echo "#include \"$project/tests/support/language_build.h\"" >"$work/language.$extension"; done
echo '#include "vndf/vndf.h"' >"$work/headers.h"
cp "$work/headers.h" "$work/headers.cl"

have g++ "bits" && host

# C and C++. nvcc compiles the functions for the CPU as well.
for standard in c99 c11 c17; do
    have gcc $standard && same_bits c gcc -std=$standard -pedantic -O2 $strict $warnings
    have clang $standard && same_bits c clang -std=$standard -pedantic -O1 $strict $warnings
done
for standard in c++11 c++14 c++17 c++20; do
    have g++ $standard && same_bits cpp g++ -std=$standard -pedantic -O2 $strict $warnings
    have clang++ $standard && same_bits cpp clang++ -std=$standard -pedantic -O1 $strict $warnings
done
PATH=$PATH:/usr/local/cuda/bin
if have nvcc CUDA; then
    cuda="nvcc -I $project/kernels -Xcompiler -ffp-contract=off -Xcompiler -Wall --Werror all-warnings"
    more="-L $(dirname "$(command -v nvcc)")/../lib64 -lcudart_static -ldl -lrt"
    same_bits cu $cuda -O2 -std=c++17
    if nvidia-smi -L >/dev/null 2>&1; then
        same_bits cu $cuda -O2 -std=c++17 -arch=native --fmad=false -DON_GPU
    else
        echo "skipped: CUDA on a GPU: no GPU"
    fi
    for real in float double; do
        for math in strict builtin; do
            compiles $cuda -D VNDF_REAL=$real -D VNDF_MATH=$math -x cu --cubin -o /dev/null -arch=sm_80 --fmad=false \
                "$project/tests/support/cuda_kernels.cu"
        done
    done
fi

# Types and policies that have no digest.
for real in float double; do
    for math in strict builtin; do
        switches="-D VNDF_REAL=$real -D VNDF_MATH=$math"
        have gcc "C" && compiles gcc -x c -std=c99 -pedantic -Wdouble-promotion $warnings $strict $switches \
            -fsyntax-only "$work/headers.h"
        have g++ "C++11" && compiles g++ -x c++ -std=c++11 -pedantic -Wdouble-promotion $warnings $strict $switches \
            -fsyntax-only "$work/headers.h"
    done
done

# Vector types of a user's own, each alone and together: the same results.
types() {
    $1 -std=c++11 -O1 $strict $warnings -Wno-unused-function -DOWN=$2 -DTYPES=$3 "$project/tests/support/vector_types.cpp" \
        -o "$work/vector_types" >"$work/log" 2>&1 && "$work/vector_types"
}
if have g++ "vector types" && types g++ 0 0 >"$work/plain"; then
    for own in 1 2 3; do
        for which in 1 2 3 4 5 6 7; do
            types g++ $own $which | cmp -s - "$work/plain" || failed "vector types: -DOWN=$own -DTYPES=$which"
        done
    done
fi

# float and double in one program, linked as one.
one_program() {
    for real in float double; do
        "$@" -D VNDF_REAL=$real -D NAME=part_$real $strict $warnings -O2 -flto -c "$project/tests/support/two_reals.cpp" \
            -o "$work/two_$real.o" >"$work/log" 2>&1 || failed "$@" $real
    done
    "$@" -O2 -flto -Wodr -Werror -D MAIN "$project/tests/support/two_reals.cpp" "$work/two_float.o" "$work/two_double.o" \
        -o "$work/two_reals" >"$work/log" 2>&1 && [ ! -s "$work/log" ] && "$work/two_reals" >"$work/log" ||
        failed "float and double in one program: $*"
}
have g++ "float and double in one program" && one_program g++ -std=c++17

# OpenCL: what opencl_lint_test.sh does not have.
if have clang "C++ for OpenCL"; then
    for standard in CL2.0 clc++; do
        for target in spir64 amdgcn nvptx64 x86_64; do
            for real in float double; do
                compiles clang -x cl -cl-std=$standard -target $target -Xclang -finclude-default-header -fsyntax-only \
                    $warnings -Wno-unused-function -I "$project/kernels" -D VNDF_REAL=$real "$work/headers.cl"
            done
        done
    done
    # No product and sum of ours is contracted, and the one of the program around is.
    printf '%s\n' '#include "vndf/vndf.h"' 'kernel void k(global float* x, float a, float b) {' \
        'float3 m = vndf_ggx_sample_wm_dupuy2023((float3)(x[0], x[1], x[2]), (float2)(a, b), (float2)(x[3], x[4]));' \
        'x[0] = m.x + m.y + m.z; x[1] = x[5] * a + b; }' >"$work/contraction.cl"
    for target in spir64 amdgcn nvptx64 x86_64; do
        contracted=$(clang -x cl -cl-std=CL1.2 -target $target -Xclang -finclude-default-header -O1 -S -emit-llvm \
            -I "$project/kernels" -o - "$work/contraction.cl" 2>"$work/log" | grep -c '= .*call.*llvm.fmuladd')
        [ "$contracted" = 1 ] || failed "$target: $contracted products and sums contracted, not 1"
    done
    # CUDA and HIP as clang reads them, without their headers; and NVRTC by what it defines.
    for real in float double; do
        compiles clang -x cuda --cuda-gpu-arch=sm_70 --cuda-device-only -nocudainc -nocudalib -fsyntax-only \
            -I "$project/kernels" -include "$project/tests/support/cuda_words.h" -D VNDF_REAL=$real $warnings \
            -D __CUDACC_RTC__ -Wno-unused-function -Wno-unknown-cuda-version "$work/headers.h"
        compiles clang -x hip --offload-arch=gfx900 --cuda-device-only -nogpuinc -nogpulib -fsyntax-only \
            -I "$project/kernels" -include "$project/tests/support/cuda_words.h" -D VNDF_REAL=$real $warnings \
            -D __HIPCC_RTC__ -Wno-unused-function "$work/headers.h"
    done
fi

# NVRTC itself, where its library is.
if nvrtc=$(ls /usr/local/cuda/lib64/libnvrtc.so 2>/dev/null) && command -v g++ >/dev/null; then
    g++ -std=c++17 -I /usr/local/cuda/include "$project/tests/support/nvrtc.cpp" -o "$work/nvrtc" -L "${nvrtc%/*}" \
        -Wl,-rpath,"${nvrtc%/*}" -lnvrtc >"$work/log" 2>&1 || failed "nvrtc.cpp"
    for real in float double; do
        compiles "$work/nvrtc" "$project/tests/support/cuda_kernels.cu" -I"$project/kernels" -DVNDF_REAL=$real \
            --gpu-architecture=compute_80 --fmad=false
    done
else
    echo "skipped: NVRTC: no /usr/local/cuda/lib64/libnvrtc.so"
    missing=77
fi

[ $status = 0 ] && exit $missing
exit $status
