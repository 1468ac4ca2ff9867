#!/bin/sh
# The headers never collide: every macro, function, variable and type that they define begins with vndf_ or VNDF_.
#
#   names_test.sh CXX KERNELS_DIR [HEADER]      HEADER: one more header, read as if it were part of vndf.h
set -eu
cxx=$1 kernels=$2 extra=${3-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

# Prints the names on stdin that lack the prefix, and remembers that there were any.
reject() {
    if foreign=$(grep -vE '^(vndf|VNDF)_'); then
        echo "$1 without the prefix:" $foreign
        return 1
    fi
}

printf '#include <cmath>\n#include <cstdint>\n#include <cstring>\n' >"$work/base.cpp"
for real in float double; do
    {
        printf '#define VNDF_REAL %s\n' $real
        cat "$work/base.cpp"
        echo '#include "vndf/vndf.h"'
        [ -z "$extra" ] || printf '#include "%s"\n' "$extra"
    } >"$work/$real.cpp"
    compile="$cxx -std=c++20 -ffp-contract=off -I $kernels"

    for file in base $real; do
        $compile -E -dM "$work/$file.cpp" | sed 's/^#define \([A-Za-z_0-9]*\).*/\1/' | sort >"$work/$file.macros"
    done
    comm -13 "$work/base.macros" "$work/$real.macros" >"$work/macros"
    [ "$(wc -l <"$work/macros")" -gt 20 ] || { echo "$real: hardly a macro found" && status=1; }
    reject "$real: macros" <"$work/macros" || status=1

    # Local symbols are the headers' own; the standard library's inline functions are weak.
    $compile -O0 -fkeep-inline-functions -fkeep-static-functions -c -o "$work/$real.o" "$work/$real.cpp"
    nm -C --defined-only "$work/$real.o" |
        sed -n 's/^[0-9a-f]* [a-zA-VX-Z] \([A-Za-z_0-9:]*\).*/\1/p' | grep -vE '^(std::|_GLOBAL__|__static_init)' | sort -u >"$work/symbols"
    [ "$(wc -l <"$work/symbols")" -gt 50 ] || { echo "$real: hardly a function found" && status=1; }
    reject "$real: functions or variables" <"$work/symbols" || status=1
done

cat "$kernels"/vndf/*.h $extra | sed 's://.*::' |
    sed -nE 's/^ *(typedef .*[ *]|(struct|union|enum|class|namespace|using) +)([A-Za-z_0-9]+).*/\3/p' |
    reject "types" || status=1
exit $status
