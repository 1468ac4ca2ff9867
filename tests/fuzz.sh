#!/bin/sh
# Runs the glTF reader on a million inputs under libFuzzer and the sanitizers of addresses and undefined behaviour. Needs clang++.
#
#   fuzz.sh PROJECT BUILD [RUNS]
#
# BUILD is a folder of its own, kept with what was found so far. The seeds are the tests' small files and, where CLVNDF_SCENES
# names a folder, the small ones of its scenes. Exit status: 0 nothing was found, 2 wrong arguments, 77 no clang++, others: something was.
set -eu

cannot() {
    echo "fuzz.sh: $*" >&2
    exit 2
}
[ $# = 2 ] || [ $# = 3 ] || cannot "usage: fuzz.sh PROJECT BUILD [RUNS]"
project=$1 build=$2 runs=${3-1000000}
[ -f "$project/tests/gltf/fuzz/gltf_fuzz.cpp" ] || cannot "$project is not the source folder"
command -v clang++ >/dev/null || { echo "fuzz.sh: no clang++"; exit 77; }

longest=16384
mkdir -p "$build"
cmake -S "$project" -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None -DCLVNDF_FUZZ=ON >"$build.log" 2>&1 ||
    { cat "$build.log"; exit 1; }
cmake --build "$build" --target gltf_fuzz gltf_seeds -j "$(nproc)" >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
mkdir -p "$build/corpus" "$build/seeds"
"$build/gltf_seeds" "$build/seeds"
if [ -n "${CLVNDF_SCENES-}" ]; then
    find "$CLVNDF_SCENES" \( -name '*.gltf' -o -name '*.glb' \) -size "-${longest}c" -exec cp {} "$build/seeds" \;
    chmod u+w "$build/seeds"/*
fi
exec nice -n 10 "$build/gltf_fuzz" "$build/corpus" "$build/seeds" -dict="$project/tests/gltf/fuzz/gltf.dict" \
    -max_len=$longest -timeout=5 -rss_limit_mb=1024 -runs="$runs" -print_final_stats=1 -artifact_prefix="$build/"
