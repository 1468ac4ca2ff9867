#!/usr/bin/env python3
"""The preprocessed program of a variant holds no code of an effect that is off, nor of a value that is not chosen.

    effects_code_test.py ROOT [--full]

Reads kernels/effects.def: the words of an effect must stand in the program that has it and in none that lacks it. Each
effect alone, and all of them together, over every choice. That it finds what it looks for is shown by planting the code of
each effect in a program without it. Exit status 77 without a C preprocessor.
"""
import itertools
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
# Words of the values of a choice that has code of its own: their names in functions of the library.
VALUES = {
    "NDF": {"beckmann": ["vndf_beckmann"], "ggx": ["vndf_ggx"]},
    "SAMPLING": {"bounded": ["vndf_impl_ggx_bound"], "conic": ["c.conic"], "tilted": ["c.tilted"], "plain": []},
    "FRESNEL": {"schlick": ["vndf_fresnel_schlick", "b.f90"], "conductor": ["vndf_fresnel_conductor", "b.eta"],
                "f82": ["vndf_fresnel_f82", "b.f82"], "none": []},
    "ENERGY": {"turquin": ["vndf_impl_turquin"], "kulla_conty": ["vndf_impl_kulla_conty"], "none": []},
}


def program(folder, switches):
    """The code of a material, without comments and line marks."""
    defines = [f"-DVNDF_{name}={value}" for name, value in switches.items()]
    run = subprocess.run([CPP, "-P", "-undef", "-nostdinc", "-D__OPENCL_VERSION__=120", "-D__OPENCL_C_VERSION__=120", *defines,
                          folder / "bsdf.h"], check=True, stdout=subprocess.PIPE, text=True)
    return run.stdout


def holds(code, word):
    """As a name or a part of one at a word's beginning: `lambert` in vndf_impl_lambert, too."""
    return re.search(rf"(?<![a-z0-9]){re.escape(word)}", code) is not None


def effects():
    text = (ROOT / "kernels/effects.def").read_text()
    return {name: marks.split() for name, marks in re.findall(r'^VNDF_EFFECT\((\w+), +"[^"]*", +"([^"]*)"\)', text, re.M)}


def choices():
    text = (ROOT / "kernels/effects.def").read_text()
    return {name: values.split() for name, values in re.findall(r'^VNDF_CHOICE\((\w+), +"([^"]*)"\)', text, re.M)}


def variants():
    """Switches of every program: choices, each with everything on, each effect off, and all effects off but one lobe. Of the
    choices every value beside the defaults, with --full every combination."""
    defaults = [values[0] for values in choices().values()]
    for values in itertools.product(*choices().values()):
        chosen = dict(zip(choices(), values))
        if chosen["NDF"] == "beckmann" and chosen["SAMPLING"] != "plain":
            continue
        others = sum(value != default for value, default in zip(values, defaults)) - (chosen["NDF"] == "beckmann")
        if others > 1 and "--full" not in sys.argv:
            continue
        lobes = ["CONDUCTOR", "DIELECTRIC", "LAMBERT"]
        yield chosen
        for effect in effects():
            yield {**chosen, effect: 0}
        for lobe in lobes:
            yield {**chosen, **{effect: 0 for effect in effects() if effect != lobe}}


def faults(switches, code):
    """What stands in the program and should not, or should and does not."""
    conductor = switches.get("CONDUCTOR", 1)
    specular = conductor or switches.get("DIELECTRIC", 1)
    facets = specular or switches.get("COAT", 1)
    for effect, marks in effects().items():
        on = switches.get(effect, 1)
        needs = {"ROUGH_DIFFUSE": switches.get("LAMBERT", 1), "ANISOTROPIC": specular, "TINT": conductor, "ABSORPTION": switches.get("DIELECTRIC", 1),
                 "SPECULAR": switches.get("DIELECTRIC", 1), "THIN_WALLED": switches.get("DIELECTRIC", 1),
                 "DISPERSION": switches.get("DIELECTRIC", 1), "TERMINATOR": switches.get("SHADING_NORMAL", 1)}
        for word in marks:
            if word == "lambert" and conductor and switches["ENERGY"] == "kulla_conty":
                continue  # the cosine law draws for both
            if word == "b.transmittance":
                needs["TINT"] = switches.get("DIELECTRIC", 1)
            if holds(code, word) != bool(on and needs.get(effect, 1)):
                yield f"{effect}={on}: {word} {'stands' if holds(code, word) else 'is missing'}"
    # What glass gets back, and a thin wall as a mirror.
    glass = switches.get("DIELECTRIC", 1) and switches["ENERGY"] == "turquin"
    mirrors = (conductor and switches["ENERGY"] != "none") or (glass and switches.get("THIN_WALLED", 1))
    for word, needed in [("vndf_energy_glass", glass), ("vndf_energy_loss", mirrors)]:
        if holds(code, word) != bool(needed):
            yield f"ENERGY={switches['ENERGY']}: {word} {'stands' if holds(code, word) else 'is missing'}"
    for choice, values in VALUES.items():
        for value, words in values.items():
            for word in words:
                needed = conductor if choice in ("FRESNEL", "ENERGY") else facets
                chosen = switches[choice]
                if chosen == "tilted" and not switches.get("SHADING_NORMAL", 1):
                    chosen = "conic"
                if holds(code, word) != bool(needed and chosen == value):
                    yield f"{choice}={switches[choice]}: {word} {'stands' if holds(code, word) else 'is missing'}"


def check(folder):
    found = []
    for switches in variants():
        for fault in faults(switches, program(folder, switches)):
            found.append(f"{' '.join(f'{n}={v}' for n, v in switches.items())}: {fault}")
    return found


def planted(folder):
    """Every #if of an effect made #if 1, one at a time: each must be found."""
    missed = []
    for effect in effects():
        switches = {name: values[0] for name, values in choices().items()}
        switches[effect] = 0
        texts = {path: path.read_text() for path in folder.glob("bsdf*.h")}
        count = 0
        for path, text in texts.items():
            changed, found = re.subn(rf"^#if VNDF_{effect}$", "#if 1", text, count=0, flags=re.M)
            path.write_text(changed)
            count += found
        assert count, f"no #if VNDF_{effect} in bsdf*.h"
        if not list(faults(switches, program(folder, switches))):
            missed.append(effect)
        for path, text in texts.items():
            path.write_text(text)
    return missed


CPP = shutil.which("cpp")
if not CPP:
    print("no C preprocessor")
    sys.exit(77)
bad = check(ROOT / "kernels/vndf")
print(*bad[:20], sep="\n")
with tempfile.TemporaryDirectory() as scratch:
    copy = pathlib.Path(scratch) / "vndf"
    shutil.copytree(ROOT / "kernels/vndf", copy)
    missed = planted(copy)
if missed:
    print("planted and not found:", *missed)
print(f"{sum(1 for _ in variants())} programs")
sys.exit(bool(bad or missed))
