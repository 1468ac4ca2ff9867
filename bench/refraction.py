#!/usr/bin/env python3
"""What the choice between reflection and refraction costs in variance, from inside glass, where many normals reflect all light.

    python3 bench/refraction.py OUTPUT.json [--build build/release]

Of what a surface sends of light from all sides: `white`, the same from everywhere, and `smooth`, 1 + w . (0.6, 0.3, 0.5) for
directions w away from the surface. Ways to draw, all from visible normals: `after`, by the reflectance of the normal that was
drawn; `before`, with the best probability there is for this lobe and light; `cone`, the same, and refractions by the normals that do
not reflect all light alone: for eta < 1 those of an elliptic cone, (wo . g)^2 > (1 - eta^2) |g|^2. The estimators' second
moments come from one set of normals, by `clvndf eval`. Needs numpy; exit status 77 without.
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
NORMALS = 1 << 18
INDICES, ALPHAS, ANGLES = (1.33, 1.5, 2.4), ((0.1, 0.1), (0.3, 0.3), (0.5, 0.2), (0.8, 0.8)), (20, 45, 65)

try:
    import numpy as np
except ImportError:
    sys.exit(77)


def normals_of(clvndf, wo, alpha):
    u = np.random.default_rng(1).random((2, NORMALS))
    columns = np.broadcast_to(np.array([*wo, *alpha])[:, None], (5, NORMALS))
    rows = "\n".join(",".join(map(repr, row)) for row in np.vstack([columns, u]).T.tolist())
    run = subprocess.run([clvndf, "eval", "vndf_ggx_sample_wm_dupuy2023", "--on", "host", "--real", "double"],
                         input=f"wo_x,wo_y,wo_z,alpha_x,alpha_y,u1,u2\n{rows}\n", stdout=subprocess.PIPE, text=True, check=True)
    return np.loadtxt(run.stdout.splitlines(), delimiter=",", skiprows=1).T


def g1(w, alpha):
    tan2 = ((alpha[0] * w[0]) ** 2 + (alpha[1] * w[1]) ** 2) / w[2] ** 2
    return 2 / (1 + np.sqrt(1 + tan2))


def variances(clvndf, index, alpha, angle):
    """Of each way and light; eta is 1 / index, the frame's z points into the glass, where wo is."""
    eta, theta = 1 / index, np.radians(angle)
    wo = np.array([np.sin(theta), 0, np.cos(theta)])
    m = normals_of(clvndf, wo, alpha)
    c = wo @ m
    square = c * c + eta * eta - 1  # (eta cos_t)^2
    passes = square > 0
    t = np.sqrt(np.maximum(square, 0)) / eta
    f = np.where(passes, (((c - eta * t) / (c + eta * t)) ** 2 + ((eta * c - t) / (eta * c + t)) ** 2) / 2, 1)
    mirrored = 2 * c * m - wo[:, None]
    refracted = (c / eta - t) * m - wo[:, None] / eta
    masked = {w: g1(d, alpha) * (sign * d[2] > 0) for w, d, sign in (("r", mirrored, 1), ("t", refracted, -1))}
    found = {}
    for light, radiance in (("white", lambda d: 1), ("smooth", lambda d: 1 + np.tensordot((0.6, 0.3, 0.5), d, 1))):
        r, s = masked["r"] * radiance(mirrored), masked["t"] * radiance(refracted) * passes
        mean = np.mean(f * r + (1 - f) * s)
        share = np.mean(passes)
        a, b = np.sqrt(np.mean((f * r) ** 2)), np.sqrt(np.mean(((1 - f) * s) ** 2))
        found[light] = {"after": np.mean(f * r ** 2 + (1 - f) * s ** 2) - mean ** 2, "before": (a + b) ** 2 - mean ** 2,
                        "cone": (a + np.sqrt(share) * b) ** 2 - mean ** 2}
    return {"index": index, "alpha": alpha, "angle": angle, "all_reflected": 1 - np.mean(passes), **found}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    arguments = parser.parse_args()
    rows = [variances(arguments.build / "clvndf", index, alpha, angle)
            for index in INDICES for alpha in ALPHAS for angle in ANGLES]
    short = json.loads(json.dumps(rows, default=float), parse_float=lambda number: float(f"{float(number):.3g}"))
    arguments.output.write_text(json.dumps({"normals": NORMALS, "rows": short}, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
