#!/bin/sh
# Counts what clang -O2 leaves of functions that compute from common terms, beside the separate calls that they stand for
# (calls.cl), and of the README's OpenCL example: instructions of the intermediate language, loads and stores included,
# square roots and divisions.
#
#   sh bench/calls.sh
#
# Exit status: 77 without clang.
set -eu
cd "$(dirname "$0")/.."
clang=
for candidate in clang clang-19 clang-18 clang-17 clang-16 clang-15 clang-14; do
    command -v $candidate >/dev/null && clang=$candidate && break
done
[ -n "$clang" ] || { echo "no clang" >&2 && exit 77; }

echo "name instructions roots divisions"
for source in bench/calls.cl tests/embedding/metal.cl; do
    $clang -x cl -cl-std=CL1.2 -target spir64 -Xclang -finclude-default-header -O2 -fno-vectorize -fno-slp-vectorize \
        -S -emit-llvm -I kernels -o - $source
done | awk '/^define/ { name = $0; sub(/.*@/, "", name); sub(/\(.*/, "", name); next }
            /^}/ { name = "" }
            name ~ /^vndf_calls_|^sample_|_(eval_pdf|both|weight)$/ && /^  / {
                all[name]++
                root[name] += /call.*sqrt/
                quotient[name] += / = fdiv /
            }
            END { for (name in all) print name, all[name], root[name], quotient[name] }' | LC_ALL=C sort
