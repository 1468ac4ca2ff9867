#!/usr/bin/env python3
"""Makes what the documentation takes from elsewhere, or checks that it is so.

    python3 tests/docs.py BUILD            rewrites it
    python3 tests/docs.py --check BUILD    fails, with a line for each difference, if that would change anything

BUILD holds the command `clvndf`. In every README.md:

    <!-- file: PATH -->     the code block that follows shows the file
    <!-- table: NAME -->    what follows, up to <!-- end -->, is that table
    ```console              lines that begin with "$ " are commands; their output follows

In the headers, a line `// Accuracy:` above a function of the registry states its bounds.
"""
import collections
import functools
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "bench/results/pocl-3.1.json"
H100 = ROOT / "bench/results/nvidia-h100.json"
INSTRUCTIONS = ROOT / "bench/results/instructions.json"
CALLS = ROOT / "bench/results/calls.txt"
TILTS = ROOT / "bench/results/tilts.txt"
PEERS = ROOT / "bench/results/peers-mitsuba-3.9.json"
EMBREE = ROOT / "bench/results/peers-embree-3.13.json"
REFRACTION = ROOT / "bench/results/refraction.json"
MITSUBA_BSDF = ROOT / "bench/results/peers-mitsuba-bsdf-3.9.json"
MITSUBA_RENDER = ROOT / "bench/results/peers-mitsuba-render-3.9.json"
POWER = ROOT / "tests/data/power.json"
MITSUBA_GLTF = ROOT / "bench/results/peers-mitsuba-gltf-3.9.json"


# --- The registry ---

@functools.cache
def registry(build):
    return json.loads(subprocess.run([build / "clvndf", "list", "--json"], check=True, stdout=subprocess.PIPE).stdout)


def number(value):
    return "" if value is None else f"{value:g}"


def table(head, rows):
    return "".join("| " + " | ".join(cells) + " |\n" for cells in [head, ["---"] * len(head), *rows])


def call(function):
    return f"`{function['name']}({function['signature']})`"


def samplers(build):
    for f in registry(build):
        if f["kind"] != "sampler" or f["name"].endswith("_with_pdf"):
            continue
        error = ["–".join(filter(None, [number(bounds["front"])])) + ", " + (number(bounds["back"]) or "–")
                 for bounds in (f["bounds"]["float"], f["bounds"]["double"])]
        yield call(f), f"`{f['density']}`", f["method"], f["domain"], *error, f["source"]


def lobes(build):
    for f in registry(build):
        if f["kind"] == "lobe":
            yield call(f), f"`{f['type']}`", f["source"]


def others(build):
    for f in registry(build):
        if f["kind"] not in ("sampler", "lobe"):
            of = f["kind"] + (f", {f['support']}" if "support" in f else "")
            yield call(f), of, *(number(f["bounds"][real]["error"]) for real in ("float", "double")), f["source"]


def accuracy(function):
    """The sentence of a header, without its full stop."""
    single, double = function["bounds"]["float"], function["bounds"]["double"]
    if function["kind"] == "sampler":
        what = "published" if function["method"] == "approximate" else "exact"
        back = [f", {number(b['back'])} behind the surface" if b["back"] else "" for b in (single, double)]
        return (f"angle to the {what} map, 99th percentile: {number(single['front'])} eps (1 + condition number)"
                f"{back[0]}; double {number(double['front'])}{back[1].replace(' behind the surface', '')}")
    percentile = ", 99th percentile" if function["kind"] == "inverse" or function["unit"].startswith("eps (|") else ""
    return f"{number(single['error'])} {function['unit']}{percentile}; double {number(double['error'])}"


def with_accuracy(text, build):
    """The header with the sentence above each registered function, and those that have none."""
    of = {f["name"]: accuracy(f) for f in registry(build) if "bounds" in f}
    lines, missing = text.split("\n"), []
    for i, line in enumerate(lines):
        found = re.match(r"VNDF_FN \w+ (vndf_(?!impl_)\w+)\(", line)
        if not found or found[1] not in of or found[1].endswith("_with_pdf"):
            continue
        begin = i
        while begin > 0 and lines[begin - 1].startswith("//"):
            begin -= 1
        at = [k for k in range(begin, i) if lines[k].startswith("// Accuracy:")]
        if len(at) != 1:
            missing.append(found[1])
            continue
        lines[at[0]] = f"// Accuracy: {of[found[1]]}."
    return "\n".join(lines), missing


# --- The committed run of the benchmark ---

@functools.cache
def bench():
    sys.path.insert(0, str(ROOT / "bench/report"))
    import report  # needs matplotlib
    return report, report.Bench(RESULTS)


def ns(value):
    return "" if value is None else f"{value:.0f}" if value >= 99.95 else f"{value:.1f}"


def times(forms, visible_alone=False):
    _, run = bench()
    for sampler in run.samplers():
        if visible_alone and "walter2007" in sampler:
            continue
        errors = [run.counter(f"{sampler}/{policy}/float/stream", "err_p99") for policy in ("strict", "published")]
        yield (f"`{sampler.removeprefix('vndf_')}`", *(ns(run.ns(sampler, *form)) for form in forms),
               *("" if e is None else f"{e:.2g}" for e in errors))


def gains():
    report, run = bench()
    lights = ("white light", "smooth light", report.SMALL, "smooth light, Sobol")
    for alpha in ((0.1, 0.1), (0.5, 0.5), (1, 1), (2, 2), (0.2, 0.8), (0.3, 0.9), (0.05, 1)):
        at = [lobe for cosine in (0.9, 0.5, 0.2) for lobe in run.lobes
              if (lobe["alpha_x"], lobe["alpha_y"], lobe["cos_theta"]) == (*alpha, cosine)]
        conic = [lobe for lobe in at if lobe["sampler"].endswith("conic2026")]
        lost = [lobe["rejected"] for lobe in at if lobe["sampler"] == report.BOUNDED]
        yield (f"{alpha[0]:g}, {alpha[1]:g}", ", ".join(f"{100 * part:.0f} %" for part in lost),
               *(", ".join(f"{report.gain(run, lobe, light, 100):.{2 if light == report.SMALL else 1}f}" for lobe in conic)
                 for light in lights))


def steps(run, sampler, figure):
    """The figure of each step of accuracy, "lean; factored; ours", where there is one."""
    entries = [run.best.get(f"{sampler}/{step}/cached") for step in bench()[0].STEPS]
    return "; ".join(figure(entry) for entry in entries if entry)


def price():
    report, run = bench()
    for sampler in run.priced():
        def error(name):
            return lambda entry: report.short_number(entry[name]) if name in entry else ""
        ours = run.best[f"{sampler}/strict/float/cached"]
        back = "angle_back_max" in ours
        yield (f"`{sampler.removeprefix('vndf_')}`", steps(run, sampler, lambda entry: f"{entry['ns_per_sample']:.2f}"),
               run.ratio(ours["price"], "cached"), *(steps(run, sampler, error(f"angle_{p}")) for p in ("p50", "p99", "max")),
               *(steps(run, sampler, error(f"angle_back_{p}")) if back else "" for p in ("p99", "max")))


def h100():
    best = {b["run_name"]: b for b in json.loads(H100.read_text())["benchmarks"] if b["aggregate_name"] == "best"}
    for name in sorted(best):
        sampler, _, rest = name.removeprefix("vndf_").partition("/")
        if rest != "strict/float/cached" or sampler.endswith("_lobe"):
            continue
        lean = best.get(name.replace("strict", "lean"))
        yield (f"`{sampler}`", f"{1000 * best[name.replace('cached', 'stream')]['event_ns_per_sample']:.1f}",
               f"{1000 * best[name]['ns_per_sample']:.1f}", f"{1000 * lean['ns_per_sample']:.1f}" if lean else "",
               f"{best[name]['price']:.2f}" if lean else "")


def spread():
    _, run = bench()
    for mode, part in run.noise.items():
        yield f"`{mode}`", f"{100 * part:.1f} %"


LAYOUTS = ("strict", "aos_one", "aos_struct", "aos_stride", "aos_float4", "aos_vload3")


def layouts():
    _, run = bench()
    for sampler in run.samplers():
        if f"{sampler}/aos_vload3/float/stream" in run.best:
            for mode in ("stream", "cached"):
                yield (f"`{sampler.removeprefix('vndf_')}`", mode, *(ns(run.ns(sampler, f"{form}/float", mode)) for form in LAYOUTS))
    readme = run.ns("vndf_ggx_sample_wm_dupuy2023", "readme/float")
    yield "the README's example: cap, reflection, weight and density", "stream", "", ns(readme), "", "", "", ""


def flags():
    report, run = bench()
    for name, *cells in report.flag_rows(run):
        yield (name, *cells)


def divide():
    """Software division: time of samplers in cache, and over that with the device's own, from one run."""
    for sampler, (hardware, software) in json.loads((ROOT / "bench/results/divide.json").read_text("utf-8"))["ns"].items():
        yield f"`{sampler.removeprefix('vndf_')}`", ns(hardware), ns(software), f"{software / hardware:.1f}"


def builds():
    report, run = bench()
    yield from report.build_rows(run)


def copies():
    _, run = bench()
    for name in ("copy_40B/stream", "copy_48B/stream"):
        if name in run.best:
            yield f"`{name.split('/')[0]}`", f"{run.best[name]['ns_per_sample']:.2f}"


# --- The committed counts of instructions ---

def instructions():
    entries = {}
    for entry in json.loads(INSTRUCTIONS.read_text("utf-8"))["entries"]:
        key = entry["target"], entry["form"]
        entries.setdefault(entry["function"], {}).setdefault(key, {})[entry["division"]] = entry
    for name, counts in sorted(entries.items(), key=lambda item: (not item[0].startswith("vndf_ggx"), item[0])):
        if name.endswith("_with_pdf"):
            continue
        cells = []
        for target in ("sm_80", "gfx900"):
            forms = [counts.get((target, form), {}) for form in ("strict", "lean", "published")]
            if name.startswith("copy"):
                forms[0] = counts[target, "copy"]
            cells += [", ".join(str(entry["instructions"]) for entry in form.values()) for form in forms]
            cells.append(", ".join(str(form["fast"]["registers"]) for form in forms if form))
        yield f"`{name.removeprefix('vndf_')}`", *cells


def calls():
    counts = dict(line.split(maxsplit=1) for line in CALLS.read_text("utf-8").splitlines()[1:])
    shown = {name: ", ".join(numbers.split()) for name, numbers in counts.items()}
    for name in shown:
        if name.startswith("vndf_calls_separate_"):
            fused = name.removeprefix("vndf_calls_separate_")
            yield f"`{fused}`", shown[f"vndf_batch_vndf_{fused}"], shown[name]
    yield "the README's example: sample, reflection, weight and density", shown["sample_metal"], ""


# --- The committed run beside Mitsuba ---

def code(name):
    return f"`{name.removeprefix('vndf_')}`" if name.startswith("vndf_") else name


def peer_times():
    times = {(t["name"], t["with_pdf"]): t for t in json.loads(PEERS.read_text("utf-8"))["times"]}

    def pairs(name):  # what two names of one thing took, from memory and cached, then with density
        return [times[name, with_pdf][f"{size}_best"] for with_pdf in (False, True) if (name, with_pdf) in times
                for size in ("memory", "cache")]

    for name in dict.fromkeys(name for name, _ in times):
        ours, theirs = pairs(name), pairs("Mitsuba Beckmann" if "beckmann" in name else "Mitsuba GGX")
        ratios = [f"{min(a) / min(b):.2f}" for a, b in zip(ours, theirs)] if name.startswith("vndf_") else []
        spread = max(100 * (max(pair) / min(pair) - 1) for pair in ours)
        yield (code(name), *(f"{min(pair):.2f}" for pair in ours), *[""] * (4 - len(ours)), ", ".join(ratios),
               f"{spread:.0f} %", f"{times[name, False]['first_call_s']:.2f}")


def peer_errors(cell):
    errors = json.loads(PEERS.read_text("utf-8"))["errors"]
    inputs = list(dict.fromkeys(e["inputs"] for e in errors))
    rows = {}
    for e in errors:
        rows.setdefault(e["name"], {})[e["inputs"]] = cell(e)
    return table(["sampler", *inputs], [(code(name), *(row.get(kind, "") for kind in inputs)) for name, row in rows.items()])


def peer_angles(e):
    return ", ".join(f"{e[f'angle_{part}']:.2g}" for part in ("p50", "p99", "max"))


def peer_densities(e):
    faults = [f"{e[key]} {what}" for key, what in (("not_finite", "not finite"), ("outside", "outside")) if e[key]]
    return "; ".join([f"{e['density_p99']:.0e}", *faults])


RAYS = ("camera rays in packets", "camera rays", "diffuse rays", "whole render")


def embree_peer():
    for scene in json.loads(EMBREE.read_text("utf-8"))["scenes"]:
        yield (f"{scene['scene']}: {scene['triangles']}",
               *(f"{scene[what]['speed']:.2f}, {scene[what]['by processor time']:.2f}" for what in RAYS))


def mitsuba_render():
    result = json.loads(MITSUBA_RENDER.read_text("utf-8"))
    skies = [result[sky] for sky in ("white", "sunlit")]
    for masking in ("separable", "correlated"):
        value, most = skies[0]["difference, and at most"][masking]
        yield (f"difference with --masking {masking}, beyond noise", f"{100 * value:.2f} %, at most {100 * most:.2f} %", "")
    yield "mean over Mitsuba's", *(f"{sky['means']['separable'] / sky['means']['mitsuba']:.4f}" for sky in skies)
    for variant in ("llvm", "scalar"):
        for what in ("speed", "speed to equal error"):
            yield f"{what}, times {variant}'s: by the clock, by processors", *(
                ", ".join(f"{x:.2f}" for x in sky[what][variant].values()) for sky in skies)
    yield "fastest of the rounds, Msamples/s: ours, llvm, scalar", *(
        ", ".join(f"{x:.1f}" for x in sky["fastest, Msamples/s"].values()) for sky in skies)


def mitsuba_gltf():
    for name, scene in json.loads(MITSUBA_GLTF.read_text("utf-8")).items():
        if name != "context":
            value, most = scene["difference, and at most"]
            ours, theirs = (scene["noise"][renderer] for renderer in ("clvndf", "mitsuba"))
            yield (name, scene["shows"], f"{100 * value:.2f} %, at most {100 * most:.2f} %",
                   f"{scene['means']['clvndf'] / scene['means']['mitsuba']:.4f}", f"{100 * ours:.1f}, {100 * theirs:.1f} %")


def mitsuba_bsdf():
    """The largest of each figure over anisotropy and transport."""
    cells = collections.defaultdict(list)
    for row in json.loads(MITSUBA_BSDF.read_text("utf-8"))["rows"]:
        cells[row["bsdf"], row["ndf"], row["quantity"]].append(row)
    for (bsdf, ndf, quantity), rows in cells.items():
        def worst(kind):
            if kind not in rows[0]:
                return ""
            median, p99, most, beyond = (max(r[kind][k] for r in rows) for k in ("median", "p99", "max", "beyond"))
            return f"{median:.0e}, {p99:.0e}, {most:.0e}; {100 * beyond:.2g} %"
        yield f"{bsdf}, {ndf}", quantity, *map(worst, ("between", "ours", "theirs", "theirs_with_exact_g1"))


def refraction():
    for row in json.loads(REFRACTION.read_text("utf-8"))["rows"]:
        if row["index"] == 1.5:
            yield (", ".join(map(str, row["alpha"])), str(row["angle"]), f"{row['all_reflected']:.2f}",
                   *(", ".join(f"{row[light][way]:.2g}" for way in ("after", "before", "cone")) for light in ("white", "smooth")))


def caps():
    """Of each light, for the angles of wo: the noise of one sample of cones and of the best other way, and what cones win in the
    same time where a sample that brings light costs `shading` nanoseconds more."""
    report, run = bench()
    others = ("even", "conic", "both")

    def gain(row, shading):
        won = min(report.cap_gain(run, row, way, shading) for way in others)
        return "> 1000" if won > 1000 else f"{won:.0f}" if won > 10 else f"{won:.2g}"
    lights = {}
    for row in run.caps:
        if row["off"] <= 15:
            lights.setdefault((*row["alpha"], row["beta"], row["off"]), []).append(row)
    for (alpha_x, alpha_y, beta, off), rows in lights.items():
        noise = [", ".join(f"{variance ** 0.5:.2g}" for variance in variances) for variances in
                 ([row["cones"]["variance"] for row in rows], [min(row[way]["variance"] for way in others) for row in rows])]
        yield (f"{alpha_x:g}, {alpha_y:g}", f"{beta}°", f"{off}°", *noise,
               *(", ".join(gain(row, shading) for row in rows) for shading in (0, 100)))


def cap_times():
    report, run = bench()
    return table(list(report.CAP_WAYS), [[f"{report.cap_ns(run, way):.3g} ns" for way in report.CAP_WAYS]])


def power():
    measured = json.loads(POWER.read_text("utf-8"))
    runs = [f"{name}: {run['lobes']} lobes of {run['samples']:,} samples" for name, run in
            (("`--quick`", measured["runs"]["quick"]), ("in full", measured["runs"]["full"]))]
    head = [f"mistake: x that {measured['noticed']} of {measured['trials']} runs notice", *runs]
    return table(head, [(row["mistake"], *(f"{100 * row[run]:.2g} %" for run in ("quick", "full")))
                        for row in measured["mistakes"]])


STREAM, CACHED, COMPUTE, PUBLISHED = (
    ("strict/float", "stream"), ("strict/float", "cached"), ("strict/float", "compute"), ("published/float", "stream"))
TABLES = {
    "samplers": lambda build: table(["sampler", "density", "method", "domain", "error", "in double", "source"],
                                    samplers(build)),
    "lobes": lambda build: table(["function", "returns", "source"], lobes(build)),
    "functions": lambda build: table(["function", "kind, support", "error", "in double", "source"], others(build)),
    "results": lambda build: table(["sampler", "streaming", "cached", "published", "error", "error, published"],
                                   times((STREAM, CACHED, PUBLISHED), visible_alone=True)),
    "times": lambda build: table(
        ["sampler", "strict", "cached", "one lobe", "builtin", "strict double", "C++", "published", "p99", "p99, published"],
        times((STREAM, CACHED, COMPUTE, ("builtin/float", "stream"), ("strict/double", "stream"), ("cpp/float", "stream"), PUBLISHED))),
    "instructions": lambda build: table(["sampler", *(f"{target} {what}" for target in ("sm_80", "gfx900") for what in
                                         ("strict", "lean", "published", "registers"))], instructions()),
    "calls": lambda build: table(["function", "common terms", "separate calls"], calls()),
    "price": lambda build: table(["sampler", "ns", "price", "median", "99 %", "maximum", "behind: 99 %", "maximum"], price()),
    "h100": lambda build: table(["sampler", "from memory, ps", "in cache, ps", "lean, in cache, ps", "price"], h100()),
    "spread": lambda build: table(["mode", "two identical kernels differ by up to"], spread()),
    "layouts": lambda build: table(["sampler", "mode", "an array for each scalar", "times one", "structures", "distance as argument",
                                    "`float4`", "`vload3`"], layouts()),
    "divide": lambda build: table(["sampler", "the device's division", "by software", "ratio"], divide()),
    "flags": lambda build: table(["sampler", *(name for _, name in bench()[0].FLAG_SETS)], flags()),
    "builds": lambda build: table(["program", "cold, s", "warm, s", "source, kB", "binary, kB"], builds()),
    "copies": lambda build: table(["copy", "ns"], copies()),
    "peer_times": lambda build: table(["sampler", "streaming", "cached", "with density, streaming", "with density, cached",
                                       "times Mitsuba's", "A/A", "first call, s"], peer_times()),
    "peer_angles": lambda build: peer_errors(peer_angles),
    "embree_peer": lambda build: table(["triangles", *RAYS], embree_peer()),
    "mitsuba_render": lambda build: table(["measure", "white sky", "and a sun"], mitsuba_render()),
    "mitsuba_gltf": lambda build: table(["scene", "shows", "difference beyond noise", "mean over Mitsuba's", "noise, ours and Mitsuba's"],
                                        mitsuba_gltf()),
    "mitsuba_bsdf": lambda build: table(["BSDF", "of", "between", "ours", "Mitsuba's", "Mitsuba's, exact G1"], mitsuba_bsdf()),
    "power": lambda build: power(),
    "tilts": lambda build: table(["tilt", "αx, αy", "view at 30°", "60°", "80°"],
                                 [line.split(" | ") for line in TILTS.read_text("utf-8").splitlines()]),
    "everywhere": lambda build: (ROOT / "tests/data/everywhere.md").read_text("utf-8"),
    "refraction": lambda build: table(["alpha", "angle", "reflected in full", "white: after, before, cone",
                                       "smooth: after, before, cone"], refraction()),
    "cap_times": lambda build: cap_times(),
    "caps": lambda build: table(["αx, αy", "β", "off", "cones, std. dev.", "best other", "gain, shading free", "gain, 100 ns"],
                                caps()),
    "peer_densities": lambda build: peer_errors(peer_densities),
    "gains": lambda build: table(["αx, αy; cos θ 0.9, 0.5, 0.2", "lost by the bounded cap", "white light", "smooth light",
                                  "small light", "smooth light, Sobol"], gains()),
}


# --- Pages ---

def with_tables(text, build):
    def replacement(found):
        if found[1] not in TABLES:
            sys.exit(f"no table {found[1]!r}; there are {', '.join(TABLES)}")
        return f"<!-- table: {found[1]} -->\n{TABLES[found[1]](build)}<!-- end -->"
    return re.sub(r"<!-- table: (\w+) -->\n.*?<!-- end -->", replacement, text, flags=re.S)


def with_files(text):
    return re.sub(r"(<!-- file: (\S+) -->\n```\w*\n).*?(```)", lambda m: m[1] + (ROOT / m[2]).read_text("utf-8") + m[3], text,
                  flags=re.S)


def with_outputs(text, build):
    environment = {**os.environ, "PATH": f"{build}{os.pathsep}{os.environ['PATH']}"}

    def session(found):
        result = ""
        for line in re.findall(r"^\$ (.*)$", found[1], flags=re.M):
            run = subprocess.run(["sh", "-c", line], cwd=ROOT, env=environment, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True)
            result += f"$ {line}\n{run.stdout}"
        return f"```console\n{result}```"
    return re.sub(r"```console\n(.*?)```", session, text, flags=re.S)


def wanted(path, build):
    """What a file should hold, and what is wrong with it beside that."""
    text = path.read_text("utf-8")
    if path.suffix == ".md":
        return with_outputs(with_files(with_tables(text, build)), build), []
    text, missing = with_accuracy(text, build)
    return text, [f"{path.relative_to(ROOT)}: {name} has no line '// Accuracy:'" for name in missing]


def main():
    check = sys.argv[1:2] == ["--check"]
    if len(sys.argv) != 2 + check:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[-1]).resolve()
    if not (build / "clvndf").is_file():
        sys.exit(f"docs.py: no {build / 'clvndf'}: build it first (cmake --build BUILD --target clvndf)")
    pages = [ROOT / "README.md", *sorted(ROOT.glob("[a-z]*/README.md"))]
    problems = []
    for path in [*(p for p in pages if not p.parent.name.startswith("build")), *sorted(ROOT.glob("kernels/vndf/*.h"))]:
        text, wrong = wanted(path, build)
        before = path.read_text("utf-8")
        problems += wrong
        if text == before:
            continue
        if check:
            old, new = before.split("\n"), text.split("\n")
            at = next((i for i, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))
            problems.append(f"{path.relative_to(ROOT)}:{at + 1}: {''.join(old[at:at + 1])!r} should be {''.join(new[at:at + 1])!r}")
        else:
            path.write_text(text, "utf-8")
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
