#!/usr/bin/env python3
"""Counts what each effect of a material costs: LLVM's instructions, and on sm_80 slots and registers. Needs no GPU.

    python3 bench/effects.py >bench/results/effects.json
    python3 bench/effects.py --minimal

Everything on, each effect off, the smallest program, each effect added to it, each choice; clvndf bench --effects prints the
counts beside the times. --minimal compares the smallest program with bench/effects/minimal.cl, the same formulas without
switches, and fails where it has more than 2 % more instructions, or where that would not be noticed of a program with one effect
too many. Needs clang; sm_80 CUDA's ptxas and libdevice, and is left out without. Exit status 77 without clang.
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
KERNELS = ("sample", "eval_pdf")


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
    yield "the same, energy turquin", {**glass, "ENERGY": "turquin"}
    for name, values in CHOICES:
        for value in values[1:]:
            if value == "tilted":  # which without a geometric normal is conic
                yield "conductor and shading_normal, sampling tilted", {**small, "SHADING_NORMAL": 1, name: value}
            else:
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
        return {name: (slots, registers) for name, slots, registers, _ in
                instructions.cuda_kernels(clang, "sm_80", "fast", text)}
    except (OSError, subprocess.CalledProcessError):
        return {}


def counts(clang, switches):
    """Of both entry points of a program."""
    instructions_, slots = llvm(clang, code(switches)), sm_80(clang, code(switches))
    result = {}
    for kernel in KERNELS:
        name = f"vndf_batch_bsdf_{kernel}"
        result[kernel] = {"llvm": instructions_[name]}
        if slots:
            result[kernel].update(zip(("sm_80_slots", "sm_80_registers"), slots[name]))
    return result


def compilers(clang):
    return instructions.compilers(clang, sm_80(clang, code(dict(variants())["conductor alone"])))


def newest_clang():
    clang = instructions.newest_clang()
    if not shutil.which(clang):
        print("no clang", file=sys.stderr)
        sys.exit(77)
    return clang


def minimal(clang):
    by_hand = llvm(clang, '#include "bench/effects/minimal.cl"\n')

    def ratios(program):
        counted = llvm(clang, code(dict(variants())[program]))
        return [counted[f"vndf_batch_bsdf_{kernel}"] / by_hand[f"vndf_batch_minimal_{kernel}"] for kernel in KERNELS]
    small, more = ratios("conductor alone"), ratios("conductor and shading_normal")
    print("smallest program over the one by hand: sample {:.3f}, eval_pdf {:.3f}".format(*small))
    print("with one effect that is not called for: sample {:.3f}, eval_pdf {:.3f}".format(*more))
    return max(small) > LIMIT or min(more) <= LIMIT


def main():
    clang = newest_clang()
    if "--minimal" in sys.argv:
        sys.exit(minimal(clang))
    found = [{"program": name, **counts(clang, switches)} for name, switches in variants()]
    print(instructions.as_json(clang, "sm_80_slots" in found[0]["sample"], found))


if __name__ == "__main__":
    main()
