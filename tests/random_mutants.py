#!/usr/bin/env python3
"""Random operator mutants of the kernel headers: does the check notice them?

    random_mutants.py --build BUILD --work WORK [--seed N] [--count N] [--files PATTERN...] [--full]
                      [--again INDEX...]

BUILD: a built build folder (its libraries and clvndf_tests are used); WORK: a folder for what is compiled and for
results.jsonl, a line for each mutant. A run that was interrupted goes on where it ended; --count N goes on to N mutants
in all; --again judges the mutants of these numbers anew. The same seed and files make the same mutants. --list prints
them and does no more; --show prints the survivors in WORK with their diffs. --files takes names below kernels/vndf,
with * and ?.

A mutant changes one thing: + - * / < <= > >= && || ! min max sin cos, a number by an ulp or a digit, a term of an fma or
its sign, the sign of an operand, the choices of ?:, an x for a y. It is judged in steps, each only if the one before has
not caught it:

  1. the host build of the headers, in strict float, strict double and builtin float: few points of `clvndf check`'s
     pointwise comparison, for the functions whose results change there;
  2. the same with all points of the full check;
  3. the quick check of the functions that change, on the device, with its statistics (clvndf_tests "a mutant from
     outside"); with --full the full one as well.

"builds not" is a mutant that a compiler refuses; "same bits" one that changes no result at any of these points. They and
what survives are to be explained, or the check taught to see them.
Needs g++ and what BUILD is linked with. One process at a time.
"""
import argparse
import difflib
import fnmatch
import json
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess

project = pathlib.Path(__file__).resolve().parent.parent
headers = project / "kernels/vndf"

SWAPS = {}
for a, b in [("alpha_x", "alpha_y"), ("rcp_x", "rcp_y"), ("ex", "ey"), ("gx", "gy"), ("hx", "hy"), ("ox", "oy"),
             ("kx", "ky"), ("x", "y"), ("y", "z"), ("u1", "u2"), ("p", "q"), ("sqrt_p", "sqrt_q"), ("wo", "wi"),
             ("wo", "wm"), ("low", "high"), ("sine", "z"), ("r", "l"), ("p1", "p2"), ("head", "tail"),
             ("vndf_impl_min", "vndf_impl_max"), ("vndf_impl_circle_sin", "vndf_impl_circle_cos")]:
    SWAPS.setdefault(a, []).append(b)
    SWAPS.setdefault(b, []).append(a)

COMPARED = {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="], "!=": ["=="],
            "&&": ["||"], "||": ["&&"]}
ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*"}


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"[^\"\n]*\"", blank, text, flags=re.S)


def code_only(text):
    """The text with everything blank that is no code."""
    return re.sub(r"^[ \t]*#[^\n]*", blank, without_comments(text), flags=re.M)


def arguments(text, at):
    """The end of the call whose '(' is at text[at], and its arguments."""
    depth, start, found = 0, at + 1, []
    for i in range(at, len(text)):
        if text[i] == "(":
            depth += 1
        elif text[i] == ")":
            depth -= 1
            if depth == 0:
                return i + 1, found + [text[start:i].strip()]
        elif text[i] == "," and depth == 1:
            found.append(text[start:i].strip())
            start = i + 1
    return None, []


def next_float(literal, up):
    bits = struct.unpack("<i", struct.pack("<f", float(literal)))[0] + (1 if up else -1)
    return repr(struct.unpack("<f", struct.pack("<i", bits))[0])


def other_number(rng, literal):
    value = float(literal)
    if value == 0:
        return rng.choice(["1.0", "1e-6"])
    if rng.random() < 0.1:
        return next_float(literal, rng.random() < 0.5)
    if value == int(value) and abs(value) < 100:
        return repr(value + rng.choice([-1, 1]))
    digits = [i for i, c in enumerate(re.split("[eE]", literal)[0]) if c.isdigit()]
    while len(digits) > 1 and literal[digits[0]] == "0":
        digits.pop(0)
    at = rng.choice(digits[:8])
    return literal[:at] + rng.choice([d for d in "0123456789" if d != literal[at]]) + literal[at + 1:]


def sites(text):
    """Where a mutant can be made, by kind: (begin, end, choices of what stands there instead)."""
    code, found = code_only(text), {}

    def add(kind, begin, end, choices):
        found.setdefault(kind, []).append((begin, end, choices))

    for m in re.finditer(r"(?<=[\w)\]] )([-+*/])(?= [\w(-])", code):
        add("arithmetic", m.start(), m.end(), [ARITHMETIC[m.group()]])
    for m in re.finditer(r"(?<= )(<=|>=|==|!=|<|>|&&|\|\|)(?= )", code):
        add("comparison", m.start(), m.end(), COMPARED[m.group()])
    for m in re.finditer(r"(?<![\w.])(\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+)(?![\w.])", without_comments(text)):
        add("number", m.start(), m.end(), None)
    for m in re.finditer(r"(?<!\w)[A-Za-z_]\w*", code):
        if m.group() in SWAPS and not re.match(r"\s*\(", code[m.end():]) or m.group().startswith("vndf_impl_m") and \
                m.group() in SWAPS or m.group().startswith("vndf_impl_circle") and m.group() in SWAPS:
            before = code[max(0, m.start() - 12):m.start()]
            if not re.search(r"(VNDF_REAL\w*|VNDF_FN|struct|,|int) $", before) or before.endswith(", "):
                add("name", m.start(), m.end(), SWAPS[m.group()])
    for m in re.finditer(r"VNDF_FMA(?=\()", code):
        end, args = arguments(code, m.end())
        if end and len(args) == 3 and "\n" not in "".join(args):
            a, b, c = args
            add("fma", m.start(), end, [f"(({a}) * ({b}))", f"({c})", f"VNDF_FMA(-({a}), {b}, {c})",
                                        f"VNDF_FMA({a}, {b}, -({c}))"])
    for m in re.finditer(r"(?:(?<=[(=?:*] )|(?<=\()|(?<=, ))(-?)(?=[a-z]\w*(\.\w+)?\b(?!\())", code):
        if not re.search(r"(VNDF_FN|struct|#define)[^\n;{]*$", code[:m.start()].rsplit("\n", 1)[-1]):
            add("sign", m.start(), m.end(), ["" if m.group() else "-"])
    for m in re.finditer(r"(?<!\w)(!?[a-z]\w*(?:\.\w+)?) \? ", code):
        add("choice", m.start(), m.end(), [f"!{m.group(1)} ? ".replace("!!", "")])
    for m in re.finditer(r"(vndf_impl_abs|VNDF_SQRT|vndf_impl_square|vndf_impl_finite)(?=\()", code):
        add("function", m.start(), m.end(), [""])
    return found


def mutant(seed, index, files):
    """Number `index`: a file, a place and what stands there instead; the same for the same arguments."""
    rng = random.Random(f"{seed}/{index}")
    while True:
        file = rng.choices(list(files), weights=[len(f["code"]) for f in files.values()])[0]
        kinds = files[file]["sites"]
        kind = rng.choice(sorted(kinds))
        begin, end, choices = rng.choice(kinds[kind])
        old = files[file]["text"][begin:end]
        new = other_number(rng, old) if choices is None else rng.choice(choices)
        if new != old:
            return {"index": index, "file": file, "kind": kind, "begin": begin, "end": end, "old": old, "new": new}


def changed_text(text, m):
    return text[:m["begin"]] + m["new"] + text[m["end"]:]


def diff(text, m):
    lines = difflib.unified_diff(text.splitlines(), changed_text(text, m).splitlines(), m["file"], m["file"],
                                 lineterm="", n=0)
    return "\n".join(list(lines)[2:])


def unique_context(text, begin, end):
    """The place with so much in front of it that it is found once."""
    start = begin
    while text.count(text[start:end]) != 1 or start == end:
        if start == 0:
            return None
        start -= 1
    return start


class BuildsNot(Exception):
    pass


class Bench:
    """The changed headers, compiled and judged."""

    builds = [("float", "strict"), ("double", "strict"), ("float", "builtin")]
    few, many = ("1024", "97"), ("65536", "1")  # random points, stride of the hard ones: part of the check, and all

    def __init__(self, build, work):
        self.build, self.work = build, work
        self.tree = work / "tree"
        shutil.rmtree(self.tree, ignore_errors=True)
        shutil.copytree(project / "kernels", self.tree / "kernels")
        (self.tree / "host/runtime").mkdir(parents=True)
        for name in ("host_build.cpp", "host_build.h"):
            shutil.copy(project / "host/runtime" / name, self.tree / "host/runtime")
        self.main = work / "mutant_host.o"
        self.compile(project / "tests/support/mutant_host.cpp", self.main, "float", "strict")
        for real, math in self.builds:
            self.link(real, math)
            for points in (self.few, self.many):
                command = [work / "mutant_host", real, math, *points]
                self.hashes(real, math, points).write_text(self.output(command))

    def hashes(self, real, math, points):
        return self.work / f"hashes_{real}_{math}_{points[0]}.txt"

    def compile(self, source, target, real, math):
        command = ["g++", "-std=c++20", "-O0", "-ffp-contract=off", "-w", f"-DVNDF_REAL={real}", f"-DVNDF_MATH={math}",
                   f"-I{project}", f"-I{project}/host", "-c", source, "-o", target]
        if subprocess.run(command, stderr=subprocess.DEVNULL).returncode:
            raise BuildsNot

    def link(self, real, math):
        self.compile(self.tree / "host/runtime/host_build.cpp", self.work / "host_build.o", real, math)
        subprocess.run(["g++", self.main, self.work / "host_build.o", self.build / "host/libclvndf_host.a",
                        self.build / "host/reference/libclvndf_reference.a", "-lfmt", "-lOpenCL", "-pthread", "-o",
                        self.work / "mutant_host"], check=True)

    @staticmethod
    def output(command, **more):
        return subprocess.run(command, check=True, capture_output=True, text=True, timeout=1800, **more).stdout

    def on_host(self, real, math, points):
        out = self.output([self.work / "mutant_host", real, math, *points, self.hashes(real, math, points)])
        lines = out.splitlines()
        caught = [line[7:] for line in lines if line.startswith("caught ")]
        return [line[8:] for line in lines if line.startswith("changed ")], caught[0] if caught else None

    def on_device(self, m, text, functions, real, math, quick):
        start = unique_context(text, m["begin"], m["end"])
        if start is None:
            return None
        task = self.work / "task.json"
        task.write_text(json.dumps({
            "file": m["file"], "old_text": text[start:m["end"]], "new_text": text[start:m["begin"]] + m["new"],
            "functions": functions, "real": real, "math": math, "quick": quick}))
        cache = self.work / "pocl_cache"
        shutil.rmtree(cache, ignore_errors=True)
        cache.mkdir()
        out = subprocess.run([self.build / "clvndf_tests", "a mutant from outside"], capture_output=True, text=True,
                             env=dict(os.environ, CLVNDF_MUTANT=str(task), POCL_CACHE_DIR=str(cache))).stdout
        caught = re.search(r"^caught (.*)$", out, re.M)
        if not caught and "survived" not in out:
            return "not judged on the device: " + out[-300:]
        return caught.group(1) if caught else None

    def judge(self, m, text, full):
        target = self.tree / "kernels/vndf" / m["file"]
        target.write_text(changed_text(text, m))
        try:
            return self.verdict(m, text, full)
        except BuildsNot:
            return {"verdict": "builds not"}
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as ended:
            return {"verdict": "caught", "by": f"its end: {ended}"}
        finally:
            target.write_text(text)

    def verdict(self, m, text, full):
        survived = {}
        for points in (self.few, self.many):
            for real, math in self.builds:
                self.link(real, math)
                changed, caught = self.on_host(real, math, points)
                if caught:
                    return {"verdict": "caught", "by": f"{math} {real}, {points[0]} points: {caught}"}
                if changed:
                    survived[real, math] = changed
        return self.device_verdict(m, text, survived, full) if survived else {"verdict": "same bits"}

    def device_verdict(self, m, text, survived, full):
        for (real, math), changed in survived.items():
            for quick in [True, False] if full else [True]:
                caught = self.on_device(m, text, changed, real, math, quick)
                if caught:
                    return {"verdict": "caught", "by": f"{math} {real}, {'quick' if quick else 'full'} check: {caught}"}
        return {"verdict": "survived", "build": ", ".join(f"{math} {real}" for real, math in survived),
                "changed": sorted(set().union(*survived.values()))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--files", nargs="+", default=["*.h"])
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--again", nargs="+", type=int, default=[], metavar="INDEX", help="judge these anew")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--show", action="store_true")
    options = parser.parse_args()

    files = {}
    for path in sorted(headers.rglob("*.h")):
        name = path.relative_to(headers).as_posix()
        if any(fnmatch.fnmatch(name, pattern) for pattern in options.files):
            text = path.read_text()
            found = sites(text)
            if found:
                files[name] = {"text": text, "code": re.sub(r"\s", "", code_only(text)), "sites": found}
    mutants, seen, index = [], set(), 0
    while len(mutants) < options.count:
        m = mutant(options.seed, index, files)
        index += 1
        if (m["file"], m["begin"], m["new"]) not in seen:
            seen.add((m["file"], m["begin"], m["new"]))
            mutants.append(m)
    if options.list:
        for m in mutants:
            print(f"#{m['index']} {m['file']} ({m['kind']})\n{diff(files[m['file']]['text'], m)}")
        return

    options.work.mkdir(parents=True, exist_ok=True)
    results = options.work / "results.jsonl"
    done = {}
    for line in results.read_text().splitlines() if results.exists() else []:
        result = json.loads(line)
        done[result["index"]] = result  # the last one counts
    if not options.show:
        bench = Bench(options.build.resolve(), options.work.resolve())
        with results.open("a") as log:
            for m in mutants:
                text = files[m["file"]]["text"]
                if m["index"] in done and m["index"] not in options.again:
                    continue
                done[m["index"]] = dict(m, **bench.judge(m, text, options.full), diff=diff(text, m))
                log.write(json.dumps(done[m["index"]]) + "\n")
                log.flush()
                print(f"#{m['index']} {m['file']}: {done[m['index']]['verdict']}", flush=True)

    counts = {}
    for m in mutants:
        if m["index"] in done:
            result = done[m["index"]]
            counts[result["verdict"]] = counts.get(result["verdict"], 0) + 1
            if result["verdict"] in ("survived", "same bits"):
                print(f"\n#{m['index']} {m['file']} ({m['kind']}): {result['verdict']} {result.get('build', '')}\n"
                      f"{result['diff']}\n{' '.join(result.get('changed', []))}")
    print("\n" + ", ".join(f"{verdict} {count}" for verdict, count in sorted(counts.items())))


if __name__ == "__main__":
    main()
