#!/bin/sh
# The same bits on every implementation at hand, as a table: OpenCL devices, Oclgrind, rusticl, Intel's runtime, compilers of C, C++
# and CUDA, and other processors under emulation.
#
#   everywhere.sh [--quick] PROJECT BUILD WORK [KIND...]
#
# PROJECT: the source folder; BUILD: where it is built; WORK: a folder for what is compiled and installed here. --quick: 2^12
# inputs a function on devices, too, and two compilers. KIND: devices, debian (PoCL of later releases, each in a root of its own, as
# root, with debootstrap), oclgrind, rusticl, intel, compilers, languages, processors; default: all. What is missing is skipped with a
# word; sh host/setup.sh --devices installs most.
# Exit status: 0 the same bits, 1 not, 2 wrong arguments or nothing built, 77 the same as far as could be tried.
set -u

cannot() {
    echo "everywhere.sh: $*" >&2
    exit 2
}

kinds="devices debian oclgrind rusticl intel compilers languages processors"
quick= digests=digests.txt
[ "${1-}" = --quick ] && quick=--quick digests=digests_quick.txt && shift
[ $# -ge 3 ] || cannot "usage: everywhere.sh [--quick] PROJECT BUILD WORK [KIND...]"
project=$1 build=$2 work=$3
shift 3
[ $# -gt 0 ] || set -- $kinds
clvndf=$build/clvndf tests=$project/tests
[ -f "$tests/data/$digests" ] || cannot "no $tests/data/$digests: $project is not the source folder"
[ -x "$clvndf" ] || cannot "no $clvndf: build it first (cmake --build $build --target clvndf)"
mkdir -p "$work" || exit 2
status=0

row() { echo "| $1 | $2 |"; }
skipped() {
    row "$1" "skipped: $2"
    [ $status = 1 ] || status=77
}

# judge NAME INPUTS COMMAND...: whether it prints the committed digests.
judge() {
    name=$1 inputs=$2 committed=$tests/data/digests.txt
    [ "$inputs" = 4096 ] && committed=$tests/data/digests_quick.txt
    shift 2
    if "$@" >"$work/got" 2>"$work/err" && diff "$committed" "$work/got" >"$work/diff"; then
        row "$name" "same bits, $inputs inputs a function"
    else
        row "$name" "NOT the same bits: $(grep -c '^>' "$work/diff" 2>/dev/null) functions $(head -1 "$work/err")"
        status=1
    fi
}

# script NAME SCRIPT ARGUMENT...: a script with exit statuses like ours, of 4096 inputs a function.
script() {
    name=$1
    shift
    sh "$@" >"$work/log" 2>&1
    case $? in
    0) row "$name" "same bits, 4096 inputs a function" ;;
    77)
        without=$(grep -i -m1 'skipped\|missing\|not installed' "$work/log")
        if grep -q 'same bits' "$work/log"; then
            row "$name" "same bits, 4096 inputs a function; $without" && status=$((status == 1 ? 1 : 77))
        else
            skipped "$name" "$without"
        fi
        ;;
    *) row "$name" "NOT the same bits: $(grep -m1 'failed\|NOT' "$work/log" || tail -1 "$work/log")" && status=1 ;;
    esac
}

inputs=$([ -n "$quick" ] && echo 4096 || echo 1048576)

devices() {
    "$clvndf" devices 2>/dev/null | grep -v '^ \|^$\|^rusticl' | sort -u >"$work/devices"
    [ -s "$work/devices" ] || skipped "OpenCL devices" "none"
    while read -r device; do
        version=$("$clvndf" devices | grep -A2 -xF "$device" | sed -n 's/^  driver version *//p' | head -1)
        judge "$device, $version" $inputs "$clvndf" --quiet check --digest $quick --device "${device##* / }"
    done <"$work/devices"
}

# The command is built in there, against the packages of that release.
debian() {
    for release in trixie sid; do
        root=$work/$release name="PoCL of Debian $release"
        if [ "$(id -u)" != 0 ] || ! command -v debootstrap >/dev/null; then
            skipped "$name" "no debootstrap, or not root"
            continue
        fi
        { [ -d "$root/var/lib/apt/lists" ] || debootstrap --variant=minbase "$release" "$root"; } >"$work/log" 2>&1 &&
            rm -rf "$root/clvndf" && mkdir "$root/clvndf" &&
            (cd "$project" && tar -c --exclude=./build --exclude=./.git .) | tar -x -C "$root/clvndf" &&
            inside "$root" 'apt-get -qq update
                DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install $(sh host/setup.sh --list) &&
                    cmake --preset release && cmake --build --preset release --target clvndf' >>"$work/log" 2>&1 ||
            { skipped "$name" "could not be built there: $(tail -1 "$work/log")" && continue; }
        version=$(inside "$root" 'build/release/clvndf devices' | sed -n 's/^  driver version *//p' | head -1)
        judge "$name, $version" $inputs inside "$root" "build/release/clvndf --quiet check --digest $quick"
    done
}
# inside ROOT COMMANDS: with its own mounts, which end with it.
inside() {
    unshare --mount sh -c 'mount -t proc proc "$0/proc" && mount --rbind /sys "$0/sys" && mount --rbind /dev "$0/dev" &&
        exec chroot "$0" env HOME=/root OCL_ICD_VENDORS=/etc/OpenCL/vendors sh -c "cd /clvndf && $1"' "$1" "$2"
}

oclgrind() {
    if command -v oclgrind >/dev/null; then
        judge "Oclgrind" 4096 env oclgrind "$clvndf" --quiet check --digest --quick
    else
        skipped "Oclgrind" "not installed"
    fi
}

# An hour and more where Mesa has cached nothing: its compiler takes minutes for each tilted sampler and area.
rusticl() { script "rusticl on llvmpipe" "$tests/rusticl.sh" --quick "$project" "$build"; }

# From PyPI, into WORK. Its loader is another than the system's.
intel() {
    folder=$work/intel
    [ -f "$folder/lib/libintelocl.so" ] ||
        { python3 -m venv "$folder" && "$folder/bin/pip" install -q intel-opencl-rt intel-cmplr-lib-rt tbb; } >"$work/log" 2>&1
    if [ ! -f "$folder/lib/libintelocl.so" ]; then
        skipped "Intel's runtime" "pip install intel-opencl-rt: $(tail -1 "$work/log")"
        return
    fi
    mkdir -p "$work/vendors" && echo "$folder/lib/libintelocl.so" >"$work/vendors/intel.icd"
    loader=$(ldd "$clvndf" | sed -n 's/.*libOpenCL[^ ]* => \([^ ]*\) .*/\1/p')
    version=$("$folder/bin/pip" list 2>/dev/null | sed -n 's/^intel-opencl-rt *//p')
    judge "Intel's CPU runtime $version" 4096 env OCL_ICD_VENDORS="$work/vendors" LD_LIBRARY_PATH="$folder/lib" \
        LD_PRELOAD="$loader" "$clvndf" --quiet check --digest --quick
}

compilers() {
    name="g++ and clang++, -O0 to -O3, with and without -march=native"
    set --
    [ -z "$quick" ] || { name="g++ and clang++, -O2" && set -- "g++ -O2" "clang++ -O2"; }
    script "$name" "$tests/same_bits.sh" --quick "$project" "$build" "$work/same_bits" "$@"
}

languages() { script "C99 to C17, C++11 to C++20, CUDA" "$tests/languages.sh" "$project" "$build" "$work/languages"; }

# processor NAME TRIPLET EMULATOR OPTION...
processor() {
    name=$1 triplet=$2 emulator=$3
    shift 3
    command -v "$triplet-g++" >/dev/null || { skipped "$name" "no $triplet-g++"; return; }
    command -v "$emulator" >/dev/null || { skipped "$name" "no $emulator"; return; }
    # Headers alone of what it stands on; those of this machine serve.
    (cd "$project" && "$triplet-g++" -std=c++20 -O2 -ffp-contract=off "$@" -DFMT_HEADER_ONLY -DVNDF_REAL=float \
        -DVNDF_MATH=strict -I host -I . -idirafter /usr/include tests/support/digest_host.cpp tests/support/digest_alone.cpp \
        host/registry.cpp host/runtime/host_build.cpp host/runtime/host_evaluator.cpp host/conformance/judge/digest.cpp \
        host/conformance/judge/errors.cpp host/conformance/judge/finding.cpp host/conformance/inputs/points.cpp \
        host/conformance/inputs/grids.cpp -static -pthread -o "$work/digest_$triplet") >"$work/log" 2>&1 ||
        { row "$name" "does not compile: $(grep -m1 error "$work/log")" && status=1; return; }
    judge "$name" 4096 "$emulator" "$work/digest_$triplet" --quick
}

processors() {
    processor "aarch64, emulated" aarch64-linux-gnu qemu-aarch64
    processor "riscv64, emulated" riscv64-linux-gnu qemu-riscv64
    processor "s390x (big-endian), emulated" s390x-linux-gnu qemu-s390x
    processor "ppc64le, emulated" powerpc64le-linux-gnu qemu-ppc64le
    processor "32-bit Arm, emulated" arm-linux-gnueabihf qemu-arm
    processor "i386 with SSE, emulated" i686-linux-gnu qemu-i386 -msse2 -mfpmath=sse
}

echo "| implementation | digests |"
echo "| --- | --- |"
for kind in "$@"; do
    case " $kinds " in
    *" $kind "*) $kind ;;
    *) cannot "unknown kind '$kind': $kinds" ;;
    esac
done
exit $status
