"""Visible microfacet normals of GGX and Beckmann surfaces: samplers and densities in OpenCL C, and for NumPy.

With PyOpenCL, `text()` before a kernel of your own, built with `options(device)`:

    import clvndf, pyopencl
    context = pyopencl.create_some_context()
    program = pyopencl.Program(context, clvndf.text() + kernel).build(clvndf.options(context.devices[0]))

`emit(names...)` writes only the functions that you name, with a prefix of your own, also for C, C++ and CUDA.

With NumPy every function of `functions()` is there by its name, with or without vndf_:

    wm = clvndf.ggx_sample_wm_dupuy2023(wo, alpha, u)
    pdf = clvndf.ggx_pdf_wm(wo, wm, alpha)

Directions are unit vectors that point away from the surface, in a frame with z along its normal: wo towards the viewer,
wi the sampled one, wm the normal of the microfacet. alpha: parameters of the distribution, no perceptual roughness. u:
uniform in [0, 1]. `help(clvndf.ggx_pdf_wm)` says what holds for which arguments, and their shapes.
"""
from clvndf import _library
from clvndf._function import Argument, Function, function, functions

__version__ = _library.version()
__all__ = ["Argument", "Function", "emit", "function", "functions", "headers", "include_dir", "options", "text"]


def text():
    """The whole library in OpenCL C, as one text: put it before a source that calls vndf_... and includes nothing."""
    return _library.text()


def include_dir():
    """The folder for which `#include "vndf/vndf.h"` finds the headers."""
    return str(_library.FOLDER / "include")


def headers():
    """The headers' texts by the names that sources include them by, for pyopencl.Program.compile(headers=...)."""
    folder = _library.FOLDER / "include"
    return {path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in sorted(folder.rglob("*.h"))}


def options(device, math="strict", real="float"):
    """The build options, as a list, for a pyopencl.Device (or what has its single_fp_config).

    math: "strict", "builtin", or "native" (with "float" alone); real: "float" or "double".
    """
    config = int(device.single_fp_config)  # CL_FP_FMA and CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT
    return _library.options(_library.choice("math", math, _library.MATH), _library.choice("real", real, _library.REAL),
                            bool(config & 1 << 5), bool(config & 1 << 7)).split()


def emit(*names, language="opencl", prefix="vndf_", math="strict", real="float", effects="", selftest=False):
    """One self-contained source text with the functions named, what they call, and nothing else.

    names: as of `functions()`, with or without vndf_, or any part that no other name has.
    language: "opencl", "c", "c++", "cuda", or "string", OpenCL C as a string of C.
    prefix: what every name begins with. effects: of a material: "all", which "" stands for, or effects and choices,
    "conductor,tint,fresnel=f82". selftest: with a function of known answers, to be run under your build flags.
    """
    if not names:
        raise ValueError("emit: no function named")
    encoded = (_library.ctypes.c_char_p * len(names))(*(name.encode() for name in names))
    return _library.emit(encoded, len(names), _library.choice("language", language, _library.LANGUAGE),
                         _library.choice("math", math, _library.MATH), _library.choice("real", real, _library.REAL),
                         prefix.encode(), effects.encode(), selftest)


def __getattr__(name):
    for full in (name, "vndf_" + name):
        for known in functions():
            if known.name == full:
                return known
    raise AttributeError(f"module 'clvndf' has no attribute {name!r}; clvndf.functions() has the functions")


def __dir__():
    return __all__ + [known.name.removeprefix("vndf_") for known in functions()]
