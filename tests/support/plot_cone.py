#!/usr/bin/env python3
"""The figure of kernels/doc/ggx_cone2026.md: what the sampler makes of the disk (needs matplotlib).

    python3 tests/support/plot_cone.py build/release/clvndf > kernels/doc/ggx_cone2026.svg

Left, rings and sectors of the disk, all as likely. Middle, the stretched normals that they become, seen along the view direction:
in grey all visible ones, dashed those that reflect above the horizon. Right, the directions, seen from above, z towards the
reader: grey the horizon, the rim of the cap and the cross of the mirror direction drawn from their definitions.
"""
import math
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from plot_conic import AZIMUTH, cross, dot, unit  # noqa: E402

plt.rcParams.update({"font.size": 8, "svg.hashsalt": "clvndf", "svg.fonttype": "none", "figure.constrained_layout.use": True})

# cos(theta) of wo, alpha; of the cap: cos(theta) and azimuth of its centre and the half angle in degrees.
LOBES = [((0.6, 0.3, 0.3), (0.75, AZIMUTH + math.pi - 0.25, 20)), ((0.4, 0.2, 0.7), (0.55, AZIMUTH + math.pi + 0.5, 30))]
RINGS, SECTORS, STEPS = 4, 12, 14


def direction(cosine, azimuth):
    sine = math.sqrt(1 - cosine * cosine)
    return [sine * math.cos(azimuth), sine * math.sin(azimuth), cosine]


def disk_lines():
    """Circles and radii of the disk: (turn, squared radius) along each."""
    circles = [[(i / (SECTORS * STEPS), ring / RINGS) for i in range(SECTORS * STEPS + 1)] for ring in range(1, RINGS + 1)]
    radii = [[(sector / SECTORS, (i / STEPS) ** 2) for i in range(STEPS + 1)] for sector in range(SECTORS)]
    return circles, radii


def sampled(clvndf, wo, cap, alpha, us):
    """The sampler's directions."""
    lobe = [*wo, *cap[0], 1 - math.cos(cap[1]), *alpha]
    rows = "\n".join(",".join(map(repr, [*lobe, *u])) for u in us)
    run = subprocess.run([clvndf, "eval", "vndf_ggx_sample_wi_cone2026", "--on", "host", "--real", "double"],
                         input=f"wo_x,wo_y,wo_z,l_x,l_y,l_z,one_minus_cos,alpha_x,alpha_y,u1,u2\n{rows}\n", text=True,
                         stdout=subprocess.PIPE, check=True)
    return [[float(x) for x in line.split(",")] for line in run.stdout.splitlines()[1:]]


def rim(cap):
    """The circle around a cap's centre."""
    l, beta = cap
    a = unit(cross(l, [0, 0, 1] if abs(l[2]) < 0.9 else [1, 0, 0]))
    b = cross(l, a)
    turns = [2 * math.pi * i / 180 for i in range(181)]
    return [[math.cos(beta) * x + math.sin(beta) * (math.cos(t) * y + math.sin(t) * z) for x, y, z in zip(l, a, b)] for t in turns]


def stretched(wo, wi, alpha):
    return unit([(wo[0] + wi[0]) / alpha[0], (wo[1] + wi[1]) / alpha[1], wo[2] + wi[2]])


def draw(row, clvndf, lobe, light):
    wo, alpha = direction(lobe[0], AZIMUTH), lobe[1:]
    cap = direction(*light[:2]), math.radians(light[2])
    s = unit([alpha[0] * wo[0], alpha[1] * wo[1], wo[2]])
    right = unit(cross([0, 0, 1], s))
    up = cross(s, right)
    seen = lambda m: (dot(m, right), dot(m, up))
    turns = [2 * math.pi * i / 360 for i in range(361)]
    circles, radii = disk_lines()
    lines = circles + radii
    wi = iter(sampled(clvndf, wo, cap, alpha, [u for line in lines for u in line]))
    drawn = [[next(wi) for _ in line] for line in lines]
    colours = ["#d62728"] * len(circles) + ["#1f77b4"] * len(radii)
    disk, normals, directions = row
    for line, became, colour in zip(lines, drawn, colours):
        style = {"color": colour, "linewidth": 0.7}
        disk.plot(*zip(*[(math.sqrt(r) * math.cos(2 * math.pi * t), math.sqrt(r) * math.sin(2 * math.pi * t)) for t, r in line]), **style)
        normals.plot(*zip(*[seen(stretched(wo, w, alpha)) for w in became]), **style)
        directions.plot(*zip(*[w[:2] for w in became]), **style)
    outline = [(math.cos(t), math.sin(t)) for t in turns[:181]]
    away = unit([s[0], s[1], 0])
    outline += [seen([math.cos(t) * r + math.sin(t) * a for r, a in zip([-x for x in right], away)]) for t in turns[:181]]
    normals.plot(*zip(*outline), color="#7f7f7f", linewidth=0.8)
    horizon = [stretched(wo, [math.cos(t), math.sin(t), 0], alpha) for t in turns]
    normals.plot(*zip(*map(seen, horizon)), color="#7f7f7f", linewidth=0.8, linestyle="--")
    directions.plot([math.cos(t) for t in turns], [math.sin(t) for t in turns], color="#7f7f7f", linewidth=0.8)
    directions.plot(*zip(*[w[:2] for w in rim(cap)]), color="k", linewidth=0.4, linestyle=":")
    directions.plot(-wo[0], -wo[1], "k+", markersize=4)
    disk.set_title("disk")
    normals.set_title(f"normals, cos $\\theta$ = {lobe[0]}, $\\alpha$ = {alpha}")
    directions.set_title(f"directions, $\\beta$ = {light[2]}°")
    for axes in row:
        axes.set_aspect("equal")
        axes.set_xticks([])
        axes.set_yticks([])


def main():
    figure, grid = plt.subplots(len(LOBES), 3, figsize=(7, 4.8))
    for row, (lobe, light) in zip(grid, LOBES):
        draw(row, sys.argv[1], lobe, light)
    figure.savefig(sys.stdout.buffer, format="svg", metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    main()
