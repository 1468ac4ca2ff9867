#!/usr/bin/env python3
"""Puts the figures of a run of `clvndf bench --json` into the README's tables of times and of noise.

    python3 bench/report/readme_tables.py README.md BENCH.json            rewrites the README
    python3 bench/report/readme_tables.py --check README.md BENCH.json    fails if that would change it
"""
import pathlib
import re
import sys

import report

TIMES = (("strict/float", "stream"), ("strict/float", "compute"), ("builtin/float", "stream"),
         ("strict/double", "stream"), ("cpp/float", "stream"), ("published/float", "stream"))
SHOWN_LOBES = ((0.1, 0.1), (0.5, 0.5), (1, 1), (2, 2), (0.2, 0.8), (0.3, 0.9), (0.05, 1))
SHOWN_COSINES = (0.9, 0.5, 0.2)
SHADING_NS = 100


def row(*cells):
    return "| " + " | ".join(cells) + " |\n"


def times(bench):
    def ns(value):
        return "" if value is None else f"{value:.0f}" if value >= 99.95 else f"{value:.1f}"

    def error(sampler, policy):
        value = bench.counter(f"{sampler}/{policy}/float/stream", "err_p99")
        return "" if value is None else f"{value:.2g}"

    for sampler in bench.samplers():
        yield row(f"`{sampler.removeprefix('vndf_')}`", *(ns(bench.ns(sampler, *form)) for form in TIMES),
                  error(sampler, "strict"), error(sampler, "published"))


def gains(bench):
    for alpha in SHOWN_LOBES:
        lobes = [lobe for cosine in SHOWN_COSINES for lobe in bench.lobes
                 if (lobe["alpha_x"], lobe["alpha_y"], lobe["cos_theta"]) == (*alpha, cosine)]
        conic = [lobe for lobe in lobes if lobe["sampler"].endswith("conic2026")]
        lost = [lobe["rejected"] for lobe in lobes if lobe["sampler"] == report.BOUNDED]
        columns = [", ".join(f"{report.gain(bench, lobe, light, SHADING_NS):.{2 if light == report.SMALL else 1}f}"
                             for lobe in conic)
                   for light in ("white light", "smooth light", report.SMALL, "smooth light, Sobol")]
        yield row(f"{alpha[0]:g}, {alpha[1]:g}", ", ".join(f"{100 * part:.0f} %" for part in lost), *columns)


def with_table(text, begin, rows):
    """`text` with the body of the table whose head begins with `begin` replaced."""
    body = "".join(rows)
    result, count = re.subn(rf"^({re.escape(begin)}.*\n\|[-|]+\|\n)(\|.*\n)*", lambda found: found[1] + body, text,
                            flags=re.M)
    if count != 1:
        sys.exit(f"{count} tables begin with {begin!r}")
    return result


def updated(text, bench):
    text = with_table(text, "| sampler | strict | strict, one lobe |", times(bench))
    text = with_table(text, "| αx, αy; cos θ ", gains(bench))
    copy = bench.best["copy_40B/stream"]["ns_per_sample"]
    return re.sub(r"(A plain copy of the same\s40 bytes a sample takes) [0-9.]+ ns", rf"\1 {copy:.2f} ns", text)


check = sys.argv[1] == "--check"
readme, results = sys.argv[-2:]
before = pathlib.Path(readme).read_text(encoding="utf-8")
after = updated(before, report.Bench(results))
if not check:
    pathlib.Path(readme).write_text(after, encoding="utf-8")
elif after != before:
    changed = [new for old, new in zip(before.splitlines(), after.splitlines()) if old != new]
    sys.exit("the README does not show this run:\n" + "\n".join(changed))
