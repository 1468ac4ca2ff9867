#!/usr/bin/env python3
"""Fits the polynomials of kernels/vndf/impl/polynomials.h and prints that header (needs python3-mpmath).

    python3 tests/support/fit_polynomials.py > kernels/vndf/impl/polynomials.h

Each polynomial minimises the largest weighted error on a dense grid (Remez exchange). Coefficients are then rounded one
by one, lowest power first; after each rounding the higher powers are fitted again, so that they absorb it.
"""
import struct

import mpmath as mp
from mpmath import mpf

mp.mp.dps = 50
LINES_PER_DEGREE = 24  # grid points for each coefficient


def round_to(x, real):
    if real == "double":
        return mpf(float(x))
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def alternating_extrema(error, count):
    """The `count` largest extrema of alternating sign, in order; None if there are fewer."""
    extrema = []
    for k in range(len(error)):
        if extrema and (error[k] > 0) == (error[extrema[-1]] > 0):
            if abs(error[k]) > abs(error[extrema[-1]]):
                extrema[-1] = k
        else:
            extrema.append(k)
    while len(extrema) > count:
        size = [abs(error[k]) for k in extrema]
        if len(extrema) == count + 1:
            extrema.pop(0 if size[0] < size[-1] else -1)
        else:
            pair = min(range(len(extrema) - 1), key=lambda k: max(size[k], size[k + 1]))
            del extrema[pair : pair + 2]
    return extrema if len(extrema) == count else None


def solve_minimax(powers, target, weight, basis):
    """Coefficients of sum c_j z^powers[j] that level |weight (target - sum)| over the grid; and the level."""
    count = len(powers)
    size = len(target)
    chosen = [round((size - 1) * (1 - mp.cos(mp.pi * k / count)) / 2) for k in range(count + 1)]
    best = None
    for _ in range(30):
        system = mp.matrix(count + 1, count + 1)
        right = mp.matrix(count + 1, 1)
        for row, k in enumerate(chosen):
            for column, power in enumerate(powers):
                system[row, column] = basis[k][power]
            system[row, count] = (-1) ** row / weight[k]
            right[row] = target[k]
        solution = mp.lu_solve(system, right)
        coefficients = [solution[j] for j in range(count)]
        error = [
            weight[k] * (target[k] - mp.fdot(coefficients, [basis[k][power] for power in powers])) for k in range(size)
        ]
        worst = max(abs(e) for e in error)
        if best is None or worst < best[1]:
            best = coefficients, worst
        extrema = alternating_extrema(error, count + 1)
        if extrema is None or extrema == chosen or worst < abs(solution[count]) * mpf("1.001"):
            break
        chosen = extrema
    return best


def fit(case, degree, real):
    """Rounded coefficients, lowest power first, and the largest weighted error that remains."""
    low, high = case["interval"][real]
    size = LINES_PER_DEGREE * (degree + 2)
    points = [low + (high - low) * (1 - mp.cos(mp.pi * (2 * k + 1) / (2 * size))) / 2 for k in range(size)]
    target = [case["function"](z) for z in points]
    weight = [case["weight"](z, f) for z, f in zip(points, target)]
    basis = [[z**j for j in range(degree + 1)] for z in points]
    rounded = {}
    residual = list(target)
    # On an interval with 0 inside, the powers from 1 up are no Chebyshev system: round from the highest power there.
    first = 0 if low >= 0 else -1
    while len(rounded) <= degree:
        free = [j for j in range(degree + 1) if j not in rounded]
        coefficients, _ = solve_minimax(free, residual, weight, basis)
        power = free[first]
        rounded[power] = round_to(coefficients[first], real)
        residual = [r - rounded[power] * basis[k][power] for k, r in enumerate(residual)]
    return [rounded[j] for j in range(degree + 1)], max(abs(w * r) for w, r in zip(weight, residual))


def relative(_, f):
    return 1 / abs(f)


def absolute(*_):
    return mpf(1)


# ---- targets -------------------------------------------------------------------------------------------------------


def log_tail(z):
    """(log((1 + s) / (1 - s)) - 2 s) / s^3 in z = s^2."""
    return mp.nsum(lambda k: 2 * z**k / (2 * k + 3), [0, mp.inf]) if z < 1e-4 else (
        (mp.log((1 + mp.sqrt(z)) / (1 - mp.sqrt(z))) / mp.sqrt(z) - 2) / z)


def exp_tail(r):
    """(e^r - 1 - r) / r^2."""
    return mp.nsum(lambda k: r**k / mp.factorial(k + 2), [0, 60]) if abs(r) < 1e-3 else (mp.expm1(r) - r) / r**2


def erfcx_series(x):
    """1 - sqrt(pi) x erfcx(x) = 1/(2 x^2) - 3/(2 x^2)^2 + ... for large x."""
    total, term = mpf(0), mpf(1)
    for k in range(1, 60):
        term *= -(2 * k - 1) / (2 * x * x)
        total -= term
    return total


def ierfcx(x):
    """1 - sqrt(pi) x erfcx(x)."""
    return 1 - mp.sqrt(mp.pi) * x * mp.exp(x * x) * mp.erfc(x) if x < 25 else erfcx_series(x)


def erfcx(x):
    return mp.exp(x * x) * mp.erfc(x) if x < 25 else (1 - erfcx_series(x)) / (mp.sqrt(mp.pi) * x)


def scaled_erfc_rest(v):
    """r of erfcx(x) = v ((1 + v) / (2 sqrt(pi)) + v^2 (7 / (16 sqrt(pi)) + v r)), v = 2 / (2 + x)."""
    with mp.workdps(80):
        first = 1 / (2 * mp.sqrt(mp.pi))
        return ((erfcx(half_line(v)) / v - (1 + v) * first) / v**2 - 7 * first / 8) / v


def scaled_erfc_weight(v, _):
    """Errors of r relative to erfcx(x) and to ierfcx(x)."""
    x = half_line(v)
    return v**4 / min(erfcx(x), ierfcx(x) / (mp.sqrt(mp.pi) * x))


def half_line(v):
    """x of v = 2 / (2 + x), which maps 0 ... infinity to 1 ... 0."""
    return 2 * (1 - v) / v


def log1p_rest(z):
    """(log(1 + z) - z) / z^2."""
    with mp.workdps(80):
        return (mp.log1p(z) - z) / z**2


def erfcinv_ratio(w):
    """erfcinv(q) / (1 - q) for w = -log(q (2 - q))."""
    if w == 0:
        return mp.sqrt(mp.pi) / 2
    p = mp.sqrt(-mp.expm1(-w))
    log_q = -w - mp.log1p(p)
    x = mp.sqrt(w) if w > 1 else p
    for _ in range(80):
        step = (mp.log(mp.erfc(x)) - log_q) * mp.erfc(x) * mp.sqrt(mp.pi) / 2 * mp.exp(x * x)
        x += step
        if abs(step) < x * mpf(10) ** -45:
            break
    return x / p


def kepler_half(z):
    """eta / 2 of eta - sin(eta) = k^3 / 6, z = k^2."""
    k = mp.sqrt(z)
    eta = k
    for _ in range(60):
        value = eta - mp.sin(eta) if eta > 0.01 else mp.nsum(
            lambda j: -((-1) ** j) * eta ** (2 * j + 1) / mp.factorial(2 * j + 1), [1, 12])
        step = (value - k**3 / 6) / (2 * mp.sin(eta / 2) ** 2)
        eta -= step
        if abs(step) < eta * mpf(10) ** -45:
            break
    return eta / 2


def arc(z):
    """atan(t) / (2 pi t) in z = t^2."""
    t = mp.sqrt(z)
    return mp.atan(t) / (2 * mp.pi * t)


def segment(z):
    """(atan(t) / t - 1 / (1 + t^2)) / t^2 in z = t^2; for z = -t^2 < 0 (1 / (1 - t^2) - atanh(t) / t) / t^2."""
    return mp.fsum((-z) ** k * mpf(2 * k + 2) / (2 * k + 3) for k in range(120))


KEPLER_END = mp.cbrt(6 * mp.pi) ** 2


def erfcinv_tail(shift):
    return lambda z: (z + shift) * erfcinv_ratio(1 / (z + shift) ** 2)


def erfcinv_root(z):
    return erfcinv_ratio((z + mpf("4.5")) ** 2)


def root_weight(z, f):
    """Beyond w = 25, where samples are next to none, 3 times the error will do."""
    return (1 if z + mpf("4.5") < 5 else mpf(1) / 3) / abs(f)


def tail_interval(low, high, shift):
    return 1 / mp.sqrt(mpf(high)) - shift, 1 / mp.sqrt(mpf(low)) - shift


SQRT2 = mp.sqrt(2)
MANTISSA = 1 / SQRT2 - 1, SQRT2 - 1


def piece(function, float_interval, double_interval, weight=relative):
    return dict(function=function, weight=weight, interval={"float": float_interval, "double": double_interval})


# Each case: one polynomial, or several over adjoining intervals whose coefficients are selected together.
CASES = [
    dict(name="SIN_2PI", what="sin(2 pi x) / x - 4 in z = x^2, |x| <= 1/4", kind="relative to sin(2 pi x) / x",
         degree=dict(float=4, double=9), estrin="float",
         pieces=[piece(lambda z: mp.sin(2 * mp.pi * mp.sqrt(z)) / mp.sqrt(z) - 4,
                       *[(mpf("1e-30"), mpf(1) / 16)] * 2, lambda z, f: 1 / (f + 4))]),
    dict(name="LOG", what="(log((1 + s) / (1 - s)) - 2 s) / s^3 in z = s^2, |s| <= 3 - 2 sqrt(2)",
         kind="relative to the logarithm", degree=dict(float=2, double=6),
         pieces=[piece(log_tail, *[(mpf(0), (3 - 2 * mp.sqrt(2)) ** 2)] * 2, lambda z, f: z / (2 + z * f))]),
    dict(name="EXP", what="(exp(z) - 1 - z) / z^2, |z| <= log(2) / 2", kind="relative to exp(z)",
         degree=dict(float=4, double=9), estrin="float",
         pieces=[piece(exp_tail, *[(-mp.log(2) / 2, mp.log(2) / 2)] * 2, lambda z, f: z * z / mp.exp(z))]),
    dict(name="SCALED_ERFC", what="r of erfcx and ierfcx (math.h) in v = 2 / (2 + x), x >= 0; double: in v - 1/2",
         kind="relative to either", degree=dict(float=11, double=25), estrin="float",
         pieces=[piece(scaled_erfc_rest, (mpf(0), mpf(1)), None, scaled_erfc_weight),
                 piece(lambda z: scaled_erfc_rest(z + mpf("0.5")), None, (mpf("-0.5"), mpf("0.5")),
                       lambda z, f: scaled_erfc_weight(z + mpf("0.5"), f))]),
    dict(name="LOG1P", what="(log(1 + z) - z) / z^2, z between sqrt(1/2) - 1 and sqrt(2) - 1",
         kind="relative to the logarithm", degree=dict(float=8), estrin="float",
         pieces=[piece(log1p_rest, MANTISSA, None, lambda z, f: abs(z / (1 + z * f)))]),
    dict(name="LOG1P_ROUGH", what="log(1 + z) / z, as above", kind="relative", degree=dict(float=3, double=3),
         estrin="float",
         pieces=[piece(lambda z: mp.log1p(z) / z, MANTISSA, MANTISSA)]),
    dict(name="ERFINV", what="R = erfinv(p) / p, w = -log(1 - p^2): R in z = w - 7/2, w <= 7; then, in float, in"
         " z = sqrt(w) - 9/2, w <= 42; in double, R / sqrt(w) in z = 1 / sqrt(w) - 1/4, w <= 40, and in z = 1 / sqrt(w) - 1/10, w <= 744",
         kind="relative", degree=dict(float=12, double=24), estrin="float",
         pieces=[piece(lambda z: erfcinv_ratio(z + mpf("3.5")), *[(mpf("-3.5"), mpf("3.5"))] * 2),
                 piece(erfcinv_root, (mp.sqrt(7) - mpf("4.5"), mp.sqrt(42) - mpf("4.5")), None, root_weight),
                 piece(erfcinv_tail(mpf("0.25")), None, tail_interval(7, 40, mpf("0.25"))),
                 piece(erfcinv_tail(mpf("0.1")), None, tail_interval(40, 744, mpf("0.1")))]),
    dict(name="KEPLER_SIN", what="sin(eta / 2) / k in z = k^2, eta - sin(eta) = k^3 / 6, eta <= pi", kind="relative",
         degree=dict(float=9, double=24),
         pieces=[piece(lambda z: mp.sin(kepler_half(z)) / mp.sqrt(z), *[(mpf("1e-30"), KEPLER_END)] * 2)]),
    dict(name="KEPLER_COS", what="cos(eta / 2) in z = k^2, eta - sin(eta) = k^3 / 6, eta <= pi", kind="absolute",
         degree=dict(float=9, double=24),
         pieces=[piece(lambda z: mp.cos(kepler_half(z)), *[(mpf("1e-30"), KEPLER_END)] * 2, absolute)]),
    dict(name="ARC", what="atan(t) / (2 pi t) in z = t^2, 0 <= t <= 1", kind="relative",
         degree=dict(float=9, double=20), pieces=[piece(arc, *[(mpf("1e-30"), mpf(1))] * 2)]),
    dict(name="SEGMENT", what="(atan(t) / t - 1 / (1 + t^2)) / t^2 in z = t^2, -1/4 <= z <= 1/4", kind="relative",
         degree=dict(float=8, double=18), pieces=[piece(segment, *[(-mpf(1) / 4, mpf(1) / 4)] * 2)]),
]


def literal(x, real):
    text = repr(float(x)) if real == "double" else f"{float(x):.9g}"
    return text if any(c in text for c in ".en") else text + ".0"


def print_polynomial(case, real):
    pieces = [p for p in case["pieces"] if p["interval"][real]]
    fits = [fit(p, case["degree"][real], real) for p in pieces]
    unit = mpf(2) ** (-24 if real == "float" else -53)
    error = ", ".join(mp.nstr(worst / unit, 2) for _, worst in fits)
    rows = [", ".join(literal(c, real) for c in row) for row in zip(*[c for c, _ in fits])]
    print(f"// {real}: error {error} * 2^-{24 if real == 'float' else 53}")
    if case.get("estrin") == real:
        print(f"#define VNDF_IMPL_{case['name']}(poly, c) \\")
        print(f"    poly({', '.join(f'c({row})' for row in rows)})", flush=True)
        return
    print(f"#define VNDF_IMPL_{case['name']}(FIRST, NEXT) \\")
    lines = [f"    {'NEXT' if k else 'FIRST'}({row})" for k, row in enumerate(rows[::-1])]
    print(" \\\n".join(lines), flush=True)


HEADER = """\
// The polynomials of math.h. Generated by tests/support/fit_polynomials.py; do not edit.
//
// Highest power first: FIRST(c) NEXT(c) ...; or lowest first: poly(c(...), c(...), ...). Several numbers in a row belong to
// adjoining intervals.
#ifndef VNDF_IMPL_POLYNOMIALS_H
#define VNDF_IMPL_POLYNOMIALS_H
// clang-format off"""


def print_case(case):
    print(f"\n// {case['what']}.\n// Errors are {case['kind']}.")
    if "double" not in case["degree"]:
        print("#if !VNDF_DOUBLE")
    else:
        print("#if VNDF_DOUBLE")
        print_polynomial(case, "double")
        print("#else")
    print_polynomial(case, "float")
    print("#endif")


def main():
    print(HEADER)
    for case in CASES:
        print_case(case)
    print("\n// clang-format on\n#endif")


if __name__ == "__main__":
    main()
