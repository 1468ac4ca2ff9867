#!/bin/sh
# The headers never collide: every macro, function, variable and type they define begins with vndf_ or VNDF_, and no other
# name in them is one that headers of others define as a macro (support/foreign_names.txt).
# Needs g++, whatever compiler the project is built with: it alone can emit static functions that nobody calls.
# Exits with 77 (skipped) where there is none.
#
#   names_test.sh KERNELS_DIR [HEADER]      HEADER: one more header (absolute path), read as if it were included
set -eu
kernels=${1-} extra=${2-}
[ -f "$kernels/vndf/vndf.h" ] || { echo "names_test.sh: no headers in '$kernels/vndf'" && exit 2; }
others=$(dirname "$0")/../support/foreign_names.txt
headers=$(find "$kernels/vndf" -name "*.h")
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

printf '#include <float.h>\n#include <math.h>\n#include <string.h>\n' >"$work/base.cpp"
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
cat $headers $extra | sed 's://.*::' |
    sed -nE 's/^ *(typedef .*[ *]|(struct|union|enum|class|namespace|using) +)([A-Za-z_0-9]+) *[;{=].*/\3/p' |
    sort -u >"$work/types"
judge "$work/none" "$work/types" 3 "types"

# Each name in the headers, comments and strings apart; as name() where a parenthesis follows.
cat $headers $extra | sed 's://.*::; s/"[^"]*"//g' | grep -oE '[A-Za-z_0-9]+ *\(?' |
    sed 's/ *($/()/; s/ *$//' | grep -E '^[A-Za-z_]' | sort -u >"$work/used"
grep -v "^#" "$others" | tr -s ' ' '\n' | sort -u >"$work/others"
[ "$(wc -l <"$work/used")" -ge 500 ] && [ "$(wc -l <"$work/others")" -ge 300 ] ||
    { echo "names: too few found to believe it" && status=1; }

# name() is also a use of the name.
collisions=$({ cat "$work/used"; sed -n 's/()$//p' "$work/used"; } | sort -u | comm -12 - "$work/others")
[ -z "$collisions" ] || { echo "names that others define as macros:" $collisions && status=1; }

# All macros with capitals are kept out at once. The exceptions are words of pragmas, parameters of macros, and what the
# implementation defines.
if capitals=$(sed 's/()$//' "$work/used" | grep '[A-Z]' |
    grep -vE '^(VNDF_.*|_.*|OPENCL|EXTENSION|FP_CONTRACT|OFF|FIRST|NEXT|FLT_EVAL_METHOD)$'); then
    echo "names with capitals:" $capitals
    status=1
fi

# And the proof: the headers compile where each of those macros, and each single capital, is defined, as rubbish.
{
    cat "$work/base.cpp"
    sed -n 's/()$/(...)/p' "$work/others" | sed 's/^/#define /; s/$/ ]/'
    { grep -v '()' "$work/others"; printf '%s\n' A B C D E F G H I J K L M N O P Q R S T U V W X Y Z; } |
        sed 's/^/#define /; s/$/ ]/'
} >"$work/rubbish.h"
for real in float double; do
    compile -fno-operator-names -w -fsyntax-only -include "$work/rubbish.h" "$work/$real.cpp" 2>"$work/errors" || {
        echo "$real: does not compile among the macros of others"
        grep -m 3 error "$work/errors" || true
        status=1
    }
done
exit $status
