#!/usr/bin/env python3
"""Fits kernels/vndf/impl/beckmann_start.h and prints that header (needs python3-scipy; half a minute).

    python3 tests/support/fit_beckmann_start.py > kernels/vndf/impl/beckmann_start.h

A start is judged by what is left of its error after the one step of fifth order that follows
(vndf_impl_slope_step of impl/beckmann_slopes.h): weighted least squares on a grid, whose weights grow where that error, over
its tolerance, is large. In double a second step follows, and 1e-4 of the slope may be left by the first.
"""
import numpy as np
from scipy.special import erfcx

ROOT_PI = np.sqrt(np.pi)
EPSILON = 2.0**-24
DEGREES_NU = 4, 4, 4, 3, 3  # of the polynomials in nu that belong to s^0, s^1, ...
EDGE_FRONT, EDGE_BEHIND = 0.27, 0.1  # below these (behind: times s) y is that of the edge, not of the polynomial
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def hidden_area(x):
    """e^(x^2) ierfc(x), x >= 0: twice ierfcx of impl/math.h, as all masses here are twice those of the kernels."""
    z = 1 / np.maximum(x, 1) ** 2
    series = (0.5 - z * (0.75 - z * (1.875 - z * (6.5625 - z * (29.53125 - z * 162.421875))))) * z / ROOT_PI
    return np.where(x > 30, series, 1 / ROOT_PI - x * erfcx(np.minimum(x, 30)))


def edge_integral(z, w):
    """Integral of 2 (1 - tau) e^(z tau - w tau^2) over 0 < tau < 1."""
    tau = (NODES + 1) / 2
    return sum(weight * (1 - t) * np.exp(z * t - w * t * t) for weight, t in zip(WEIGHTS, tau))


def bisect(low, high, is_low):
    for _ in range(80):
        middle = (low + high) / 2
        go_on = is_low(middle)
        low, high = np.where(go_on, middle, low), np.where(go_on, high, middle)
    return (low + high) / 2


class Side:
    """The slopes seen from one side, over a grid of nu and s."""

    def __init__(self, front, nu_low, nu_high):
        nu = np.linspace(nu_low, nu_high, 101)
        product = np.exp(-nu * nu) / 4
        small = 2 * product / (1 + np.sqrt(np.maximum(1 - 4 * product, 0)))
        grid_s = np.clip((1 - np.cos(np.linspace(0, np.pi, 60))) / 2, 2e-4, 1)
        self.front = front
        self.nu, self.s = np.meshgrid(nu, grid_s, indexing="ij")
        self.u = np.broadcast_to(np.where(nu < 0, small, 1 - small)[:, None], self.nu.shape)
        self.q = np.broadcast_to(np.where(nu < 0, 1 - small, small)[:, None], self.nu.shape)
        self.a = 2 * (1 - self.s) / self.s
        self.cot = self.a if front else -self.a
        self.gaussian = np.exp(-self.a**2) if front else 1.0
        self.hidden = self.gaussian * hidden_area(self.a)
        self.area = 2 * self.a + self.hidden if front else self.hidden
        self.y = self.exact()
        self.x = self.cot - self.y
        density = 2 * self.y * self.exponential(-1, self.y) / ROOT_PI / self.area
        accuracy = np.minimum(self.u, 8 * self.q) / density
        self.tolerance = EPSILON * (accuracy + 0.5 * (np.abs(self.x) if front else self.y))
        # The first terms of the mass next to the edge, 2 % too far: vndf_impl_slope_start is from -1 to 5 %.
        close = np.sqrt(ROOT_PI * self.q * self.area / np.maximum(self.gaussian, 1e-130))
        self.edge = close < (EDGE_FRONT if front else EDGE_BEHIND * self.s)
        close = np.where(self.edge, close, 0)
        self.start_at_edge = 1.02 * close * (1 - 0.5 * self.cot * close)
        self.least = EDGE_FRONT / 2 if front else EDGE_BEHIND / 2 * self.s

    def exponential(self, sign, y):
        """e^(+-x^2), behind the surface relative to e^(a^2)."""
        square = (self.cot - y) ** 2 if self.front else y * (2 * self.a + y)
        return np.exp(sign * np.minimum(square, 600))

    def above(self, y):
        """The mass between y and the edge, without cancellation for small y."""
        x = self.cot - y
        return y * y / ROOT_PI * edge_integral(-2 * x * y, y * y) * self.exponential(-1, y)

    def below(self, y):
        x = self.cot - y
        near, e = erfcx(np.abs(x)), self.exponential(-1, y)
        if not self.front:
            return (hidden_area(-x) + y * near) * e
        return np.where(x < 0, (1 / ROOT_PI + self.a * near) * e, 2 * self.a + (1 / ROOT_PI - self.a * near) * e)

    def exact(self):
        if self.front:
            low, high = self.a - np.minimum(self.a, 8.5), self.a + 8.5
            sum_above = lambda y: self.hidden - (1 / ROOT_PI - self.a * erfcx(np.abs(self.a - y))) * self.exponential(-1, y)
            beyond = lambda y: np.where(self.a - y > 0.3, sum_above(y) < self.q * self.area, self.below(y) > self.u * self.area)
        else:
            low, high = np.zeros_like(self.a), np.minimum(9.0, 90 / np.maximum(2 * self.a, 1e-30))
            beyond = lambda y: self.below(y) > self.u * self.area
        y = bisect(low, high, beyond)
        return np.where((self.q < 0.2) & (y < 0.6), bisect(0 * y, 0 * y + 0.7, lambda y: self.above(y) < self.q * self.area), y)

    def step(self, y):
        x = self.cot - y
        e = self.exponential(1, y)
        far = self.below(y) * e - self.u * self.area * e
        if self.front:
            right = (1 / ROOT_PI - self.a * erfcx(np.abs(x))) - (self.u * self.hidden - 2 * self.a * self.q) * e
            far = np.where(x > 0, right, far)
        near = self.q * self.area * e - self.above(y) * e
        close = (y < 0.6) & (np.abs(x * y) < 0.6)
        v = ROOT_PI * np.where(close, near, far) / y
        k, l = v * x, -0.5 * self.cot * v * v / y
        m = 0.75 * self.cot * v**3 / y**2
        high = 1 + k + (k * k + l) / 6
        low = 1 + 1.5 * k + 7 / 12 * k * k + k**3 / 24 + l * (1 / 3 + k / 8) + m / 24
        n = np.maximum(v / y * high, -low)
        return y * (1 + n * (n / 4 + low / 2) / (low * (low + 0.75 * n) + n * n / 16))

    def error(self, start):
        """What the step leaves of a polynomial's error, over the tolerance."""
        far = np.maximum(self.a - start if self.front else self.s * start, self.least)
        error = np.abs(self.step(np.where(self.edge, self.start_at_edge, far)) - self.y) / self.tolerance
        return np.where(np.isfinite(error), error, 1e6)

    def fit(self, rounds=600):
        powers = [(i, j) for j, degree in enumerate(DEGREES_NU) for i in range(degree + 1)]
        basis = np.stack([self.nu**i * self.s**j for i, j in powers], -1).reshape(-1, len(powers))
        size = np.linalg.norm(basis, axis=0)
        target = (self.x if self.front else self.y / self.s).ravel()
        inside = ~self.edge.ravel()
        weight = np.where(inside, 1.0, 1e-6)
        best, coefficients = np.inf, None
        for k in range(rounds):
            solution = np.linalg.lstsq(basis / size * weight[:, None], target * weight, rcond=1e-14)[0]
            error = self.error((basis / size @ solution).reshape(self.nu.shape)).ravel()
            if error.max() < best:
                best, coefficients = error.max(), solution / size
            pace = (0.3, 0.1, 0.03)[3 * k // rounds]
            weight = np.where(inside, weight * (1 - pace + 2 * pace * (error / error.max()) ** 0.2), 1e-6)
            weight = np.where(inside, weight / weight.max(), 1e-6)
        return best, np.split(coefficients, np.cumsum(np.array(DEGREES_NU) + 1)[:-1])


def fit_edge():
    """The integral next to the edge for w <= 1/16, |z| <= 2/5, 1 at 0; errors in eps of the mass 1, of which it is q."""
    y, z = np.meshgrid(0.25 * (1 - np.cos(np.linspace(0, np.pi, 36))) / 2, 0.4 * np.cos(np.linspace(0, np.pi, 36)))
    w, z = (y * y).ravel(), z.ravel()
    share = np.maximum(w, z * z / 8) + 0.02
    powers = [(i, j) for j in range(3) for i in range(6 - 2 * j)][1:]
    basis = np.stack([z**i * w**j for i, j in powers], -1)
    size = np.abs(basis).max(0)
    target = edge_integral(z, w) - 1
    lawson, best, coefficients = np.ones(len(w)), np.inf, None
    for _ in range(400):
        scale = np.sqrt(lawson) * share
        solution = np.linalg.lstsq(basis / size * scale[:, None], target * scale, rcond=1e-15)[0]
        error = np.abs(basis / size @ solution - target) * share / EPSILON
        if error.max() < best:
            best, coefficients = error.max(), solution / size
        lawson = lawson * error
        lawson /= lawson.sum()
    return best, np.concatenate([[1.0], coefficients])


def literal(x):
    text = f"{np.float32(x):.9g}"
    return text if any(c in text for c in ".en") else text + ".0"


def print_start(real, nu_low, nu_high, tolerance):
    front, behind = Side(True, nu_low, nu_high), Side(False, nu_low, nu_high)
    front.tolerance = front.tolerance * tolerance
    behind.tolerance = behind.tolerance * tolerance
    (worst_front, in_front), (worst_behind, hidden) = front.fit(), behind.fit()
    print(f"// {real}: at most {worst_front:.2g} of the tolerance is left in front, {worst_behind:.2g} behind.")
    for j, (f, b) in enumerate(zip(in_front, hidden)):
        print(f"#define VNDF_IMPL_START_{j}(poly, c) \\")
        print(f"    poly({', '.join(f'c({literal(x)}, {literal(y)})' for x, y in zip(f, b))})")


def main():
    print("""\
// Where the inversion of the visible slopes of the Beckmann distribution starts, and the mass next to its edge. Generated by
// tests/support/fit_beckmann_start.py; do not edit.
//
// VNDF_IMPL_START_j(poly, c): the polynomial in nu, lowest power first, that belongs to s^j; c(in front, behind).
// VNDF_IMPL_EDGE(poly, c): the coefficients of z^i w^j for i + 2 j <= 5, i running first.
#ifndef VNDF_IMPL_BECKMANN_START_H
#define VNDF_IMPL_BECKMANN_START_H
// clang-format off
#if VNDF_DOUBLE""")
    # nu of u from 2^-65 to 1 - 2^-53 in double, from 2^-33 to 1 - 2^-24 in float.
    print_start("double", -6.66, 6.0, 1e-4 / EPSILON)
    print("#else")
    print_start("float", -4.71, 3.93, 1)
    worst, coefficients = fit_edge()
    print(f"// Error {worst:.2g} * 2^-24 of u.")
    print(f"#define VNDF_IMPL_EDGE(poly, c) \\\n    poly({', '.join(f'c({literal(x)})' for x in coefficients)})")
    print("#endif\n\n// clang-format on\n#endif")


if __name__ == "__main__":
    main()
