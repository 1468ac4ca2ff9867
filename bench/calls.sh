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
. bench/llvm.sh

echo "name instructions roots divisions"
for source in bench/calls.cl tests/embedding/metal.cl; do
    llvm $source
done | awk '/^define/ { name = $0; sub(/.*@/, "", name); sub(/\(.*/, "", name); next }
            /^}/ { name = "" }
            name ~ /^vndf_calls_|^sample_|_(eval_pdf|both|weight)$/ && /^  / {
                all[name]++
                root[name] += /call.*sqrt/
                quotient[name] += / = fdiv /
            }
            END { for (name in all) print name, all[name], root[name], quotient[name] }' | LC_ALL=C sort
