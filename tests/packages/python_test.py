#!/usr/bin/env python3
"""The Python package as it is installed: python_test.py CLVNDF, the command, whose answers are the right ones."""
import json
import subprocess
import sys
import unittest

import clvndf
import numpy

COMMAND = sys.argv.pop(1)
WO, ALPHA, U = (0.6, 0.0, 0.8), (0.5, 0.1), (0.25, 0.75)


def command(*arguments, **more):
    return subprocess.run([COMMAND, *arguments], check=True, stdout=subprocess.PIPE, text=True, **more).stdout


def random_arguments(function, n):
    """Of every kind: unit vectors in front and behind, alpha, u, cosines and slopes."""
    random = numpy.random.default_rng(1)
    for argument in function.arguments:
        if argument.name in ("wo", "wi", "wm", "w", "n"):
            vectors = random.standard_normal((n, 3))
            yield vectors / numpy.linalg.norm(vectors, axis=1, keepdims=True)
        elif argument.size == 1:
            yield random.uniform(0.05, 1, n)
        else:
            yield random.uniform(0.05, 1, (n, argument.size))


class Evaluation(unittest.TestCase):
    def test_every_function_has_the_bits_of_the_command(self):
        listed = json.loads(command("list", "--json"))
        self.assertEqual([f.name for f in clvndf.functions()], [entry["name"] for entry in listed])
        columns = {entry["name"]: entry.get("inputs") for entry in listed}
        known = [f for f in clvndf.functions() if f.arguments]
        for i, function in enumerate(known):
            real, math = ("float", "double")[i % 2], ("strict", "builtin")[i // 2 % 2]
            arguments = list(random_arguments(function, 20))
            result = function(*arguments, real=real, math=math)
            table = numpy.column_stack(result if isinstance(result, tuple) else [result])
            rows = [",".join(float(x).hex() for x in row) for row in numpy.column_stack(arguments)]
            lines = command("eval", function.name, "--on", "host", "--real", real, "--math", math, "--hex",
                            input="\n".join([",".join(columns[function.name]), *rows, ""])).splitlines()[1:]
            expected = numpy.array([[float.fromhex(x) for x in line.split(",")] for line in lines])
            self.assertEqual(table.dtype, {"float": numpy.float32, "double": numpy.float64}[real])
            numpy.testing.assert_array_equal(table.astype(float), expected, function.name)

    def test_shapes_broadcast(self):
        wo = numpy.broadcast_to(numpy.float32(WO), (5, 1, 3))
        u = numpy.full((7, 2), 0.5)
        self.assertEqual(clvndf.ggx_sample_wm_dupuy2023(wo, ALPHA, u).shape, (5, 7, 3))
        direction, density = clvndf.ggx_sample_wm_dupuy2023_with_pdf(wo, ALPHA, u)
        self.assertEqual((direction.shape, density.shape), ((5, 7, 3), (5, 7)))
        self.assertEqual(clvndf.ggx_sample_wi_conic2026_isotropic(WO, numpy.full(4, 0.3), U).shape, (4, 3))
        self.assertEqual(clvndf.ggx_sample_wm_dupuy2023(WO, ALPHA, numpy.empty((0, 2))).shape, (0, 3))
        self.assertEqual(clvndf.ggx_sample_wm_dupuy2023_lobe(WO, ALPHA, u=U).shape, (3,))
        self.assertEqual(clvndf.ggx_invert_wi_conic2026(WO, WO, ALPHA).shape, (2,))

    def test_numbers_and_their_types(self):
        density = clvndf.ggx_pdf_wm(WO, WO, ALPHA)
        self.assertIsInstance(density, numpy.float32)
        self.assertIsInstance(clvndf.ggx_pdf_wm(WO, WO, ALPHA, real="double"), numpy.float64)
        transposed = numpy.asfortranarray(numpy.tile(WO, (4, 1)))[::2]
        self.assertEqual(clvndf.ggx_pdf_wm(wm=transposed, wo=[WO, WO], alpha=ALPHA).tolist(), [density, density])

    def test_bad_calls_say_what_is_wrong(self):
        for exception, words, call in [
                (ValueError, r"wo has the shape \(2,\); \(\.\.\., 3\) is wanted", lambda f: f(ALPHA, ALPHA, U)),
                (ValueError, r"do not broadcast: wo \(5,\), alpha \(\), u \(4,\)",
                 lambda f: f(numpy.ones((5, 3)), ALPHA, numpy.ones((4, 2)))),
                (TypeError, "u holds complex128; real numbers are wanted", lambda f: f(WO, ALPHA, [1j, 0])),
                (TypeError, "missing a required argument: 'u'", lambda f: f(WO, ALPHA)),
                (ValueError, "real is 'half'; allowed are 'float', 'double'", lambda f: f(WO, ALPHA, U, real="half")),
                (ValueError, "math is 'native', which exists on devices alone", 
                 lambda f: f(WO, ALPHA, U, math="native")),
                (ValueError, "unknown function 'nosuch'; the nearest names are", lambda f: clvndf.function("nosuch")),
                (ValueError, "'dupuy2023' is ambiguous: 4 functions", lambda f: clvndf.function("dupuy2023")),
                (AttributeError, "has no attribute 'ggx_nosuch'", lambda f: clvndf.ggx_nosuch),
                (TypeError, "functions of lobes take", lambda f: clvndf.ggx_lobe_of(WO, ALPHA)),
                (TypeError, "a material has no form", lambda f: clvndf.bsdf_pdf(WO, WO, ALPHA))]:
            with self.assertRaisesRegex(exception, words):
                call(clvndf.ggx_sample_wm_dupuy2023)


class Text(unittest.TestCase):
    def test_version(self):
        self.assertEqual(f"clvndf {clvndf.__version__}\n", command("--version"))

    def test_emitted_is_what_the_command_emits(self):
        self.assertEqual(clvndf.emit("ggx_g1", "vndf_reflect"), command("emit", "ggx_g1", "vndf_reflect"))
        self.assertEqual(
            clvndf.emit("ggx_g1", language="c++", prefix="p_", real="double", math="builtin", selftest=True),
            command("emit", "ggx_g1", *"--as c++ --prefix p_ --real double --math builtin --selftest".split()))
        self.assertEqual(clvndf.emit("bsdf_sample", effects="lambert,fresnel=none"),
                         command("emit", "bsdf_sample", "--effects", "lambert,fresnel=none"))
        for words, arguments in [("no function named", {}), ("language is 'glsl'", {"language": "glsl"}),
                                 ("--prefix '1'", {"prefix": "1"}), ("no function of a material", {"effects": "all"}),
                                 ("native", {"math": "native", "language": "c"})]:
            with self.assertRaisesRegex(ValueError, words):
                clvndf.emit(*(["ggx_g1"] if arguments else []), **arguments)

    def test_options_follow_the_device(self):
        class Device:
            single_fp_config = 0
        self.assertEqual(clvndf.options(Device), ["-DVNDF_REAL=float", "-DVNDF_MATH=strict", "-DVNDF_SOFTWARE_FMA=1",
                                                  "-DVNDF_SOFTWARE_DIVIDE=1"])
        Device.single_fp_config = 0xbf
        self.assertEqual(clvndf.options(Device, "builtin", "double"),
                         ["-DVNDF_REAL=double", "-DVNDF_MATH=builtin", "-cl-fp32-correctly-rounded-divide-sqrt"])
        with self.assertRaisesRegex(ValueError, "native functions are float only"):
            clvndf.options(Device, "native", "double")

    def test_the_headers_are_there(self):
        headers = clvndf.headers()
        self.assertIn("vndf/vndf.h", headers)
        self.assertIn("vndf/impl/shim.h", headers)
        self.assertIn("vndf_ggx_sample_wm_dupuy2023_with_pdf(", clvndf.text())
        with open(clvndf.include_dir() + "/vndf/ggx.h") as file:
            self.assertEqual(file.read(), headers["vndf/ggx.h"])

    def test_every_function_is_described(self):
        for function in clvndf.functions():
            self.assertTrue(function.doc and function.source, function)
            self.assertEqual(bool(function.bounds), function.kind != "lobe", function)
            self.assertIs(getattr(clvndf, function.name.removeprefix("vndf_")), function)
            self.assertIn(function.name.removeprefix("vndf_"), dir(clvndf))
        self.assertIn("return: unit vector wm", clvndf.ggx_sample_wm_dupuy2023_with_pdf.doc)
        self.assertIn("NumPy: wo (..., 3), alpha (..., 2), u (..., 2) -> (..., 3), density (...); real=",
                      clvndf.ggx_sample_wm_dupuy2023_with_pdf.__doc__)
        self.assertEqual(clvndf.function("ggx_g2_sep").facts["unit"], "eps")


unittest.main()
