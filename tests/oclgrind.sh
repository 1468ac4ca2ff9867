#!/bin/sh
# Every batch kernel under Oclgrind, which watches each access to memory: no invalid access, no data race, nothing
# uninitialised read; and the same bits there.
#
#   oclgrind.sh PROJECT BUILD
#
# Exit status: 0 clean, 1 not, 77 without Oclgrind.
set -u
project=$1 build=$2
command -v oclgrind >/dev/null || { echo "oclgrind is not installed"; exit 77; }
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT

fail() {
    echo "oclgrind: $*"
    exit 1
}

# watched TAG: the tests of this tag under Oclgrind; what it has to say goes to $log.
watched() {
    oclgrind --data-races --uninitialized --max-errors 100 --log "$log" "$build/clvndf_tests" "$1"
}

watched "[tail]" || fail "results differ"
[ ! -s "$log" ] || { cat "$log"; fail "errors"; }

watched "[.planted]"
grep -q "Invalid write" "$log" && grep -q "data race" "$log" || { cat "$log"; fail "the planted mistakes were not seen"; }

oclgrind "$build/clvndf" check --digest --quick | diff "$project/tests/data/digests_quick.txt" - || fail "other digests"
echo "clean, same bits"
