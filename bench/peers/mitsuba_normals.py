"""Visible normals of Mitsuba 3 (its llvm variant) beside ours (OpenCL), over the same arrays in one run: times, and
errors against the reference of `clvndf`.

Needs the packages of requirements.txt, PoCL and, for Dr.Jit below Mitsuba, an LLVM library: the newest installed one,
or what DRJIT_LIBLLVM_PATH names. Exit status 2, with one line, where something is missing.
"""
import argparse
import itertools
import json
import os
import pathlib
import random
import subprocess
import time

from mitsuba_and_pocl import cl, dr, mi, np, pocl, queue
from newest_llvm import cannot

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPTIONS = "-cl-std=CL1.2 -DVNDF_REAL=float -DVNDF_MATH=strict -cl-fp32-correctly-rounded-divide-sqrt"
# Mitsuba's samplers, each with the function that is the same map.
THEIRS = {"Mitsuba GGX": "vndf_ggx_sample_wm_heitz2018", "Mitsuba Beckmann": "vndf_beckmann_sample_wm_jakob2014"}
OURS = ("vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wm_heitz2018", "vndf_beckmann_sample_wm_heitz_deon2014",
        "vndf_beckmann_sample_wm_jakob2014")
SIZES = {"memory": 1 << 22, "cache": 1 << 18}  # samples of 40 bytes: 160 MiB and 10 MiB
INPUTS = ("as timed", "α 10⁻³", "α 10⁻⁵", "cos θ 10⁻⁶ to 10⁻²", "u within 2⁻¹² of 0 or 1", "behind the surface")
JUDGED = 1 << 13  # samples of each of these
IDLE_S = 0.02  # Dr.Jit's threads spin half as long after a launch, and would double the time of whoever comes next
EPS = 2.0 ** -24


def columns_of(kind, count):
    """wo, alpha and u in seven columns, and four for OpenCL's results, each where the widest vectors begin."""
    r = np.random.default_rng(1).random((6, count))
    z = {"cos θ 10⁻⁶ to 10⁻²": 1e-6 * 1e4 ** r[0], "behind the surface": r[0] - 1}.get(kind, 1 - r[0])
    sine, phi = np.sqrt((1 - z) * (1 + z)), 2 * np.pi * r[1]
    u = np.floor(1 + r[4:] * (2 ** 24 - 1)) * EPS  # not 0, which is clamped to another number in float than in double
    if kind.startswith("u"):
        u = np.ceil(2 ** (12 * (2 * r[4:] % 1))) * EPS
        u = np.where(r[4:] < 0.5, u, 1 - u)
    memory = np.empty(11 * (count + 16) + 16, np.float32)
    begin = -(memory.ctypes.data // 4) % 16
    columns = memory[begin:begin + 11 * (count + 16)].reshape(11, -1)[:, :count]
    columns[:3] = sine * np.cos(phi), sine * np.sin(phi), z
    columns[3:5] = {"α 10⁻³": 1e-3, "α 10⁻⁵": 1e-5}.get(kind, 1e-3 ** r[2:4])
    columns[5:7] = u
    return columns


# Both make a run: a generator that gets ready, and on the next step launches, waits and yields the columns of results.
def mitsuba(name, with_pdf):
    def run(columns):
        arrays = [mi.Float(column) for column in columns[:7]]
        ndf = getattr(mi.MicrofacetType, name.split()[1])
        wm, pdf = mi.MicrofacetDistribution(ndf, *arrays[3:5]).sample(mi.Vector3f(arrays[:3]), mi.Point2f(arrays[5:]))
        results = [wm.x, wm.y, wm.z, pdf][:3 + with_pdf]
        yield
        dr.eval(results)
        dr.sync_thread()
        yield results
    return run


def opencl(function, with_pdf):
    source = ('#include "vndf/vndf.h"\n#include "batch/entry_point.h"\n'
              "VNDF_FN VNDF_REAL3 copy(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {\n"
              "    return VNDF_MAKE3(wo.x + alpha.x + u.x, wo.y + alpha.y + u.y, wo.z);\n}\n"
              f"VNDF_ENTRY_POINT(entry, {function}{'_with_pdf' * with_pdf}, WO_ALPHA_U, WM{'_PDF' * with_pdf})\n")
    kernel = cl.Program(queue.context, source).build([*OPTIONS.split(), "-I", str(ROOT / "kernels")]).entry

    def run(columns):
        buffers = [cl.Buffer(queue.context, cl.mem_flags.USE_HOST_PTR, hostbuf=c) for c in columns[:10 + with_pdf]]
        kernel.set_args(*buffers, np.uint32(0))
        yield
        cl.enqueue_nd_range_kernel(queue, kernel, (columns.shape[1],), (64,))
        queue.finish()
        yield columns[7:10 + with_pdf]  # a CPU device works on the arrays themselves
    return run


def launched(run, columns):
    """The results of a run, and the seconds of its launch."""
    steps = run(columns)
    next(steps)
    start = time.perf_counter()
    results = next(steps)
    return results, time.perf_counter() - start


def measure(runs, columns, repetitions):
    """Nanoseconds a sample of each at both sizes, under two names, all in turn in random order."""
    ns = {(what, size): ([], []) for what in runs for size in SIZES}
    for repetition in range(repetitions):
        for (what, size), again in random.Random(repetition).sample([*itertools.product(ns, range(2))], 2 * len(ns)):
            time.sleep(IDLE_S)
            launched(runs[what], columns[size])  # fetches the code, and what fits the cache
            for _ in range(SIZES["memory"] // SIZES[size]):
                ns[what, size][again].append(launched(runs[what], columns[size])[1] / SIZES[size] * 1e9)
    return ns


def u_of_heitz2018(u1, u2):
    """What our map, by azimuth and radius^2, takes where Mitsuba's, by concentric squares with x mirrored, takes u."""
    x, y = 2 * u1 - 1, 2 * u2 - 1
    steep = abs(x) < abs(y)
    r, other = np.where(steep, (y, x), (x, y))
    phi = np.pi / 4 * other / np.where(r == 0, 1, r)
    phi = np.where(steep, np.pi / 2 - phi, phi)
    return np.arctan2(r * np.sin(phi), -r * np.cos(phi)) / (2 * np.pi) % 1, r * r


def exact_map(clvndf, function, columns):
    lines = ["wo_x,wo_y,wo_z,alpha_x,alpha_y,u1,u2", *(",".join(map(float.hex, row)) for row in columns.T.tolist()), ""]
    run = subprocess.run([clvndf, "eval", f"{function}_with_pdf", "--on", "reference", "--real", "double"],
                         input="\n".join(lines), stdout=subprocess.PIPE, text=True, check=True)
    return np.loadtxt(run.stdout.splitlines(), delimiter=",", skiprows=1).T


def errors(results, exact, wo):
    wm, finite = results[:3], np.isfinite(results).all(axis=0)
    with np.errstate(all="ignore"):
        chord = np.linalg.norm(wm / np.linalg.norm(wm, axis=0) - exact[:3], axis=0)
        angle = np.where(finite, 2 * np.arcsin(np.minimum(chord / 2, 1)), np.pi) / EPS
        density = np.where(finite, abs(results[3] / exact[3] - 1), 1)
        outside = finite & ((wm[2] < -4 * EPS) | ((wm * wo).sum(axis=0) < -4 * EPS))
    return {"angle_p50": np.median(angle), "angle_p99": np.percentile(angle, 99), "angle_max": angle.max(),
            "density_p99": np.percentile(density, 99), "not_finite": int(sum(~finite)), "outside": int(sum(outside))}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    parser.add_argument("--repetitions", type=int, default=40)
    arguments = parser.parse_args()
    clvndf = arguments.build / "clvndf"
    if not os.access(clvndf, os.X_OK):
        cannot(f"no command {clvndf}: build it, or name its folder by --build")
    columns = {size: columns_of("as timed", count) for size, count in SIZES.items()}
    runs, times, judged = {}, {}, []
    for name, with_pdf in [("copy", False), *itertools.product([*THEIRS, *OURS], (False, True))]:
        start = time.perf_counter()
        runs[name, with_pdf] = (mitsuba if name in THEIRS else opencl)(name, with_pdf)
        launched(runs[name, with_pdf], columns["cache"])
        times[name, with_pdf] = {"name": name, "with_pdf": with_pdf, "first_call_s": time.perf_counter() - start}
    for (what, size), ns in measure(runs, columns, arguments.repetitions).items():
        times[what].update({f"{size}_best": list(map(min, ns)), f"{size}_median": list(map(np.median, ns))})
    for kind, name in itertools.product(INPUTS, [*THEIRS, *OURS]):
        if kind.startswith("behind") and name == "vndf_beckmann_sample_wm_heitz_deon2014":
            continue  # not defined there
        rows = columns_of(kind, JUDGED)
        results = np.array([np.array(column, np.float64) for column in launched(runs[name, True], rows)[0]])
        wide = rows[:7].astype(np.float64)
        if name == "Mitsuba GGX":
            wide[5:] = u_of_heitz2018(*wide[5:])
        exact = exact_map(clvndf, THEIRS.get(name, name), wide)
        judged.append({"name": name, "inputs": kind, **errors(results, exact, wide[:3])})
    context = {"date": time.strftime("%Y-%m-%d"), "device": queue.device.name, "platform_version": pocl.version,
               "build_options": OPTIONS, "opencl_threads": queue.device.max_compute_units,
               "mitsuba": mi.__version__, "mitsuba_variant": mi.variant(), "drjit": dr.__version__,
               "drjit_threads": dr.thread_count(), "llvm": ".".join(map(str, dr.detail.llvm_version())),
               "mitsuba_least_alpha": mi.MicrofacetDistribution(mi.MicrofacetType.GGX, mi.Float(0)).alpha()[0],
               "samples": SIZES, "judged": JUDGED, "repetitions": arguments.repetitions, "load": os.getloadavg()}
    text = json.dumps({"context": context, "times": [*times.values()], "errors": judged})
    short = json.loads(text, parse_float=lambda number: float(f"{float(number):.4g}"))
    arguments.output.write_text(json.dumps(short, indent=1, ensure_ascii=False) + "\n", "utf-8")


if __name__ == "__main__":
    main()
