#!/usr/bin/env python3
"""Counts what each effect of a material costs: LLVM's instructions, and on sm_80 slots and registers. Needs no GPU.

    python3 bench/effects.py [--check]

Prints a table: everything on, each effect off, the smallest program, each effect added to it, each choice. The smallest
program is compared with bench/effects/minimal.cl, the same formulas without switches: --check fails where it has more than
2 % more instructions, or where that would not be noticed of a program with one effect too many. Needs clang; sm_80 CUDA's ptxas and libdevice, and is left out without. Exit status 77 without clang.
"""
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import instructions  # noqa: E402

ROOT = instructions.ROOT
LIMIT = 1.02


def entries(kind):
    """The rows of kernels/effects.def: names and the first text behind them."""
    text = (ROOT / "kernels/effects.def").read_text()
    return [(n, values.split()) for n, values in re.findall(rf'^{kind}\((\w+), +"([^"]*)"', text, re.M)]


EFFECTS = [name for name, _ in entries("VNDF_EFFECT")]
CHOICES = entries("VNDF_CHOICE")


def variants():
    small = {effect: 0 for effect in EFFECTS if effect != "CONDUCTOR"}
    yield "all", {}
    for effect in EFFECTS:
        yield f"all without {effect.lower()}", {effect: 0}
    yield "conductor alone", small
    for effect in small:
        yield f"conductor and {effect.lower()}", {**small, effect: 1}
    glass = {**small, "CONDUCTOR": 0, "DIELECTRIC": 1, "BACK_FACING": 1}
    yield "glass: dielectric and back_facing", glass
    yield "the same, sampling plain", {**glass, "SAMPLING": "plain"}
    for name, values in CHOICES:
        for value in values[1:]:
            yield f"conductor alone, {name.lower()} {value}", {**small, name: value}


def code(switches):
    return "".join(f"#define VNDF_{name} {value}\n" for name, value in switches.items()) + \
        '#include "kernels/batch/bsdf.cl"\n'


def llvm(clang, text):
    """Instructions of each kernel, everything inlined."""
    ir = instructions.output(clang, "-x", "cl", "-cl-std=CL1.2", "-O3", "-w", "-Xclang", "-finclude-default-header", "-target",
                             "spir64", "-I", ROOT, "-S", "-emit-llvm", "-o", "-", "-", input=text)
    found = {}
    for name, body in re.findall(r"^define [^\n]*@(vndf_batch_\w+)\([^\n]*\{\n(.*?)^\}", ir, re.S | re.M):
        assert "call" not in "".join(line for line in body.splitlines() if "@vndf" in line), "not inlined"
        found[name] = sum(line.startswith("  ") for line in body.splitlines())
    return found


def sm_80(clang, text):
    try:
        return {name: f"{slots}, {registers}" for name, slots, registers, _ in
                instructions.cuda_kernels(clang, "sm_80", "fast", text)}
    except (OSError, subprocess.CalledProcessError):
        return {}


def main():
    clang = next(filter(shutil.which, (f"clang-{version}" for version in range(21, 13, -1))), "clang")
    if not shutil.which(clang):
        print("no clang")
        sys.exit(77)
    kernels = ("sample", "eval_pdf")
    by_hand = '#include "bench/effects/minimal.cl"\n'
    minimal = {name.replace("minimal", "bsdf"): count for name, count in llvm(clang, by_hand).items()}
    if "--check" in sys.argv:
        def ratios(program):
            counts = llvm(clang, code(dict(variants())[program]))
            return [counts[f"vndf_batch_bsdf_{kernel}"] / minimal[f"vndf_batch_bsdf_{kernel}"] for kernel in kernels]
        small, more = ratios("conductor alone"), ratios("conductor and shading_normal")
        print("smallest program over the one by hand: sample {:.3f}, eval_pdf {:.3f}".format(*small))
        print("with one effect that is not called for: sample {:.3f}, eval_pdf {:.3f}".format(*more))
        sys.exit(max(small) > LIMIT or min(more) <= LIMIT)
    print(f"{'program':42} {'LLVM sample, eval_pdf':>22} {'sm_80 sample':>14} {'sm_80 eval_pdf':>16}")
    for name, switches in [*variants(), ("by hand", None)]:
        text = by_hand if switches is None else code(switches)
        counts, slots = llvm(clang, text), sm_80(clang, text)
        own = "minimal" if switches is None else "bsdf"
        sample, value = (f"vndf_batch_{own}_{kernel}" for kernel in kernels)
        print(f"{name:42} {counts[sample]:13}, {counts[value]:7} {slots.get(sample, '-'):>14} {slots.get(value, '-'):>16}")


if __name__ == "__main__":
    main()
