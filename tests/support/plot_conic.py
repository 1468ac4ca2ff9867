#!/usr/bin/env python3
"""The figure of kernels/doc/ggx_conic2026.md: which stretched normals reflect above the horizon (needs matplotlib).

    python3 tests/support/plot_conic.py > kernels/doc/ggx_conic2026.svg

The horizon's curve is drawn from its definition, the half vectors of wo and (cos phi, sin phi, 0), stretched back.
"""
import math
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

plt.rcParams.update({"font.size": 8, "svg.hashsalt": "clvndf", "svg.fonttype": "none",
                     "figure.constrained_layout.use": True})

LOBES = [(0.9, 0.5, 0.5), (0.5, 0.5, 0.5), (0.5, 0.3, 0.9), (0.5, 0.9, 0.1), (0.2, 0.3, 0.9), (0.9, 1.5, 3.0)]
AZIMUTH = 0.7


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def draw(axes, cosine, ax, ay):
    sine = math.sqrt(1 - cosine * cosine)
    wo = [sine * math.cos(AZIMUTH), sine * math.sin(AZIMUTH), cosine]
    s = unit([ax * wo[0], ay * wo[1], wo[2]])
    right = unit(cross([0, 0, 1], s))
    up = cross(s, right)
    seen = lambda m: (dot(m, right), dot(m, up))
    turns = [2 * math.pi * i / 360 for i in range(361)]
    # Visible normals: the upper half of the silhouette, and the horizon of normals.
    outline = [seen([math.cos(t) * r + math.sin(t) * u for r, u in zip(right, up)]) for t in turns[:181]]
    # From the silhouette's left end, below the view direction, to its right end.
    away = unit([s[0], s[1], 0])
    outline += [seen([math.cos(t) * r + math.sin(t) * a for r, a in zip([-x for x in right], away)]) for t in turns[:181]]
    horizon = [seen(unit([(wo[0] + math.cos(t)) / ax, (wo[1] + math.sin(t)) / ay, wo[2]])) for t in turns]
    axes.fill(*zip(*horizon), color="#1f77b4", alpha=0.5, linewidth=0)
    axes.plot(*zip(*horizon), color="#1f77b4", linewidth=1)
    axes.plot(*zip(*outline), color="#7f7f7f", linewidth=0.8)
    axes.plot(0, 0, "k+", markersize=4)
    axes.set_title(f"cos $\\theta$ = {cosine}, $\\alpha$ = ({ax}, {ay})")
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])


def main():
    figure, grid = plt.subplots(2, 3, figsize=(7, 4.6))
    for axes, lobe in zip(grid.flat, LOBES):
        draw(axes, *lobe)
    figure.savefig(sys.stdout.buffer, format="svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
