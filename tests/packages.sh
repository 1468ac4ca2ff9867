#!/bin/sh
# What is installed serves a program as host/examples show it: with CMake, pkg-config and Python, wherever the folder is
# moved; and, without --quick, as a Debian package on a bare system and by pip.
#
#   packages.sh [--quick] PROJECT BUILD WORK
#
# PROJECT: the source folder; BUILD: where it is built; WORK: a folder for what is made here. The bare system (as root,
# with debootstrap) is made in WORK/bare, of the release that this one is.
# Exit status: 0 all is well, 1 not, 2 wrong arguments or nothing built; 77 all is well as far as could be tried: what
# is missing is named.
set -u

cannot() {
    echo "packages.sh: $*"
    exit 2
}

quick=
if [ "${1-}" = --quick ]; then
    quick=yes
    shift
fi
[ $# = 3 ] || cannot "usage: packages.sh [--quick] PROJECT BUILD WORK"
project=$1 build=$2 work=$3 examples=$1/host/examples
[ -d "$examples" ] || cannot "no $examples: $project is not the source folder"
[ -x "$build/clvndf" ] || cannot "no $build/clvndf: build it first"
rm -rf "$work/first" "$work/moved" "$work/python" "$work/build"
mkdir -p "$work" 2>/dev/null || cannot "$work: cannot make this folder"
missing=0 status=0
[ -f /etc/OpenCL/vendors/pocl.icd ] && export OCL_ICD_VENDORS=/etc/OpenCL/vendors/pocl.icd

failed() {
    echo "failed: $*"
    [ ! -f "$work/log" ] || tail -20 "$work/log"
    status=1
}

skipped() {
    echo "skipped: $*"
    missing=77
}

have() { command -v "$1" >/dev/null || { skipped "$2: no $1"; return 1; }; }

# well COMMAND...: exits with 0; what it says is shown where it does not.
well() { "$@" >"$work/log" 2>&1 || failed "$@"; }

# says TEXT COMMAND...: exits with 0 and says TEXT.
says() {
    text=$1
    shift
    well "$@"
    grep -qF -e "$text" "$work/log" || failed "no \"$text\": $*"
}

prefix=$work/moved version=$(sed -n 's/^project(clvndf VERSION \([0-9.]*\).*/\1/p' "$project/CMakeLists.txt")
installed() {
    well cmake --install "$build" --prefix "$work/first"
    mv "$work/first" "$prefix"
    [ "$status" = 0 ] || exit 1
    for file in bin/clvndf include/vndf/vndf.h include/vndf/impl/shim.h include/clvndf/sources.h share/doc/clvndf/copyright \
        share/cmake/clvndf/clvndf-config.cmake share/cmake/clvndf/clvndf-config-version.cmake \
        share/pkgconfig/clvndf.pc share/man/man1/clvndf.1 share/bash-completion/completions/clvndf; do
        [ -f "$prefix/$file" ] || failed "not installed: $file"
    done
    for folder in "$work/first" "$build" "$project"; do
        grep -rlF "$folder" "$prefix/include" "$prefix/share" >"$work/log" && failed "names $folder, so cannot be moved"
    done
    commands=$("$prefix/bin/clvndf" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p')
    [ -n "$commands" ] || failed "clvndf --help names no command"
    for command in $commands; do
        grep -qE "^\.(B|BI) \"?$command\b" "$prefix/share/man/man1/clvndf.1" || failed "the manual page lacks $command"
        bash -c 'PATH=$1/bin:$PATH; . "$1/share/bash-completion/completions/clvndf"
            COMP_WORDS=(clvndf "$2") COMP_CWORD=1; _clvndf; [ "${COMPREPLY[*]}" = "$2" ]' - "$prefix" "$command" ||
            failed "bash does not complete $command"
    done
    grep -qF "CLVNDF_VERSION \"$version\"" "$prefix/include/clvndf/sources.h" ||
        failed "clvndf/sources.h has another version"
}

cmake_examples() {
    have cmake CMake && have ninja CMake || return
    well cmake -G Ninja -S "$examples" -B "$work/build" -D CMAKE_PREFIX_PATH="$prefix" -D CMAKE_CXX_STANDARD=11 \
        -D CMAKE_CXX_EXTENSIONS=OFF -D CMAKE_CXX_FLAGS="-Werror -Wall -Wextra"
    well cmake --build "$work/build" -j2
    says "reflected: " "$work/build/loop"
    says "reflected: " "$work/build/mirror"
    says "0 of the strict object" "$work/build/strict"
    mkdir -p "$work/version"
    for wish in 0.1 0.2 1; do
        printf 'cmake_minimum_required(VERSION 3.16)\nproject(p LANGUAGES NONE)\nfind_package(clvndf %s REQUIRED)\n' \
            $wish >"$work/version/CMakeLists.txt"
        cmake -S "$work/version" -B "$work/version/build" -D CMAKE_PREFIX_PATH="$prefix" >"$work/log" 2>&1
        [ $? = 0 ] && found=yes || found=no
        [ $wish = 0.1 ] && wanted=yes || wanted=no
        [ $found = $wanted ] || failed "find_package(clvndf $wish): found: $found"
    done
}

pkg_config_examples() {
    have pkg-config pkg-config && have gcc C || return
    export PKG_CONFIG_PATH="$prefix/share/pkgconfig"
    flags="-Wall -Wextra -Werror -pedantic"
    well gcc -std=c99 $flags "$examples/mirror.c" $(pkg-config --cflags --libs clvndf OpenCL) -o "$work/mirror_c"
    says "reflected: " "$work/mirror_c"
    # An example that cannot fail shows nothing.
    for change in 's/0\.5f, 0\.1f/0.6f, 0.1f/' 's/vndf_ggx_weight(/0.99f * &/'; do
        sed "$change" "$examples/loop.cpp" >"$work/changed.cpp"
        well g++ -std=c++11 $flags "$work/changed.cpp" $(pkg-config --cflags --libs clvndf) -o "$work/changed"
        "$work/changed" >"$work/log" && failed "loop.cpp with $change is not noticed"
    done
}

# python_examples PYTHON: with the package where that finds it.
python_examples() {
    well "$1" "$project/tests/packages/python_test.py" "$build/clvndf"
    if "$1" -c "import pyopencl" 2>/dev/null; then
        says "reflected: " "$1" "$examples/mirror.py"
    else
        skipped "mirror.py: $1 has no pyopencl"
    fi
}

python_component() {
    python=
    for candidate in ${CLVNDF_PYTHON3-} /usr/bin/python3 python3; do
        [ -n "$python" ] || ! "$candidate" -c "import numpy" 2>/dev/null || python=$candidate
    done
    [ -n "$python" ] || { skipped "Python: no python3 with numpy"; return; }
    well cmake --install "$build" --component python --prefix "$work/python"
    export PYTHONPATH="$work/python" PYTHONDONTWRITEBYTECODE=1
    python_examples "$python"
    unset PYTHONPATH
}

# With cpack, and on a bare system of this release as root.
debian_package() {
    for tool in cpack dpkg-shlibdeps file; do have $tool "the Debian package" || return; done
    rm -rf "$work/deb"
    well cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work/deb"
    package=$(ls "$work"/deb/clvndf_*.deb)
    says "ocl-icd-libopencl1" dpkg-deb --field "$package" Depends
    says "./usr/share/doc/clvndf/copyright" dpkg-deb --contents "$package"
    [ "$(id -u)" = 0 ] || { skipped "a bare system: not root"; return; }
    have debootstrap "a bare system" || return
    bare=$work/bare
    trap 'umount "$bare/proc" "$bare/sys" "$bare/dev" 2>/dev/null' EXIT
    [ -f "$bare/etc/debian_version" ] ||
        well debootstrap --variant=minbase "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$bare"
    # PoCL asks /sys for processors and memory.
    if ! mount -t proc proc "$bare/proc" || ! mount -t sysfs sys "$bare/sys" || ! mount --bind /dev "$bare/dev"; then
        skipped "a bare system: no mounts"
        return
    fi
    cp "$package" "$bare/clvndf.deb"
    cp -r "$examples" "$bare/"
    cp /etc/resolv.conf "$bare/etc/"
    on_bare() {
        chroot "$bare" env -u OCL_ICD_VENDORS DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"
    }
    well on_bare apt-get -q update
    well on_bare apt-get -qy install --reinstall --no-install-recommends /clvndf.deb pocl-opencl-icd
    says "clvndf $version" on_bare clvndf --version
    says "vndf_ggx_g1(" on_bare clvndf emit ggx_g1
    says "pass" on_bare clvndf check --quick --only vndf_reflect
    well on_bare apt-get -qy install --no-install-recommends g++ cmake make pkgconf ocl-icd-opencl-dev \
        opencl-clhpp-headers
    well on_bare sh -c 'gcc /examples/mirror.c $(pkg-config --cflags --libs clvndf OpenCL) -o /mirror'
    says "reflected: " on_bare /mirror
    well on_bare cmake -S /examples -B /build
    well on_bare cmake --build /build
    for example in loop mirror strict; do well on_bare /build/$example; done
}

# In an environment of its own, from the package index.
pip_package() {
    [ -n "${python-}" ] || { skipped "pip: no python3"; return; }
    rm -rf "$work/venv"
    if ! "$python" -m venv "$work/venv" >"$work/log" 2>&1 ||
        ! "$work/venv/bin/pip" install -q numpy scikit-build-core >"$work/log" 2>&1; then
        skipped "pip: no venv, or no package index"
        return
    fi
    well "$work/venv/bin/pip" install --no-build-isolation "$project/host/python"
    "$work/venv/bin/pip" install -q pyopencl >"$work/log" 2>&1
    python_examples "$work/venv/bin/python"
}

installed
cmake_examples
pkg_config_examples
python_component
for file in "$examples"/*.*; do
    [ "$(wc -l <"$file")" -le 60 ] || failed "$file has more than 60 lines"
done
if [ -z "$quick" ]; then
    debian_package
    pip_package
fi
[ $status = 0 ] && exit $missing
exit $status
