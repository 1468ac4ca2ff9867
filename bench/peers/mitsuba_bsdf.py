"""Rough conductor and rough dielectric of Mitsuba 3 (its llvm variant) beside ours (OpenCL): values, densities and the
weights of samples at the same random inputs, with the separable G and plain visible normals on our side.

Who is off is told by our formulas in double, at the same inputs. Mitsuba's Beckmann has a rational G1; what is left with the
exact one in its place is told, too. Needs what mitsuba_normals.py does. Exit status 2, with one line, where something is
missing.
"""
import argparse
import itertools
import json
import math
import pathlib
import time

from mitsuba_and_pocl import cl, mi, np, pocl, queue

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPTIONS = "-cl-std=CL1.2 -DVNDF_MATH=strict -cl-fp32-correctly-rounded-divide-sqrt"
SWITCHES = {"SAMPLING": "plain", "MASKING": "separable", "FRESNEL": "conductor", "LAMBERT": 0, "TINT": 0,
            "SHADING_NORMAL": 0, "ENERGY": "none"}
TEXELS = (250, 400)
ROWS = TEXELS[0] * TEXELS[1]
BEYOND = 1e-4  # what share of the inputs differs by more is told


def uniform(random, low, high):
    return random.uniform(low, high, ROWS).astype(np.float32)


def sphere(random, least):
    """Directions, float32 columns, with a cosine above `least`."""
    z, phi = random.uniform(least, 1, ROWS), random.uniform(0, 2 * np.pi, ROWS)
    sine = np.sqrt((1 - z) * (1 + z))
    return np.array([sine * np.cos(phi), sine * np.sin(phi), z], np.float32)


class Inputs:
    """Random materials, wo and u. Indices stay away from 1, where a half vector of refraction has no digits left."""
    def __init__(self, what, anisotropic):
        random = np.random.default_rng(1)
        self.conductor = what == "conductor"
        self.alpha_x = np.exp(uniform(random, np.log(0.02), 0))
        self.alpha_y = np.exp(uniform(random, np.log(0.02), 0)) if anisotropic else self.alpha_x
        self.eta, self.k = np.exp(uniform(random, np.log(0.1), np.log(4))), uniform(random, 0, 8)
        self.ior = np.exp(uniform(random, np.log(1.1), np.log(2.5)) * np.sign(random.uniform(-1, 1, ROWS)))
        self.wo = sphere(random, 0.01 if self.conductor else -1)
        self.u1, self.u2, self.u_lobe = (uniform(random, 0.001, 0.999) for _ in range(3))
        self.anywhere = sphere(random, 0.01 if self.conductor else -1)


class Ours:
    def __init__(self, switches, real):
        words = " ".join(f"-DVNDF_{name}={value}" for name, value in switches.items())
        self.type = np.float32 if real == "float" else np.float64
        self.program = cl.Program(queue.context, '#include "batch/bsdf.cl"\n').build(
            [*OPTIONS.split(), "-cl-kernel-arg-info", f"-DVNDF_REAL={real}", *words.split(), "-I", str(ROOT / "kernels")])

    def run(self, name, first, i, outputs):
        """An entry point of batch/bsdf.cl over columns: `first`, and the material by its arguments' names, 0 unless said."""
        one, none = np.ones(ROWS), np.zeros(ROWS)
        material = {"alpha_x": i.alpha_x, "alpha_y": i.alpha_y, "metal": one if i.conductor else none, "ior": i.ior,
                    "transmission": one, "specular": one, "ng_z": one}
        for colour, column in (("first", i.eta), ("second", i.k), ("tint", one), ("transmittance", one),
                               ("specular_colour", one)):
            material.update({f"{colour}_{channel}": column for channel in "rgb"})
        kernel = cl.Kernel(self.program, name)
        arguments = [kernel.get_arg_info(k, cl.kernel_arg_info.NAME) for k in range(len(first), kernel.num_args - outputs)]
        columns = [np.ascontiguousarray(column, self.type)
                   for column in (*first, *(material.get(argument.removeprefix("in_"), none) for argument in arguments))]
        flags = cl.mem_flags
        buffers = [cl.Buffer(queue.context, flags.READ_ONLY | flags.COPY_HOST_PTR, hostbuf=c) for c in columns]
        results = [np.empty(ROWS, self.type) for _ in range(outputs)]
        out = [cl.Buffer(queue.context, flags.WRITE_ONLY, r.nbytes) for r in results]
        kernel(queue, (ROWS,), (32,), *buffers, *out)
        for result, buffer in zip(results, out):
            cl.enqueue_copy(queue, result, buffer)
        return results

    def eval_pdf(self, i, wi):
        f, _, _, pdf = self.run("vndf_batch_bsdf_eval_pdf", [*i.wo, *wi], i, 4)
        return f, pdf

    def sample(self, i):
        r = self.run("vndf_batch_bsdf_sample", [*i.wo, i.u1, i.u2, i.u_lobe], i, 8)
        return np.array(r[:3]), r[3], r[6]


def texture(column):
    """One texel for each row: what is not a texture is one number for all."""
    return {"type": "bitmap", "bitmap": mi.Bitmap(column.reshape(TEXELS)), "raw": True, "filter_type": "nearest",
            "format": "variant"}


class Theirs:
    def __init__(self, ndf, i, transport):
        kind = {"type": "roughdielectric"}
        if i.conductor:
            kind = {"type": "roughconductor", "eta": texture(i.eta), "k": texture(i.k)}
        self.bsdf = mi.load_dict({**kind, "distribution": ndf, "sample_visible": True, "alpha_u": texture(i.alpha_x),
                                  "alpha_v": texture(i.alpha_y)})
        if not i.conductor:
            parameters = mi.traverse(self.bsdf)
            parameters["eta"] = mi.Float(i.ior)
            parameters.update()
        self.context = mi.BSDFContext(getattr(mi.TransportMode, transport.title()))
        self.interaction = mi.SurfaceInteraction3f()
        self.interaction.wi = mi.Vector3f(list(i.wo))
        row, column = np.divmod(np.arange(ROWS), TEXELS[1])
        self.interaction.uv = mi.Point2f((column + 0.5) / TEXELS[1], (row + 0.5) / TEXELS[0])

    def eval_pdf(self, wi):
        f, pdf = self.bsdf.eval_pdf(self.context, self.interaction, mi.Vector3f(list(wi)))
        return np.array(f).ravel(), np.array(pdf).ravel()

    def sample(self, i):
        s, weight = self.bsdf.sample(self.context, self.interaction, mi.Float(i.u_lobe),
                                     mi.Point2f(i.u1, i.u2))
        return np.array(s.wo), np.array(weight).ravel(), np.array(s.pdf).ravel()


def g1_ratio(w, i):
    """Beckmann's exact G1 over Mitsuba's rational one."""
    a = abs(w[2].astype(float)) / np.hypot(i.alpha_x.astype(float) * w[0], i.alpha_y.astype(float) * w[1])
    rational = np.where(a < 1.6, (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a), 1)
    return 1 / (0.5 + 0.5 * np.vectorize(math.erf)(a) + np.exp(-a * a) / (2 * a * np.sqrt(np.pi))) / rational


def differences(first, second):
    """Of two columns, relative, where both are above 0; and how often one alone is."""
    first, second = np.asarray(first, float), np.asarray(second, float)
    both = (first > 0) & (second > 0)
    d = abs(second[both] / first[both] - 1)
    return {"median": np.median(d), "p99": np.percentile(d, 99), "max": d.max(), "beyond": float(np.mean(d > BEYOND)),
            "compared": int(sum(both)), "first_alone": int(sum((first > 0) & ~(second > 0))),
            "second_alone": int(sum((second > 0) & ~(first > 0)))}


def compared(what, ndf, anisotropic, transport):
    i = Inputs(what, anisotropic)
    switches = {**SWITCHES, "NDF": ndf, "TRANSPORT": transport, "CONDUCTOR": int(i.conductor),
                "DIELECTRIC": int(not i.conductor)}
    ours, exact = Ours(switches, "float"), Ours(switches, "double")
    theirs = Theirs(ndf, i, transport)
    rows = []

    def row(quantity, masked, by_us, by_them, in_double, counts=True):
        """masked: the directions whose G1 is a factor. counts: where there is a sample that is not lost."""
        us, them, right = (np.where(counts, values, 0) for values in (by_us, by_them, in_double))
        found = {"bsdf": what, "ndf": ndf, "anisotropic": anisotropic, "transport": transport, "quantity": quantity,
                 "between": differences(us, them), "ours": differences(right, us), "theirs": differences(right, them)}
        if ndf == "beckmann":
            found["theirs_with_exact_g1"] = differences(right, them * np.prod([g1_ratio(w, i) for w in masked], axis=0))
        rows.append(found)

    def all_at(wi):
        return [each for who in ((ours, i), (exact, i), (theirs,)) for each in who[0].eval_pdf(*who[1:], wi)]

    with np.errstate(all="ignore"):
        wi, weight, _ = ours.sample(i)
        f, pdf, right, right_pdf, their_f, their_pdf = all_at(wi)
        row("weight of our samples", [wi], weight, their_f / their_pdf, right / right_pdf, weight > 0)
        wi = np.where(np.arange(ROWS) % 4 == 0, i.anywhere, wi)
        f, pdf, right, right_pdf, their_f, their_pdf = all_at(wi)
        row("value", [i.wo, wi], f, their_f, right)
        row("density", [i.wo], pdf, their_pdf, right_pdf)
        wi, weight, drawn_pdf = theirs.sample(i)
        f, pdf, right, right_pdf, their_f, their_pdf = all_at(wi)
        row("weight of their samples", [wi], f / pdf, weight, right / right_pdf, weight > 0)
        row("density of their samples", [i.wo], pdf, drawn_pdf, right_pdf, weight > 0)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    arguments = parser.parse_args()
    cases = [*itertools.product(["conductor"], ["ggx", "beckmann"], [False, True], ["radiance"]),
             *itertools.product(["dielectric"], ["ggx", "beckmann"], [False, True], ["radiance", "importance"])]
    rows = [row for case in cases for row in compared(*case)]
    context = {"date": time.strftime("%Y-%m-%d"), "device": queue.device.name, "platform_version": pocl.version,
               "build_options": OPTIONS, "switches": SWITCHES, "mitsuba": mi.__version__,
               "mitsuba_variant": mi.variant(), "rows": ROWS, "beyond": BEYOND}
    text = json.dumps({"context": context, "rows": rows})
    short = json.loads(text, parse_float=lambda number: float(f"{float(number):.3g}"))
    arguments.output.write_text(json.dumps(short, indent=1, ensure_ascii=False) + "\n", "utf-8")


if __name__ == "__main__":
    main()
