# For the scripts beside it, which source it: llvm FILE writes what clang -O2 leaves of an OpenCL file, as text, without packed
# code and with loops over a constant count unrolled. Ends the script with status 77 without clang.
clang=
for candidate in clang clang-19 clang-18 clang-17 clang-16 clang-15 clang-14; do
    command -v $candidate >/dev/null && clang=$candidate && break
done
[ -n "$clang" ] || { echo "no clang" >&2 && exit 77; }

llvm() {
    $clang -x cl -cl-std=CL1.2 -target spir64 -Xclang -finclude-default-header -O2 -fno-vectorize -fno-slp-vectorize \
        -mllvm -unroll-threshold=1000000 \
        -S -emit-llvm -I kernels -o - "$1"
}
