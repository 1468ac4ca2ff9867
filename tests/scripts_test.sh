#!/bin/sh
# A script that has nothing to judge says what is missing and exits with 2: with another status it would seem to have
# found other bits, or to lack only what it may lack.
#
#   scripts_test.sh PROJECT BUILD       BUILD: where it is built
set -u
project=$1 build=$2
tests=$project/tests
empty=$(mktemp -d) || exit 1
trap 'rm -rf "$empty"' EXIT
status=0

# cannot TEXT SCRIPT ARGUMENT...: exits with 2 and says TEXT, in one line.
cannot() {
    text=$1
    shift
    said=$(sh "$@" 2>&1)
    got=$?
    case $said in
    *"
"*) ;;
    *"$text"*) [ $got = 2 ] && return ;;
    esac
    echo "not status 2 with \"$text\" but $got with \"$said\": $*"
    status=1
}

for script in oclgrind.sh "rusticl.sh --quick" "same_bits.sh --quick" "packages.sh --quick"; do
    cannot "usage: ${script%% *}" "$tests"/$script
    cannot "usage: ${script%% *}" "$tests"/$script "$project"
    cannot "$empty is not the source folder" "$tests"/$script "$empty" "$build" $(case $script in same* | pack*) echo "$empty/work" ;; esac)
done
cannot "no $empty/clvndf: build it first" "$tests/oclgrind.sh" "$project" "$empty"
ln -s "$build/clvndf" "$empty/clvndf"
cannot "no $empty/clvndf_tests: build it first" "$tests/oclgrind.sh" "$project" "$empty"
rm "$empty/clvndf"
cannot "no $empty/clvndf: build it first" "$tests/packages.sh" "$project" "$empty" "$empty/work"
cannot "no $empty/clvndf: build it first" "$tests/rusticl.sh" "$project" "$empty"
cannot "no function nosuch" "$tests/rusticl.sh" "$project" "$build" nosuch
cannot "usage: ranks.sh" "$tests/ranks.sh" "$build"
cannot "no $empty/clvndf: build it first" "$tests/ranks.sh" "$empty" "$empty/work" hosts
cannot "'both': hosts and speed are what there is" "$tests/ranks.sh" "$build" "$empty/work" both
cannot "usage: fuzz.sh" "$tests/fuzz.sh" "$project"
cannot "$empty is not the source folder" "$tests/fuzz.sh" "$empty" "$empty/work"
cannot "usage: fast_math.sh" "$tests/fast_math.sh" --quick
cannot "$empty is not the source folder" "$tests/fast_math.sh" "$empty" "$build" "$empty/work"
cannot "no $empty/host/libclvndf_host.a: build it first" "$tests/fast_math.sh" "$project" "$empty" "$empty/work"
cannot "no $empty/host/libclvndf_host.a: build it first" "$tests/same_bits.sh" "$project" "$empty" "$empty/work"
: >"$empty/file"
cannot "$empty/file/work: cannot make this folder" "$tests/packages.sh" "$project" "$build" "$empty/file/work"
cannot "$empty/file/work: cannot make this folder" "$tests/same_bits.sh" "$project" "$build" "$empty/file/work"
for script in kernels/names_test.sh kernels/opencl_lint_test.sh kernels/switches_test.sh; do
    cannot "no headers in" "$tests/$script"
    cannot "no headers in '$empty/vndf'" "$tests/$script" "$empty"
done
exit $status
