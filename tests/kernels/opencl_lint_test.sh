#!/bin/sh
# The headers compile without a warning as OpenCL C of several versions, for GPU targets that this machine lacks,
# in every real type and math policy. Exits with 77 (skipped) where there is no clang.
#
#   opencl_lint_test.sh KERNELS_DIR
set -eu
kernels=${1-}
[ -f "$kernels/vndf/vndf.h" ] || { echo "opencl_lint_test.sh: no headers in '$kernels/vndf'" && exit 2; }
clang=
for candidate in clang clang-19 clang-18 clang-17 clang-16 clang-15 clang-14; do
    command -v $candidate >/dev/null && clang=$candidate && break
done
[ -n "$clang" ] || { echo "no clang" && exit 77; }

for target in spir spir64 amdgcn nvptx64; do  # spir: addresses of 32 bits
    for standard in CL1.2 CL3.0; do
        for real in float double; do
            for math in strict builtin native; do
                [ $real-$math != double-native ] || continue  # config.h refuses it: switches_test.sh
                echo '#include "vndf/vndf.h"' |
                    $clang -x cl -cl-std=$standard -target $target -Xclang -finclude-default-header \
                        -fsyntax-only -Wall -Wextra -Wno-unused-function -Werror -I "$kernels" \
                        -D VNDF_REAL=$real -D VNDF_MATH=$math - || {
                    echo "failed: $clang -cl-std=$standard -target $target $real $math"
                    exit 1
                }
            done
        done
    done
done
