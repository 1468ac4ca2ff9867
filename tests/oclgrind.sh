#!/bin/sh
# Every batch kernel under Oclgrind, which watches each access to memory: no invalid access, no data race, nothing
# uninitialised read; and the same bits there.
#
#   oclgrind.sh PROJECT BUILD
#
# Exit status: 0 clean, 1 not, 2 nothing to run: wrong arguments or nothing built; 77 without Oclgrind.
set -u

cannot() {
    echo "oclgrind.sh: $*"
    exit 2
}

[ $# = 2 ] || cannot "usage: oclgrind.sh PROJECT BUILD"
project=$1 build=$2
digests=$project/tests/data/digests_quick.txt
[ -f "$digests" ] || cannot "no $digests: $project is not the source folder"
for program in clvndf clvndf_tests; do
    [ -x "$build/$program" ] || cannot "no $build/$program: build it first (cmake --build $build --target $program)"
done
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

watched "[tail]" || fail "the tests [tail] failed (status $?): other results, or they could not run; see above"
[ ! -s "$log" ] || { cat "$log"; fail "errors"; }

watched "[.planted]"
grep -q "Invalid write" "$log" && grep -q "data race" "$log" || { cat "$log"; fail "the planted mistakes were not seen"; }

got=$(oclgrind "$build/clvndf" check --digest --quick) || fail "clvndf check --digest failed (status $?)"
echo "$got" | diff "$digests" - || fail "other digests"
echo "clean, same bits"
