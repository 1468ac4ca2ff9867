#!/usr/bin/env python3
"""Counts instructions, registers and spills of every sampler, its lean forms and its listing on GPUs. Needs no GPU.

    python3 bench/instructions.py >bench/results/instructions.json

All need clang; sm_80 CUDA's ptxas and libdevice, gfx900 and gfx1030 rocm-device-libs, on Debian 12 with clang-15 or
clang-19. A target whose tools are missing is left out; exit status 77 if none is left.
"""
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CUDA = pathlib.Path(shutil.which("ptxas") or "/usr/local/cuda/bin/ptxas").resolve().parent.parent
FORMS = {form: f'#include "{source}"' for form, source in (
    ("strict", "kernels/batch/batch.cl"), ("lean", "bench/lean/batch.cl"), ("factored", "bench/lean/factored.cl"),
    ("published", "bench/published/batch.cl"))}
# What every kernel does around its sampler, and four additions that keep the loads.
FORMS["copy"] = """
    #include "kernels/batch/entry_point.h"
    #include "kernels/vndf/impl/shim.h"
    VNDF_FN float3 copy(float3 wo, float2 alpha, float2 u) {
        return VNDF_MAKE3(wo.x + alpha.x, wo.y + alpha.y, wo.z + (u.x + u.y));
    }
    VNDF_ENTRY_POINT(vndf_batch_copy_40B, copy, WO_ALPHA_U, WM)"""
# Division and square root correctly rounded or not. All fast math for the listings alone, which have nothing to lose.
DIVISIONS = {"ieee": ["-cl-fp32-correctly-rounded-divide-sqrt"], "fast": [], "fast-math": ["-cl-fast-relaxed-math"]}
CUDA_DIVISIONS = {  # as nvcc has them by default, with --prec-div=false --prec-sqrt=false, and with --use_fast_math
    "ieee": ["-mllvm", "-nvptx-prec-divf32=2"],
    "fast": ["-mllvm", "-nvptx-prec-divf32=1", "-mllvm", "-nvptx-prec-sqrtf32=0"],
    "fast-math": ["-mllvm", "-nvptx-prec-divf32=0", "-Xclang", "-fdenormal-fp-math-f32=preserve-sign,preserve-sign"],
}


def output(*command, **options):
    return subprocess.run([*map(str, command)], check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def newest_clang():
    return next(filter(shutil.which, (f"clang-{version}" for version in range(21, 13, -1))), "clang")


def as_json(clang, with_ptxas, entries):
    """What was counted, an entry a line, and by which compilers."""
    lines = ",\n".join("    " + json.dumps(entry) for entry in entries)
    return f'{{\n  "compilers": {json.dumps(compilers(clang, with_ptxas))},\n  "entries": [\n{lines}\n  ]\n}}'


def compilers(clang, with_ptxas):
    found = [output(clang, "--version").split("\n")[0]]
    if with_ptxas:
        found.append("ptxas " + re.search(r"V[\d.]+", output(CUDA / "bin/ptxas", "--version"))[0])
    return found


def compiled(clang, code, *options):
    """The assembly of OpenCL C."""
    return output(clang, "-x", "cl", "-cl-std=CL1.2", "-O3", "-Xclang", "-finclude-default-header", "-I", ROOT, "-I",
                  ROOT / "kernels", *options, "-S", "-o", "-", "-", input=code)


def text_sections(cubin):
    """Name and contents of the code of each function of a 64-bit ELF file."""
    (table,), (size, count, names) = struct.unpack_from("<Q", cubin, 40), struct.unpack_from("<HHH", cubin, 58)
    headers = [struct.unpack_from("<IIQQQQ", cubin, table + i * size) for i in range(count)]
    for name, _, _, _, offset, length in headers:
        begin = headers[names][4] + name
        name = cubin[begin:cubin.index(b"\0", begin)].decode()
        if name.startswith(".text."):
            yield name.removeprefix(".text."), cubin[offset:offset + length]


def cuda_kernels(clang, target, division, code):
    """Slots of 16 bytes, subroutines of the function included, without the NOPs behind it."""
    device = ["-target", "nvptx64-nvidia-nvcl"]
    for option in ("-target-cpu", target, "-target-feature", "+ptx72", "-mlink-builtin-bitcode",
                   CUDA / "nvvm/libdevice/libdevice.10.bc"):
        device += ["-Xclang", option]
    ptx = compiled(clang, f'#include "bench/libdevice.h"\n{code}', *device, *DIVISIONS[division],
                   *CUDA_DIVISIONS[division])
    if division != "ieee":
        ptx = ptx.replace("sqrt.rn", "sqrt.approx")  # LLVM's switch acts on 1 / sqrt alone
    assert "call" not in ptx, "a function that is not inlined is not counted"
    with tempfile.TemporaryDirectory() as folder:
        cubin = pathlib.Path(folder) / "cubin"
        said = output(CUDA / "bin/ptxas", "-v", f"-arch={target}", "-o", cubin, "-", input=ptx,
                      stderr=subprocess.STDOUT)
        sections = dict(text_sections(cubin.read_bytes()))
    for name, spills, registers in re.findall(
            r"Compiling entry function '(\w+)'.*?(\d+) bytes spill stores.*?Used (\d+) registers", said, re.S):
        slots = struct.iter_unpack("<QQ", sections[name])
        yield name, sum(low & 0xfff != 0x918 for low, _ in slots), int(registers), int(spills)


def amd_kernels(clang, target, division, code):
    """Instructions as written, of 4, 8 or 12 bytes each; vector registers."""
    debian = [f"--rocm-device-lib-path={path}" for path in pathlib.Path("/usr/lib").glob("*/amdgcn/bitcode")]
    text = compiled(clang, code, "-target", "amdgcn-amd-amdhsa", f"-mcpu={target}", *debian, *DIVISIONS[division])
    assert "_swappc_" not in text, "a function that is not inlined is not counted"
    for name, body in re.findall(r"^(vndf_batch_\w+):(.*?)^\.Lfunc_end", text, re.S | re.M):
        about = text[text.index(f"\n    .name:           {name}\n"):]
        spilled, registers = (int(re.search(rf"\.vgpr_{what}: *(\d+)", about)[1]) for what in ("spill_count", "count"))
        body = body.partition("\t.section")[0]
        yield name, len(re.findall(r"^\t[a-z]\w+", body, re.M)), registers, 4 * spilled


TARGETS = {"sm_80": cuda_kernels, "gfx900": amd_kernels, "gfx1030": amd_kernels}


def entries(clang, target):
    for form, code in FORMS.items():
        for division in DIVISIONS if form == "published" else ("ieee", "fast"):
            for name, instructions, registers, spills in sorted(TARGETS[target](clang, target, division, code)):
                name = name.removeprefix("vndf_batch_")
                if re.search("(ggx|beckmann)_sample_", name) or form == "copy":
                    yield {"function": name, "form": form, "target": target, "division": division,
                           "instructions": instructions, "registers": registers, "spills": spills}


def main():
    clang = newest_clang()
    found = []
    for target, kernels in TARGETS.items():
        try:
            list(kernels(clang, target, "ieee", FORMS["copy"]))
        except (OSError, subprocess.CalledProcessError) as error:
            reason = error if isinstance(error, OSError) else f"{error.cmd[0]} cannot compile for it"
            print(f"{target} is left out: {reason}", file=sys.stderr)
        else:
            found += entries(clang, target)
    if not found:
        print("no clang with ptxas or rocm-device-libs", file=sys.stderr)
        sys.exit(77)
    print(as_json(clang, found[0]["target"].startswith("sm_"), found))


if __name__ == "__main__":
    main()
