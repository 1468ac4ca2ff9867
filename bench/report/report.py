#!/usr/bin/env python3
"""Report of `clvndf bench`: one self-contained HTML page with vector plots.

    python3 bench/report/report.py OUTPUT.html BENCH.json [BENCH.json ...]

Several files, one for each device, are put side by side. Needs matplotlib.
"""
import html
import io
import json
import math
import statistics
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True,
                     "svg.hashsalt": "clvndf", "figure.constrained_layout.use": True})

POLICIES = {  # key of an entry's policy and type: name, colour, marker
    "strict/float": ("strict float", "#1f77b4", "o"),
    "builtin/float": ("builtin float", "#ff7f0e", "s"),
    "native/float": ("native float", "#2ca02c", "^"),
    "strict/double": ("strict double", "#17becf", "D"),
    "builtin/double": ("builtin double", "#bcbd22", "v"),
    "published/float": ("published listing", "#d62728", "X"),
    "lean/float": ("lean listing", "#9467bd", "*"),
    "factored/float": ("factored listing", "#8c564b", "h"),
    "cpp/float": ("C++, all threads", "#7f7f7f", "P"),
}
DOUBLE_UNIT = 2.0 ** -29  # 2^-53 in units of 2^-24


class Bench:
    """The best repetition of every entry of one JSON file."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
        self.context = data["context"]
        self.device = self.context["device"]
        self.best = {b["run_name"]: b for b in data["benchmarks"] if b.get("aggregate_name") == "best"}
        self.median = {b["run_name"]: b for b in data["benchmarks"] if b.get("aggregate_name") == "median"}
        self.spread = {b["run_name"]: b["ns_per_sample"] for b in data["benchmarks"]
                       if b.get("aggregate_name") == "cv"}
        self.lobes = data.get("lobes", [])
        self.noise = data.get("spread", {})
        self.builds = data.get("builds", [])
        self.instructions = data.get("instructions", {"entries": []})
        self.caps = data.get("caps", {"rows": []})["rows"]
        functions = {n.split("/")[0] for n in self.best if n.startswith("vndf_")}
        self.functions = sorted(functions, key=lambda f: (not f.startswith("vndf_ggx"), "_sample_" not in f, f))

    def ns(self, function, policy, mode="stream"):
        entry = self.best.get(f"{function}/{policy}/{mode}")
        return entry["ns_per_sample"] if entry else None

    def counter(self, name, counter):
        return self.best.get(name, {}).get(counter)

    def ratio(self, x, mode):
        """A ratio of times in words: none is a difference that two identical kernels may show."""
        if x is None:
            return ""
        return "≈ 1" if max(x, 1 / x) <= 1 + self.noise.get(mode, 0) else f"{x:.2f}"

    def priced(self):
        """Samplers with a lean form."""
        return [s for s in self.samplers() if f"{s}/lean/float/cached" in self.best]

    def samplers(self):
        return [f for f in self.functions if "_sample_" in f and not f.endswith(("_with_pdf", "_lobe"))]


def short(function):
    return function.removeprefix("vndf_").replace("_sample_wm_", " ").replace("_sample_wi_", " ").replace("_", " ")


def svg(figure):
    for axis in figure.axes:  # matplotlib has no logarithmic scale for nothing
        if not axis.has_data():
            axis.set(xscale="linear", yscale="linear")
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()[text.getvalue().index("<svg"):]


def ratio_axis(axis):
    if not axis.patches:
        return
    axis.set_xscale("log")
    axis.axvline(1, color="black", linewidth=0.8)
    axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
    axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def bars(axis, labels, series):
    """Horizontal groups of bars, the first label on top; series: (name, colour, values), None where there is none."""
    height = 0.8 / max(1, len(series))
    for k, (name, colour, values) in enumerate(series):
        at = [i + (k - (len(series) - 1) / 2) * height for i in range(len(labels))]
        shown = [(y, v) for y, v in zip(at, values) if v is not None]
        axis.barh([y for y, _ in shown], [v for _, v in shown], height * 0.92, label=name, color=colour)
    axis.set_yticks(range(len(labels)), labels)
    axis.set_ylim(len(labels) - 0.4, -0.6)
    axis.grid(axis="y", visible=False)


def pareto(points):
    """The points that no other beats in both coordinates, from the left to the right."""
    front = []
    for x, y in sorted(points):
        if not front or y < front[-1][1]:
            front.append((x, y))
    return front


STEPS = ("lean/float", "factored/float", "strict/float")  # of accuracy, the cheapest first


def price_panel(axis, bench, sampler):
    """Time and errors of each step: in front of the surface and behind it, the median, the tail and the maximum."""
    percentiles = (("p50", "_"), ("p99", "o"), ("p9999", "^"), ("max", "x"))
    for side, colour in (("", "#1f77b4"), ("_back", "#ff7f0e")):
        for step in STEPS:
            entry = bench.best.get(f"{sampler}/{step}/cached")
            if not entry or f"angle{side}_max" not in entry:
                continue
            x = entry["ns_per_sample"] * (1.015 if side else 1)
            errors = [max(entry[f"angle{side}_{name}"], 1e-2) for name, _ in percentiles]
            axis.plot([x, x], [errors[0], errors[-1]], color=colour, linewidth=0.9)
            for (_, marker), error in zip(percentiles, errors):
                axis.plot(x, error, marker, color=colour, markersize=6)
            if not side:
                axis.annotate(step.split("/")[0], (x, errors[-1]), xytext=(0, 5), textcoords="offset points", fontsize=7,
                              ha="center")
    axis.set_yscale("log")
    axis.set_ylim(1e-2, 1e8)
    low, high = axis.get_xlim()
    axis.set_xlim(0, high + 0.15 * (high - low))
    axis.set_title(short(sampler), fontsize=8)


def price_of_accuracy(benches):
    samplers = benches[0].priced()
    rows = max(1, math.ceil(len(samplers) / 4))
    figure, axes = plt.subplots(rows, 4, figsize=(11, 3.1 * rows + 0.4), squeeze=False, sharey=True)
    for axis, sampler in zip(axes.flat, samplers):
        price_panel(axis, benches[0], sampler)
    for axis in list(axes.flat)[len(samplers):]:
        axis.axis("off")
    for axis in axes[:, 0]:
        axis.set_ylabel("angle to exact arithmetic, $2^{-24}$", fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("ns a sample, cached", fontsize=8)
    marks = [plt.Line2D([], [], marker=marker, color="black", linestyle="", label=label)
             for label, marker in (("median", "_"), ("99 %", "o"), ("99.99 %", "^"), ("maximum", "x"))]
    marks += [plt.Line2D([], [], color=colour, label=label)
              for label, colour in (("wo above the surface", "#1f77b4"), ("wo below it", "#ff7f0e"))]
    figure.suptitle(" ")
    figure.legend(handles=marks, fontsize=8, loc="upper center", ncol=6, frameon=False).set_in_layout(False)
    return figure


PRICE_HEAD = ("sampler", "form", "ns, cached", "price", "median", "99 %", "99.99 %", "maximum", "behind: 99 %", "maximum",
              "no result", "same bits everywhere")


def price_rows(bench):
    """For every sampler with a lean form: what each step costs and what it buys."""
    def error(entry, name):
        return "" if name not in entry else short_number(entry[name])

    for sampler in bench.priced():
        for step in (*STEPS, "strict/double", "published/float"):
            entry = bench.best.get(f"{sampler}/{step}/cached")
            if not entry:
                continue
            bad = int(entry["nonfinite"] + entry.get("below", 0))
            yield (short(sampler), step.replace("/", " "), f"{entry['ns_per_sample']:.2f}",
                   bench.ratio(entry.get("price"), "cached"), *(error(entry, f"angle_{p}") for p in ("p50", "p99", "p9999", "max")),
                   error(entry, "angle_back_p99"), error(entry, "angle_back_max"), str(bad) if bad else "",
                   "yes" if step.startswith("strict") else "")


def short_number(x):
    return f"{x:.0e}".replace("e+0", "e") if x >= 1e5 else f"{x:.0f}" if x >= 99.95 else f"{x:.1f}" if x >= 9.95 else f"{x:.2f}"


def where_lean_is_enough(bench):
    """In words, from the numbers: what is lost with the lean form of each sampler, as an angle."""
    def angle(x):
        return "any direction" if x > 2 ** 24 else f"{x * 2 ** -24:.1g} rad"

    for sampler in bench.priced():
        entry = bench.best[f"{sampler}/lean/float/cached"]
        text = (f"{short(sampler)}: 99 % of its lean results are within {angle(entry['angle_p99'])}, 99.99 % within "
                f"{angle(entry['angle_p9999'])}, the worst of the run was off by {angle(entry['angle_max'])}")
        if "angle_back_max" in entry:
            text += f"; below the surface by {angle(entry['angle_back_max'])}, and 1 % by more than {angle(entry['angle_back_p99'])}"
        yield text + "."


def layouts(benches):
    bench = benches[0]
    forms = (("strict", "an array for each scalar"), ("aos_one", "times one"), ("aos_struct", "structures"), ("aos_stride", "distance as argument"),
             ("aos_float4", "float4"), ("aos_vload3", "vload3"))
    names = [s for s in bench.samplers() if f"{s}/aos_vload3/float/stream" in bench.best]
    figure, axes = plt.subplots(1, 2, figsize=(11, 0.9 * len(names) + 1.6), squeeze=False, sharey=True)
    colours = ("#1f77b4", "#17becf", "#9467bd", "#2ca02c", "#ff7f0e", "#d62728")
    for axis, mode in zip(axes[0], ("stream", "cached")):
        bars(axis, [short(n) for n in names],
             [(label, colour, [bench.ns(n, f"{form}/float", mode) for n in names])
              for (form, label), colour in zip(forms, colours)])
        axis.set_xscale("log")
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        axis.set_xlabel(f"ns a sample, {'streaming' if mode == 'stream' else mode}")
        axis.set_title(bench.device, fontsize=8)
    axes[0][0].legend(fontsize=7, loc="upper center", bbox_to_anchor=(1.0, -0.2), ncol=6, frameon=False)
    return figure


FLAG_SETS = (("luxcore", "LuxCore and Baikal"), ("fluctus", "Fluctus"), ("cycles", "Cycles (2016)"), ("hydracore", "HydraCore"))


def flag_rows(bench):
    """Samplers under renderers' build options: time over that of strict, largest angles in front and behind, no results."""
    for sampler in bench.samplers():
        strict = bench.ns(sampler, "strict/float", "cached")
        cells = []
        for name, _ in FLAG_SETS:
            entry = bench.best.get(f"{sampler}/{name}/float/cached")
            if not entry or not strict:
                cells.append("")
                continue
            bad = int(entry["nonfinite"] + entry.get("below", 0))
            largest = [short_number(entry[f"angle{side}_max"]) for side in ("", "_back") if f"angle{side}_max" in entry]
            cells.append(f"{bench.ratio(entry['ns_per_sample'] / strict, 'cached')}; {', '.join(largest)}"
                         + (f"; {bad}" if bad else ""))
        if any(cells):
            yield (short(sampler), *cells)


def build_rows(bench):
    for b in bench.builds:
        yield (b["program"].replace("vndf_", ""), f"{b['cold_s']:.2f}", f"{b['warm_s']:.2f}", f"{b['source_bytes'] / 1000:.0f}",
               f"{b['binary_bytes'] / 1000:.0f}")


def instruction_rows(entries):
    """For each target the rows: sampler, then instructions / registers of each form with each kind of division."""
    counts = {(e["target"], e["function"], e["form"], e["division"]): e for e in entries}
    columns = [(form, division) for form in ("strict", "lean", "factored", "published") for division in ("ieee", "fast")]
    columns.append(("published", "fast-math"))
    for target in dict.fromkeys(e["target"] for e in entries):
        rows = []
        for name in dict.fromkeys(e["function"] for e in entries if e["target"] == target):
            found = [counts.get((target, name, *column)) for column in columns]
            if name.startswith("copy"):
                found[:2] = [counts[target, name, "copy", division] for division in ("ieee", "fast")]
            rows.append((short(name), *(f"{e['instructions']} / {e['registers']}" if e else "" for e in found)))
        yield target, [f"{form}, {division}" for form, division in columns], rows


def accuracy_panel(axis, bench, ndf, real):
    points, used = [], []
    for sampler, colour in zip([s for s in bench.samplers() if s.startswith(f"vndf_{ndf}")], plt.cm.tab10.colors):
        for key in (k for k in POLICIES if k.endswith(real) and k != "cpp/float"):
            name = f"{sampler}/{key}/stream"
            error = bench.counter(name, "err_p99")
            if error is None or not math.isfinite(error):
                continue
            points.append((bench.best[name]["ns_per_sample"], error))
            used.append(key)
            axis.plot(*points[-1], POLICIES[key][2], color=colour, markersize=7, markeredgecolor="white",
                      markeredgewidth=0.5)
        axis.plot([], [], "o", color=colour, label=short(sampler).removeprefix(ndf + " "))
    if not points:
        axis.axis("off")
        return
    for key in POLICIES:
        if key in used:
            axis.plot([], [], POLICIES[key][2], color="black", label=POLICIES[key][0])
    front = pareto(points)
    axis.margins(0.12)
    axis.step([x for x, _ in front], [y for _, y in front], where="post", color="black", linewidth=0.8,
              linestyle="--", label="Pareto front (ringed)")
    axis.set_xscale("log")
    axis.set_yscale("log")
    for x, y in front:
        axis.plot(x, y, "o", color="none", markeredgecolor="black", markersize=12, markeredgewidth=0.8)
    for side in (axis.xaxis, axis.yaxis):
        side.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        side.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        side.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axis.set_xlabel("ns a sample, streaming")
    unit = "-24" if real == "float" else "-53"
    axis.set_ylabel(f"99th percentile of the error,\n$2^{{{unit}}}$ (1 + condition number)")
    axis.set_title(f"{'GGX' if ndf == 'ggx' else 'Beckmann'}, {real}: {bench.device}", fontsize=8)
    axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def accuracy_against_time(benches):
    figure, axes = plt.subplots(2 * len(benches), 2, figsize=(11, 7.6 * len(benches)), squeeze=False)
    for i, bench in enumerate(benches):
        for k, real in enumerate(("float", "double")):
            for axis, ndf in zip(axes[2 * i + k], ("ggx", "beckmann")):
                accuracy_panel(axis, bench, ndf, real)
    return figure


def speed_up(benches):
    figure, axes = plt.subplots(1, len(benches), figsize=(11, 4.2), squeeze=False)
    for axis, bench in zip(axes[0], benches):
        names = [s for s in bench.samplers() if bench.ns(s, "published/float")]
        series = []
        for key, mode, label, colour in (("strict/float", "stream", "strict float, streaming", "#1f77b4"),
                                         ("strict/float", "compute", "strict float, compute-bound", "#aec7e8"),
                                         ("cpp/float", "stream", "C++, all threads, streaming", "#7f7f7f"),
                                         ("cpp/float", "compute", "C++, all threads, compute-bound", "#c7c7c7")):
            values = [bench.counter(f"{n}/{key}/{mode}", "speedup_over_published") for n in names]
            series.append((label, colour, values))
        bars(axis, [short(n) for n in names], series)
        for k, (_, _, values) in enumerate(series):
            for i, value in enumerate(values):
                if value:
                    axis.text(value, i + (k - 1.5) * 0.2, f" {value:.1f}", va="center", fontsize=7)
        ratio_axis(axis)
        axis.set_xlim(right=axis.get_xlim()[1] * 1.6)
        axis.set_xlabel("times as fast as the published listing ported line by line")
        axis.set_title(bench.device, fontsize=9)
        axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncol=2, frameon=False)
    return figure


def achieved(benches):
    names = list(dict.fromkeys(f for b in benches for f in b.functions if not f.endswith("_with_pdf")))
    kinds = (("stream", "fraction_of_copy", "of the fastest copy of as many bytes", "#1f77b4"),
             ("stream", "fraction_of_arithmetic", "of the arithmetic rate", "#9467bd"))
    figure, axes = plt.subplots(1, 2 * len(benches), figsize=(11, 0.19 * len(names) + 1.2), squeeze=False, sharey=True)
    for i, bench in enumerate(benches):
        for axis, (mode, counter, label, colour) in zip(axes[0][2 * i:], kinds):
            values = [bench.counter(f"{n}/strict/float/{mode}", counter) for n in names]
            bars(axis, [short(n) for n in names], [("strict float", colour, values)])
            axis.axvline(1, color="black", linewidth=0.8)
            axis.set_xlabel(label)
            axis.set_title(bench.device, fontsize=7)
            axis.tick_params(axis="y", labelsize=7)
    return figure


def cost_of_accuracy(benches):
    steps = (("builtin over native", "builtin/float", "native/float", "#2ca02c"),
             ("strict over builtin", "strict/float", "builtin/float", "#ff7f0e"),
             ("strict double over strict float", "strict/double", "strict/float", "#17becf"))
    names = list(dict.fromkeys(s for b in benches for s in b.samplers()))
    figure, axes = plt.subplots(1, 2 * len(benches), figsize=(11, 0.42 * len(names) + 1.6), squeeze=False, sharey=True)
    for i, bench in enumerate(benches):
        for axis, mode in zip(axes[0][2 * i:], ("stream", "compute")):
            series = []
            for label, over, under, colour in steps:
                pairs = [(bench.ns(n, over, mode), bench.ns(n, under, mode)) for n in names]
                series.append((label, colour, [a / b if a and b else None for a, b in pairs]))
            bars(axis, [short(n) for n in names], series)
            ratio_axis(axis)
            kind = "streaming" if mode == "stream" else "compute-bound"
            axis.set_xlabel(f"ratio of times, {kind}")
            axis.set_title(bench.device, fontsize=8)
            axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.12), frameon=False)
    return figure


NOISE = (("vndf_ggx_sample_wm_walter2007", "plain NDF", "#7f7f7f"), ("vndf_ggx_sample_wm_dupuy2023", "cap", "#1f77b4"),
         ("vndf_ggx_sample_wi_eto2023", "bounded cap", "#ff7f0e"),
         ("vndf_ggx_sample_wi_eto2023_polygon", "polygon bound", "#2ca02c"),
         ("vndf_ggx_sample_wi_eto2023/tries2", "bounded cap, 2 tries", "#9467bd"),
         ("vndf_ggx_sample_wi_eto2023/tries4", "bounded cap, 4 tries", "#8c564b"),
         ("vndf_ggx_sample_wi_conic2026", "conic", "#d62728"))
SMALL = "small light"
LIGHTS = {  # what the time is multiplied with for equal noise
    "white light": lambda lobe: lobe["variance"],
    "smooth light": lambda lobe: lobe["smooth_variance"],
    # All visible normals: their densities in the direction of the light differ by the part that is kept.
    SMALL: lambda lobe: 1 / (1 - lobe["rejected"]),
    "white light, Sobol": lambda lobe: lobe["sobol_rmse"] ** 2,
    "smooth light, Sobol": lambda lobe: lobe["smooth_sobol_rmse"] ** 2,
}


def lobe_ns(bench, lobe):
    """Time of one sample with its density, compute-bound; of the first of K the times that it is made of."""
    name, _, tries = lobe["sampler"].partition("/tries")
    if lobe["sampler"].endswith("conic2026") and lobe["alpha_x"] == lobe["alpha_y"]:
        name += "_isotropic"
    ns = bench.ns(name + "_with_pdf", "strict/float", "compute")
    if not tries:
        return ns
    visible = bench.ns("vndf_ggx_sigma_visible", "strict/float", "compute")
    return int(tries) * ns + visible if ns and visible else None


def gain(bench, lobe, light, shading_ns):
    """Noise of the bounded cap over this sampler's in the same time, as a ratio of variances."""
    def cost(one):
        ns = lobe_ns(bench, one)
        return LIGHTS[light](one) * (ns + shading_ns * (1 - one["rejected"])) if ns else None

    same = ("alpha_x", "alpha_y", "cos_theta")
    bounded = next(other for other in bench.lobes
                   if other["sampler"] == BOUNDED and all(other[key] == lobe[key] for key in same))
    ours, theirs = cost(lobe), cost(bounded)
    if light == SMALL and lobe["sampler"].endswith("walter2007"):
        return None
    return theirs / ours if ours and theirs else None


def lobe_grid(bench, rows, value):
    """A panel for each row and angle: value(lobe, row) over the lobes, a line a sampler."""
    cosines = sorted({lobe["cos_theta"] for lobe in bench.lobes}, reverse=True)
    figure, axes = plt.subplots(len(rows), max(1, len(cosines)), figsize=(11, 2.5 * len(rows) + 1), squeeze=False,
                                sharex=True, sharey="row")
    for column, cosine in enumerate(cosines):
        here = [lobe for lobe in bench.lobes if lobe["cos_theta"] == cosine]
        labels = list(dict.fromkeys(f"{lobe['alpha_x']:g}, {lobe['alpha_y']:g}" for lobe in here))
        for axis, row in zip(axes[:, column], rows):
            for sampler, name, colour in NOISE:
                lobes = [lobe for lobe in here if lobe["sampler"] == sampler]
                shown = [value(lobe, row) for lobe in lobes]
                if None in shown:
                    continue
                # No line from the isotropic lobes to the others.
                split = sum(lobe["alpha_x"] == lobe["alpha_y"] for lobe in lobes)
                style = {"color": colour, "markersize": 6 if sampler == BOUNDED else 4, "linewidth": 1}
                axis.plot(range(split), shown[:split], "o-", label=name, **style)
                axis.plot(range(split, len(shown)), shown[split:], "o-", **style)
            if row != "rejected samples":
                axis.set_yscale("log")
            axis.set_title(f"cos(theta_o) = {cosine:.1f}", fontsize=8)
            axis.set_xticks(range(len(labels)), labels, rotation=60, fontsize=7)
            if column == 0:
                axis.set_ylabel(row, fontsize=8)
        axes[-1][column].set_xlabel("alpha_x, alpha_y")
    return figure, axes


def legend_above(figure, axis):
    """That of one panel for all, above the first row, in the room of an empty title."""
    figure.suptitle(" ")
    handles, names = axis.get_legend_handles_labels()
    if handles:
        figure.legend(handles, names, fontsize=8, loc="upper center", ncol=len(names),
                      frameon=False).set_in_layout(False)


def noise_of_one_sample(benches):
    rows = {"rejected samples": "rejected", "variance, white light": "variance",
            "variance, smooth light": "smooth_variance", "Sobol: RMSE, white light": "sobol_rmse",
            "Sobol: RMSE, smooth light": "smooth_sobol_rmse"}
    figure, axes = lobe_grid(benches[0], list(rows), lambda lobe, row: lobe[rows[row]])
    legend_above(figure, axes[1][0])
    return figure


def equal_time(shading_ns):
    def plot(benches):
        figure, axes = lobe_grid(benches[0], list(LIGHTS), lambda lobe, row: gain(benches[0], lobe, row, shading_ns))
        for axis in axes.flat:
            axis.axhline(1, color="black", linewidth=0.8)
            axis.yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
            axis.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda y, _: f"{y:g}"))
            axis.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        legend_above(figure, axes[1][0])
        return figure
    return plot


CONE = "vndf_ggx_sample_wi_cone2026_with_pdf"
CAP_WAYS = {  # to sample a light that fills a cap: entry, name, colour
    "cones": (f"{CONE}/strict/float", "cones", "#d62728"),
    "even": (f"{CONE}/evenly/float", "over even samples", "#1f77b4"),
    "conic": ("vndf_ggx_sample_wi_conic2026_with_pdf/strict/float", "over conic2026", "#2ca02c"),
    "both": (f"{CONE}/both/float", "over both by the balance heuristic", "#9467bd"),
}


def cap_ns(bench, way):
    return bench.counter(f"{CAP_WAYS[way][0]}/compute", "ns_per_sample")


def cap_gain(bench, row, way, shading_ns):
    """Noise of a way to sample a cap over that of cones in the same time, as a ratio of variances."""
    def cost(one):
        ns = cap_ns(bench, one)
        return row[one]["variance"] * (ns + shading_ns * row[one]["kept"]) if ns else None

    ours, theirs = cost("cones"), cost(way)
    return theirs / ours if ours and theirs else None


def lights_that_fill_a_cap(benches):
    """A panel for each roughness and angle off the mirror direction; the angles of light and view beside one another."""
    bench = benches[0]
    alphas = list(dict.fromkeys(tuple(row["alpha"]) for row in bench.caps)) or [None]
    offs = sorted({row["off"] for row in bench.caps}) or [None]
    figure, axes = plt.subplots(len(alphas), len(offs), figsize=(11, 2.2 * len(alphas) + 1), squeeze=False, sharex=True, sharey=True)
    for axis, (alpha, off) in zip(axes.flat, ((alpha, off) for alpha in alphas for off in offs)):
        rows = [row for row in bench.caps if (tuple(row["alpha"]), row["off"]) == (alpha, off)]
        for way, (_, name, colour) in CAP_WAYS.items():
            for shading, line in ((0, "-"), (100, ":")):
                gains = [cap_gain(bench, row, way, shading) for row in rows]
                if way != "cones" and gains and None not in gains:
                    axis.plot(range(len(rows)), [min(max(g, 1e-2), 1e4) for g in gains], "o" + line, color=colour, markersize=3,
                              linewidth=1, label=name if shading == 0 else None)
        axis.axhline(1, color="black", linewidth=0.8)
        axis.set(yscale="log", ylim=(0.7e-2, 1.5e4))
        axis.set_xticks(range(len(rows)), [f"{row['beta']}, {row['theta']}" for row in rows], rotation=60, fontsize=7)
        if rows:
            axis.set_title(f"alpha {alpha[0]:g}, {alpha[1]:g}; {off} degrees off the mirror direction", fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("beta, angle of wo, in degrees", fontsize=8)
    for axis in axes[:, 0]:
        axis.set_ylabel("gain of cones", fontsize=8)
    legend_above(figure, axes[0][0])
    return figure


def build_times(benches):
    figure, axes = plt.subplots(1, len(benches), figsize=(11, 3.6), squeeze=False)
    for axis, bench in zip(axes[0], benches):
        names = bench.samplers()
        values = {kind: [bench.counter(f"{n}/strict/float/stream", f"build_{kind}_s") for n in names]
                  for kind in ("cold", "warm")}
        bars(axis, [short(n) for n in names], [("cold", "#1f77b4", values["cold"]), ("warm", "#aec7e8", values["warm"])])
        axis.set_xlabel("seconds until the first launch of one function has run")
        axis.set_title(bench.device, fontsize=9)
        axis.legend(fontsize=7, frameon=False)
    return figure


CAP, CROSS = "vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wm_heitz2018"
BOUNDED, WORLD = "vndf_ggx_sample_wi_eto2023", "vndf_ggx_sample_wm_benyoub2024"


def headline_rows(bench):
    """The papers' claims beside what was measured: (claim, published, ours)."""
    def faster(slow, fast, slow_policy, policy, mode):
        a, b = bench.ns(slow, slow_policy, mode), bench.ns(fast, policy, mode)
        return f"{100 * (a / b - 1):+.0f} %" if a and b else "not measured"

    def cells(slow, fast, slow_policies=("published/float", "strict/float")):
        """How much faster `fast` is: the listings, then ours."""
        return "; ".join(f"{label}, {kind} {faster(slow, fast, slow_policy, policy, mode)}"
                         for label, slow_policy, policy in zip(("published listing", "strict"), slow_policies,
                                                               ("published/float", "strict/float"))
                         for kind, mode in (("streaming", "stream"), ("compute-bound", "compute")))

    def useful(policy):
        a, b = (bench.counter(f"{s}/{policy}/stream", "ns_per_useful_sample") for s in (CAP, BOUNDED))
        return f"{100 * (a / b - 1):+.0f} %" if a and b else "not measured"

    def equal_time_error(shading_ns):
        """The cap's root mean square error over the bounded cap's, by alpha: the middle of the angles."""
        errors = {}
        for lobe in bench.lobes:
            if lobe["sampler"] == CAP and lobe["alpha_x"] == lobe["alpha_y"]:
                ratio = gain(bench, lobe, "white light", shading_ns)
                errors.setdefault(lobe["alpha_x"], []).append(ratio and ratio ** -0.5)
        return ", ".join(f"{alpha:g}: {100 * (statistics.median(e) - 1):+.0f} %" if all(e) else f"{alpha:g}: not measured"
                         for alpha, e in sorted(errors.items()))

    return [
        ("The cap is faster than the cross section (Dupuy & Benyoub 2023)", "+37.7 % CPU, +39.3 % and +53.0 % GPU",
         cells(CROSS, CAP)),
        ("The isotropic sampler without a basis is faster than cap plus basis (Benyoub 2024)", "+15 %",
         cells(WORLD, WORLD, ("published_basis/float", "basis/float"))),
        ("Bounded sampling wastes fewer samples than the cap (Eto & Tokuyoshi 2023)",
         "fewer, most at high roughness",
         f"useful samples a second, alpha log-uniform in [1e-3, 1]: published listings {useful('published/float')}; "
         f"strict {useful('strict/float')}"),
        ("Bounded sampling has less error in equal time than the cap (Eto & Tokuyoshi 2023)",
         "lower, most at high roughness",
         f"error of the cap over the bounded cap's, white light, by alpha: {equal_time_error(0)}; "
         f"with 100 ns of shading: {equal_time_error(100)}"),
    ]


def target_rows(bench):
    """What the project wants of itself on a CPU, and of the code for GPUs: (target, function, wanted, measured, met)."""
    def rows(label, names, wanted, value):
        for name in names:
            got = value(name)
            if got is not None:
                yield (label, short(name), f"<= {wanted:g}", f"{got:.2f}", "yes" if got <= wanted else "no")

    def cached(name):
        return bench.ns(name, "strict/float", "cached")

    def ratio(a, b):
        return a / b if a and b else None

    def copies(name):
        return ratio(1, bench.counter(f"{name}/strict/float/stream", "fraction_of_copy"))

    counts = {(e["function"], e["form"]): e["instructions"] for e in bench.instructions["entries"]
              if (e["target"], e["division"]) == ("sm_80", "fast")}
    plain, priced = bench.samplers(), bench.priced()
    ggx = [f for f in bench.functions if f.startswith("vndf_ggx") and "conic2026" not in f and f != CAP]
    price = "time over the lean form's, cached"
    yield from rows(price, [CAP], 1.45, lambda n: bench.counter(f"{n}/strict/float/cached", "price"))
    yield from rows(price, [s for s in priced if s != CAP and s.startswith("vndf_ggx")], 1.5,
                    lambda n: bench.counter(f"{n}/strict/float/cached", "price"))
    yield from rows("with its density over without, cached", plain, 1.2, lambda n: ratio(cached(n + "_with_pdf"), cached(n)))
    yield from rows("times a copy of as many bytes, streaming", [CAP], 1.1, copies)
    yield from rows("times a copy of as many bytes, streaming", ggx, 1.25, copies)
    yield from rows("time over the bounded cap's, cached", ["vndf_ggx_sample_wi_conic2026"], 3,
                    lambda n: ratio(cached(n), cached(BOUNDED)))
    yield from rows("time over conic2026's, own lobe and cap, cached", [CONE.removesuffix("_with_pdf")], 2,
                    lambda n: ratio(cached(n), cached("vndf_ggx_sample_wi_conic2026")))
    yield from rows("time over conic2026's, lobe and cap shared, with the density", [CONE], 1.5,
                    lambda n: ratio(cap_ns(bench, "cones"), cap_ns(bench, "conic")))
    yield from rows("instructions over the lean form's, sm_80, fast divisions", priced, 1.7,
                    lambda n: ratio(counts.get((n, "strict")), counts.get((n, "lean"))))


def table(head, rows):
    cells = "".join(f"<th>{html.escape(h)}</th>" for h in head)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(str(c))}</td>" for c in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>"


def number(value, form="{:.3g}"):
    return "" if value is None else form.format(value)


def entry_rows(bench):
    for name, best in bench.best.items():
        event = best.get("event_ns_per_sample")
        yield (name, number(best["ns_per_sample"]), number(bench.median[name]["ns_per_sample"]),
               number(100 * bench.spread.get(name, 0), "{:.0f} %"), number(event), number(best["ns_per_useful_sample"]),
               number(best.get("fraction_of_copy"), "{:.2f}"), number(best.get("speedup_over_published"), "{:.1f}"),
               number(best.get("price"), "{:.2f}"), number(best.get("err_p50")), number(best.get("err_p99")),
               number(best.get("err_max")), number(best.get("angle_max")), number(best.get("angle_back_max")),
               number(best.get("bias")))


def lobe_rows(bench):
    names = {sampler: name for sampler, name, _ in NOISE}
    for lobe in bench.lobes:
        gains = [number(gain(bench, lobe, light, shading), "{:.2f}") for shading in (0, 100) for light in LIGHTS]
        yield (f"{lobe['alpha_x']:g}, {lobe['alpha_y']:g}", number(lobe["cos_theta"]), names[lobe["sampler"]],
               number(lobe["rejected"]), *gains)


PLOTS = (
    ("What does each step of accuracy cost, and what does it buy?", price_of_accuracy,
     "Each stick is a form of a sampler, from the left to the right: the listing on scalars (lean); with 1 +- z free of "
     "cancellation (factored); ours (strict). From below: median, 99 %, 99.99 % and maximum of the angle to the same map in exact "
     "arithmetic. Own lobe a sample, arrays in a cache, half of the lobes back-facing where that is valid."),
    ("Accuracy against time", accuracy_against_time,
     "Left and low is better. The error is the angle between the result and what exact arithmetic would give for the same "
     "map, over the inputs that are timed; the GGX listing of 2014 is judged against its own fit, whose bias comes on top."),
    ("Speed-up over the published listings", speed_up,
     "The listings ported line by line, as one would paste them, with their errata corrected; same device, same run, "
     "same harness."),
    ("Bandwidth and arithmetic", achieved,
     "Inputs and outputs stream through memory as separate arrays. Left, 1 is the fastest of three copy kernels that read "
     "and write as many arrays. Right, 1 is a kernel of nothing but fma on registers; an fma counts as two operations, a "
     "division or a root as one, although it takes the time of many, and comparisons and selections as none."),
    ("What each step of accuracy costs", cost_of_accuracy,
     "Right of 1 the more accurate form takes longer; left of 1 it takes less time, on this device: builtin calls a scalar "
     "function for each sine and logarithm where the compiler does not vectorise it. The price over the lean form is above."),
    ("Layouts", layouts,
     "The same sampler over an array for each scalar and over arrays as renderers keep them (bench/layouts.cl). Where LLVM packs "
     "neighbouring loads and stores, PoCL does not vectorise the kernel; times one: every second component is multiplied by an "
     "argument that is 1, and the neighbours are no longer alike."),
    ("Rejection and variance", noise_of_one_sample,
     "GGX without Fresnel, azimuth 0.7. Samples whose reflection is below the surface are rejected and count as 0. White light "
     "is 1 everywhere, smooth light (1 + wi.x) / 2. Variance of one random sample; root of the mean squared error of 1024 "
     "points of Sobol's sequence over 64 Owen scrambles. 2 and 4 tries: the first of so many samples of the bounded cap that "
     "is above the surface."),
    ("Equal time, shading free", equal_time(0),
     "Above 1: less noise than the bounded cap in the same time, as a ratio of variances; in strict float, compute-bound, "
     "with the density. Small light: the limit of a light of one direction, where the variance goes with 1 over the part that "
     "is kept, whatever the direction. The time of K tries is that of K samples of the bounded cap and one sigma_visible. For "
     "Sobol's points the squared error counts as variance, which underrates what faster samplers win."),
    ("Equal time, shading 100 ns", equal_time(100),
     "As above, with 100 ns more for each sample that is not rejected: rays and shading."),
    ("Lights that fill a cap: equal time", lights_that_fill_a_cap,
     "One even light of half angle beta that nothing hides, over GGX facets that reflect everything: variance in the same time of "
     "even samples of the cap, of conic2026 and of both by the balance heuristic, over that of cones (cone2026). Above 1 cones win; "
     "between 0.01 and 10,000 at most. Dots: 100 ns more for each sample that brings light. Variances are those of bench/caps.py, "
     "times of this run: strict float, compute-bound, with the density."),
    ("Build time", build_times, "One function's program: cold with an empty compiler cache, warm from the cache."),
)

STYLE = """body{font:15px/1.5 sans-serif;max-width:1120px;margin:2em auto;padding:0 1em;color:#222}
svg{max-width:100%;height:auto} table{border-collapse:collapse;font-size:13px;margin:1em 0}
td,th{border-bottom:1px solid #ddd;padding:2px 10px 2px 0;text-align:left;vertical-align:top}
figure{margin:1em 0} figcaption{color:#555} details table{font-size:11px}"""


def price_section(bench):
    lost = "".join(f"<li>{html.escape(line)}</li>" for line in where_lean_is_enough(bench))
    return (f"<h3>{html.escape(bench.device)}</h3>{table(PRICE_HEAD, price_rows(bench))}<p>Errors in 2<sup>-24</sup> (double: "
            "2<sup>-53</sup>). No result: not finite, or a normal below the horizon. Lean is enough where wo is above the surface, "
            f"its bits need not be those of another device, and these angles do no harm:</p><ul>{lost}</ul>")


def more_tables(bench):
    out = [f"<h2>Build options of renderers</h2><h3>{html.escape(bench.device)}</h3>",
           table(["strict under", *(name for _, name in FLAG_SETS)], flag_rows(bench)),
           "<p>Time over strict's, cached; largest angles in front of and behind the surface, 2<sup>-24</sup>; what is no result.</p>",
           "<h2>What a program costs to build</h2>",
           table(["strict float", "cold, s", "warm, s", "source, kB", "binary, kB"], build_rows(bench)),
           "<p>Until every kernel has run once; cold: with an empty compiler cache.</p>"]
    for target, columns, rows in instruction_rows(bench.instructions["entries"]):
        out.append(f"<h2>Instructions / registers: {target}</h2>{table(['sampler', *columns], rows)}")
    return "".join(out)


def page(benches):
    out = [f"<!doctype html><html lang='en'><head><meta charset='utf-8'><title>clvndf bench</title>"
           f"<style>{STYLE}</style></head><body><h1>clvndf: accuracy against time</h1>"]
    facts = ("device", "platform_version", "driver_version", "compute_units", "clock_mhz", "fp64", "fma",
             "correctly_rounded_divide_sqrt", "build_options", "repetitions", "date", "host_name", "num_cpus",
             "mhz_per_cpu", "clvndf_version")
    out.append(table(["", *[f"run {i + 1}" for i in range(len(benches))]],
                     [(f, *[b.context.get(f, "") for b in benches]) for f in facts if f != "host_name"]))
    for bench in benches:
        noise = ", ".join(f"{mode} {100 * x:.1f} %" for mode, x in bench.noise.items())
        out.append(f"<p>{html.escape(bench.device)}: measured on {html.escape(bench.context.get('inputs', ''))}. Two identical "
                   f"kernels differ by up to {noise or 'an unknown part (none was measured twice)'}: a ratio within that is "
                   "written ≈ 1.</p>")
    for title, plot, caption in PLOTS:
        out.append(f"<h2>{title}</h2><figure>{svg(plot(benches))}<figcaption>{html.escape(caption)}</figcaption>"
                   "</figure>")
        if plot is price_of_accuracy:
            out += [price_section(bench) for bench in benches]
    out += [more_tables(bench) for bench in benches]
    out.append("<h2>The papers' headline figures, and ours</h2>")
    for bench in benches:
        out.append(f"<h3>{html.escape(bench.device)}</h3>")
        out.append(table(["claim", "published", "measured here (faster: +)"], headline_rows(bench)))
    out.append("<h2>Speed: what we aim at, and what was reached</h2>")
    for bench in benches:
        out.append(f"<h3>{html.escape(bench.device)}</h3>")
        out.append(table(["target", "function", "wanted", "measured", "met"], target_rows(bench)))
    out.append("<h2>All entries</h2><p>ns a sample by the wall clock (best, median, spread as standard deviation over "
               "mean) and by the driver's event; errors in units of 2<sup>-24</sup> (double: 2<sup>-53</sup>) times "
               "1 + condition number. Bias: the largest error of an approximate sampler's cumulative distribution.</p>")
    for bench in benches:
        head = ["entry", "best", "median", "spread", "event", "useful", "of copy", "x published", "price",
                "err p50", "err p99", "err max", "angle max", "behind", "bias"]
        out.append(f"<details><summary>{html.escape(bench.device)}</summary>{table(head, entry_rows(bench))}</details>")
    head = ["alpha", "cos", "sampler", "rejected"] + [f"{light}, {ns} ns" for ns in (0, 100) for light in LIGHTS]
    out.append("<h2>All lobes</h2><p>Rejected samples and, as in the plots, the gain over the bounded cap in equal time.</p>"
               f"<details><summary>{html.escape(benches[0].device)}</summary>{table(head, lobe_rows(benches[0]))}</details>")
    out.append("</body></html>\n")
    return "\n".join(out)


def main(arguments):
    if len(arguments) < 2:
        sys.exit(__doc__.strip())
    text = page([Bench(path) for path in arguments[1:]])
    with open(arguments[0], "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(sys.argv[1:])
