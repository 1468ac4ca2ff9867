#!/bin/sh
# Installs what clvndf needs to build, test and run on Debian 12 or 13. Safe to repeat: when everything is
# there it only looks, needs no rights and takes no time.
#
#   sh host/setup.sh            install what is missing (as root, or through sudo)
#   sh host/setup.sh --devices  that, and the devices and compilers that only some tests use and skip without: Oclgrind,
#                               rusticl, clang, PyOpenCL, what cpack uses, compilers for other processors and their emulators,
#                               and Open MPI, with which the command is then built
#   sh host/setup.sh --list     print the package names and do nothing
#
# Exit status: 0 everything is there, 1 the installation failed, 2 unknown system or option, 3 no rights.
set -eu

packages="
    g++ cmake ninja-build pkgconf
    pocl-opencl-icd ocl-icd-libopencl1 ocl-icd-opencl-dev opencl-c-headers opencl-clhpp-headers
    librandom123-dev libboost-dev libboost-wave-dev libboost-thread-dev libcli11-dev nlohmann-json3-dev libfmt-dev
    catch2 libembree-dev libopenexr-dev libstb-dev libpng-dev libjpeg62-turbo-dev libbenchmark-dev python3-matplotlib python3-jsonschema
"

say() { echo "setup: $*" >&2; }

fail() {
    status=$1
    shift
    say "$*"
    exit "$status"
}

# One word a line, so that lists can be compared with grep.
list() { printf '%s\n' $packages; }

missing() {
    installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $packages 2>/dev/null |
        sed -n 's/^installed //p') || true
    list | while read -r package; do
        printf '%s\n' "$installed" | grep -qxF "$package" || printf '%s ' "$package"
    done
}

case "$#,${1-}" in
0,) devices= ;;
1,--devices) devices=yes ;;
1,--list) list && exit 0 ;;
*) fail 2 "unknown arguments \"$*\": allowed are none, --devices and --list" ;;
esac

system=unknown
[ -r /etc/os-release ] && system=$(. /etc/os-release && echo "${ID-unknown} ${VERSION_ID-}")
case "$system" in
"debian 12" | "debian 13") ;;
*) fail 2 "this script knows Debian 12 and 13, not \"${system% }\"; install by hand what your system calls" $packages ;;
esac

# rusticl's kernel library is that of the LLVM that Mesa was built with; Debian 13 has no Oclgrind.
if [ -n "$devices" ]; then
    packages="$packages clang mesa-opencl-icd python3-pyopencl python3-venv dpkg-dev file qemu-user debootstrap libopenmpi-dev openmpi-bin"
    packages="$packages g++-aarch64-linux-gnu g++-riscv64-linux-gnu g++-s390x-linux-gnu g++-powerpc64le-linux-gnu"
    packages="$packages g++-arm-linux-gnueabihf g++-i686-linux-gnu"
    [ "$system" = "debian 12" ] && packages="$packages libclc-15 oclgrind" || packages="$packages libclc-19"
fi

missing=$(missing)
if [ -z "$missing" ]; then
    say "everything is there"
    exit 0
fi
say "missing: $missing"

if [ "$(id -u)" = 0 ]; then
    as_root=
elif command -v sudo >/dev/null; then
    as_root=sudo
else
    fail 3 "neither root nor sudo; as root, run: apt-get install $missing"
fi

# Waits for another apt to finish, asks nothing and never reads the caller's input.
apt() {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@" </dev/null
}

apt update || say "apt-get update failed; going on with the package lists at hand"
apt install -y --no-install-recommends $missing || fail 1 "apt-get could not install: $missing"

missing=$(missing)
[ -z "$missing" ] || fail 1 "still missing after apt-get: $missing"
say "done"
