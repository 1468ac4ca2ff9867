#!/usr/bin/env python3
"""The noise of ways to sample a light that fills a cap of directions, for bench/README.md and the page of clvndf bench.

    python3 bench/caps.py OUTPUT.json [--build build/release]

A surface of GGX facets that reflect everything, lit by one even light of half angle beta that nothing hides, `off` degrees from the
mirror direction towards the normal. Ways: `cones`, ggx_sample_wi_cone2026; `even` in the cap; `conic`, ggx_sample_wi_conic2026, all
reflections above the horizon, of which those that miss the cap bring nothing; `both`, each of these half of the time with the
density of both together. Variances of one sample, over the squared mean: second moments of all from one set of samples of the cone,
by `clvndf eval` in double. kept: the part of the samples that bring light. Times are those of a run of `clvndf bench`. Needs
numpy; exit status 77 without.
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SAMPLES = 1 << 15
ALPHAS, BETAS, THETAS, OFFS = ((0.05, 0.05), (0.2, 0.2), (0.5, 0.5), (0.1, 0.5)), (1, 5, 20), (20, 60, 80), (0, 15, 30)
LOBE = ("wo_x", "wo_y", "wo_z")
CAP = ("l_x", "l_y", "l_z", "one_minus_cos")

try:
    import numpy as np
except ImportError:
    print("caps.py: no numpy (python3-numpy)", file=sys.stderr)
    sys.exit(77)


def called(clvndf, function, columns):
    """Results of a function, one row for each; columns that are numbers stand for all rows."""
    rows = np.vstack(np.broadcast_arrays(*columns.values())).T.tolist()
    text = "\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows), ""])
    run = subprocess.run([clvndf, "eval", function, "--on", "host", "--real", "double"], input=text, text=True, check=True,
                         stdout=subprocess.PIPE)
    return np.loadtxt(run.stdout.splitlines(), delimiter=",", skiprows=1, ndmin=2).T


def stretched(w, alpha):
    return np.sqrt((alpha[0] * w[0]) ** 2 + (alpha[1] * w[1]) ** 2 + w[2] ** 2)


def direction(degrees):
    return np.sin(np.radians(degrees)), 0.0, np.cos(np.radians(degrees))


def lobe_of(theta, beta, off, alpha):
    """The view, opposite to the light's side, and the cap."""
    wo, l = direction(-theta), direction(theta - off)
    return wo, l, dict(zip((*LOBE, *CAP, "alpha_x", "alpha_y"), (*wo, *l, 2 * np.sin(np.radians(beta) / 2) ** 2, *alpha)))


def noise(clvndf, alpha, beta, theta, off):
    wo, l, lobe = lobe_of(theta, beta, off, alpha)
    u = np.random.default_rng(1).random((2, SAMPLES))
    *wi, cone = called(clvndf, "vndf_ggx_sample_wi_cone2026_with_pdf", {**lobe, "u1": u[0], "u2": u[1]})
    plain = {name: lobe[name] for name in (*LOBE, "alpha_x", "alpha_y")}
    # D / 4 over what both densities have under it: where the cone is above the surface it is the same everywhere.
    conic = called(clvndf, "vndf_ggx_pdf_wi_conic2026",
                   {**plain, "wi_x": wi[0], "wi_y": wi[1], "wi_z": wi[2]})[0]
    sigma = called(clvndf, "vndf_ggx_sigma_cap", {name: lobe[name] for name in (*LOBE, *CAP, "alpha_x", "alpha_y")})[0][0]
    even = 1 / (2 * np.pi * lobe["one_minus_cos"])
    counts = (wi[2] > 0) & (cone > 0)
    g2 = 2 * wo[2] * wi[2] / (wo[2] * stretched(wi, alpha) + wi[2] * stretched(wo, alpha))
    f = np.where(counts, cone * sigma * g2 / wo[2], 0)  # D G2 / (4 wo.z)
    cone = np.where(counts, cone, 1)
    mean = np.mean(f / cone)
    ways = {}
    for way, pdf in (("cones", cone), ("even", even), ("conic", conic), ("both", (even + conic) / 2)):
        inside = counts & (pdf > 0)
        # Of its samples those that bring light; even ones all do where the light is above the horizon.
        kept = 1.0 if way == "even" and counts.all() else min(np.mean(np.where(counts, pdf / cone, 0)), 1.0)
        spread = np.mean(np.where(inside, (f / np.where(inside, pdf, 1) - mean) ** 2 * pdf / cone, 0))
        ways[way] = {"variance": spread / mean ** 2 + 1 - kept, "kept": kept}
    return {"alpha": alpha, "beta": beta, "theta": theta, "off": off, "mean": mean, "error": np.std(f / cone) / SAMPLES ** 0.5, **ways}


def mean_of_even(clvndf, row):
    """The same mean by even samples, and its standard error: the two must agree."""
    wo, l, lobe = lobe_of(row["theta"], row["beta"], row["off"], row["alpha"])
    a, b = np.random.default_rng(2).random((2, SAMPLES))
    gap, turn = a * lobe["one_minus_cos"], 2 * np.pi * b
    radius = np.sqrt(gap * (2 - gap))
    across = np.array([l[2], 0, -l[0]])
    wi = np.outer(l, 1 - gap) + np.outer(across, radius * np.cos(turn)) + np.outer((0, 1, 0), radius * np.sin(turn))
    half = wi + np.array(wo)[:, None]
    wm = half / np.sqrt((half ** 2).sum(0))
    alphas = {"alpha_x": row["alpha"][0], "alpha_y": row["alpha"][1]}
    d = called(clvndf, "vndf_ggx_ndf", {"wm_x": wm[0], "wm_y": wm[1], "wm_z": wm[2], **alphas})[0]
    g2 = 2 * wi[2] / (wo[2] * stretched(wi, row["alpha"]) + wi[2] * stretched(wo, row["alpha"]))
    weight = np.where(wi[2] > 0, d * g2 / 4, 0) * 2 * np.pi * lobe["one_minus_cos"]
    return np.mean(weight), np.std(weight) / SAMPLES ** 0.5


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    arguments = parser.parse_args()
    clvndf = arguments.build / "clvndf"
    rows = [noise(clvndf, alpha, beta, theta, off) for alpha in ALPHAS for beta in BETAS for theta in THETAS for off in OFFS]
    for row in rows[::7]:
        mean, error = mean_of_even(clvndf, row)
        if abs(mean - row["mean"]) > 5 * (error + row["error"]):
            sys.exit(f"caps.py: {row}: by even samples the mean is {mean:.4g} +- {error:.2g}")
    short = json.loads(json.dumps(rows, default=float), parse_float=lambda number: float(f"{float(number):.3g}"))
    arguments.output.write_text(json.dumps({"samples": SAMPLES, "rows": short}, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
