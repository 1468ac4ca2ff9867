#!/usr/bin/env python3
"""The preprocessed stages of the renderer hold no code of an effect of its own (kernels/render/effects.def) that is off.

    render_effects_test.py ROOT

The words of an effect stand in the programs that have it and in none that lack it: with everything on, with each effect off, and
with each effect alone. That it finds what it looks for is shown by planting each effect's code where it is off. Exit status 77
without a C preprocessor.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
CPP = shutil.which("cpp")


def effects():
    text = (ROOT / "kernels/render/effects.def").read_text()
    return {name: marks.split() for name, marks in
            re.findall(r'^VNDF_RENDER_EFFECT\((\w+), +"[^"]*", +"([^"]*)"\)', text, re.M)}


def program(kernels, off):
    """Both programs of the stages, without comments and line marks."""
    defines = [f"-DVNDF_RENDER_{name}=0" for name in off]
    return "".join(subprocess.run([CPP, "-P", "-undef", "-nostdinc", "-D__OPENCL_VERSION__=120", "-D__OPENCL_C_VERSION__=120",
                                   *defines, kernels / "render" / name], check=True, stdout=subprocess.PIPE, text=True).stdout
                   for name in ("paths.cl", "materials.cl"))


def faults(kernels, off):
    code = program(kernels, off)
    for effect, words in effects().items():
        for word in words:
            stands = re.search(rf"\b{word}\b", code) is not None
            if stands != (effect not in off):
                yield f"without {' '.join(off) or 'nothing'}: {word} {'stands' if stands else 'is missing'}"


def planted(kernels):
    """Each effect's #if made #if 1 in turn: it must be found."""
    for effect in effects():
        texts = {path: path.read_text() for path in (kernels / "render").glob("*.h")}
        for path, text in texts.items():
            path.write_text(re.sub(rf"\bVNDF_RENDER_{effect}\b", "1", text) if path.name != "effects.h" else text)
        if not list(faults(kernels, [effect])):
            yield effect
        for path, text in texts.items():
            path.write_text(text)


if not CPP:
    print("no C preprocessor")
    sys.exit(77)
every = list(effects())
bad = [fault for off in [[]] + [[name] for name in every] + [[other for other in every if other != name] for name in every]
       for fault in faults(ROOT / "kernels", off)]
print(*bad, sep="\n")
with tempfile.TemporaryDirectory() as scratch:
    copy = pathlib.Path(scratch) / "kernels"
    shutil.copytree(ROOT / "kernels", copy)
    missed = list(planted(copy))
if missed:
    print("planted and not found:", *missed)
print(f"{2 * len(every) + 1} programs")
sys.exit(bool(bad or missed))
