#!/bin/sh
# The headers never collide: every macro, function, variable and type they define begins with vndf_ or VNDF_.
# Needs g++, whatever compiler the project is built with: it alone can emit static functions that nobody calls.
# Exits with 77 (skipped) where there is none.
#
#   names_test.sh KERNELS_DIR [HEADER]      HEADER: one more header (absolute path), read as if it were included
set -eu
kernels=$1 extra=${2-}
command -v g++ >/dev/null || { echo "no g++" && exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

compile() { g++ -std=c++20 -ffp-contract=off -I "$kernels" "$@"; }

macros() { compile -E -dM "$1" | sed 's/^#define \([A-Za-z_0-9]*\).*/\1/' | sort -u; }

symbols() {
    compile -O0 -fkeep-inline-functions -fkeep-static-functions -c -o "$work/object.o" "$1"
    nm -C --defined-only "$work/object.o" | sed 's/^[0-9a-f]* . //; s/(.*//' | sort -u
}

# The lines of $2 that are not in $1: at least $3 of them, and all with the prefix.
judge() {
    comm -13 "$1" "$2" >"$2.new"
    [ "$(wc -l <"$2.new")" -ge "$3" ] || { echo "$4: too few found to believe it" && status=1; }
    if foreign=$(grep -vE '^(vndf|VNDF)_' "$2.new"); then
        echo "$4 without the prefix:" $foreign
        status=1
    fi
}

printf '#include <cmath>\n#include <cstdint>\n#include <cstring>\n' >"$work/base.cpp"
macros "$work/base.cpp" >"$work/base.macros"
symbols "$work/base.cpp" >"$work/base.symbols"
for real in float double; do
    {
        printf '#define VNDF_REAL %s\n#include "vndf/vndf.h"\n' $real
        [ -z "$extra" ] || printf '#include "%s"\n' "$extra"
    } >"$work/$real.cpp"
    macros "$work/$real.cpp" >"$work/$real.macros"
    symbols "$work/$real.cpp" >"$work/$real.symbols"
    judge "$work/base.macros" "$work/$real.macros" 30 "$real: macros"
    judge "$work/base.symbols" "$work/$real.symbols" 50 "$real: functions or variables"
done

: >"$work/none"
cat "$kernels"/vndf/*.h "$kernels"/vndf/impl/*.h $extra | sed 's://.*::' |
    sed -nE 's/^ *(typedef .*[ *]|(struct|union|enum|class|namespace|using) +)([A-Za-z_0-9]+) *[;{=].*/\3/p' |
    sort -u >"$work/types"
judge "$work/none" "$work/types" 3 "types"
exit $status
