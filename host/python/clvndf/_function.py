"""The registered functions: what is known of each, and evaluation on NumPy arrays by the headers compiled as C++."""
import dataclasses
import functools
import inspect
import json
import re

import numpy

from clvndf import _library


@dataclasses.dataclass(frozen=True)
class Argument:
    name: str
    size: int  # of components; 1: a number


# A function of the library. Its own documentation is that of the kernel.
@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Function:
    name: str
    kind: str  # sampler, density, term, pair, inverse, geometry, lobe, material
    ndf: str  # ggx, beckmann, any
    signature: str  # of the kernel: "wo, alpha, u"
    source: str  # where it was published
    arguments: tuple  # of Argument, for a call from Python; empty for a lobe or a material, which is not called
    outputs: tuple  # of names: "wm_x", "wm_y", "wm_z"[, "pdf"]; "value"; "u1", "u2"
    bounds: dict  # by "float" and "double", in units of 2^-24 and 2^-53: what clvndf check asserts
    facts: dict  # of a sampler density, method, domain; of a density support; and the unit of the bounds
    doc: str  # the comment of its header

    @property
    def __doc__(self):
        shapes = ", ".join(f"{a.name} {_shape(a.size)}" for a in self.arguments)
        result = _shape(len(self.outputs) - (self.outputs[-1:] == ("pdf",)))
        result += ", density (...)" if self.outputs[-1:] == ("pdf",) else ""
        numpy_form = f'\n\nNumPy: {shapes} -> {result}; real="float", "double"; math="strict", "builtin"'
        return f"{self.name}({self.signature})\n\n{self.doc}{numpy_form if self.arguments else ''}"

    @functools.cached_property
    def __signature__(self):
        both, keyword = inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY
        return inspect.Signature([*(inspect.Parameter(a.name, both) for a in self.arguments),
                                  inspect.Parameter("real", keyword, default="float"),
                                  inspect.Parameter("math", keyword, default="strict")])

    def __repr__(self):
        return f"<clvndf.{self.name.removeprefix('vndf_')}({', '.join(a.name for a in self.arguments)})>"

    def __call__(self, *args, **named):
        """Evaluates it on arrays: f(wo, alpha, u), by position or by name.

        An argument that is a vector has the shape (..., 3) or (..., 2), one that is a number the shape (...); what
        stands before the components is broadcast. real="float" (default) or "double": arguments are rounded to it, and
        the result is float32 or float64. math="strict" (default), which has the bits of every device that keeps them,
        or "builtin". A function of a lobe, which kernels set up once from wo and alpha, takes wo and alpha here.

        The result has the shape (..., 3) for a direction, (..., 2) for random numbers, (...) for a number; a function
        whose name ends in _with_pdf returns a pair: directions and densities.
        """
        if not self.arguments:
            instead = ("functions of lobes take " + self.signature + " here" if self.kind == "lobe" else
                       "emit() writes it for the effects of yours")
            raise TypeError(f"{self.name}: a {self.kind} has no form in NumPy; {instead}")
        try:
            call = self.__signature__.bind(*args, **named)
        except TypeError as error:
            raise TypeError(f"{self.name}{self.__signature__}: {error}") from None
        call.apply_defaults()
        real, math = call.arguments.pop("real"), call.arguments.pop("math")
        if math == "native":
            raise ValueError(f"{self.name}: math is 'native', which exists on devices alone; "
                             "allowed are 'strict', 'builtin'")
        policy, number = _library.choice("math", math, _library.MATH), _library.choice("real", real, _library.REAL)
        dtype = numpy.dtype(numpy.float64 if real == "double" else numpy.float32)
        arrays = [self._array(argument, call.arguments[argument.name], dtype) for argument in self.arguments]
        try:
            shape = numpy.broadcast_shapes(*(array.shape[:-1] for array in arrays))
        except ValueError:
            shapes = ", ".join(f"{a.name} {array.shape[:-1]}" for a, array in zip(self.arguments, arrays))
            raise ValueError(f"{self.name}: shapes before the components do not broadcast: {shapes}") from None
        inputs = [numpy.ascontiguousarray(numpy.broadcast_to(array[..., i], shape)) for array in arrays
                  for i in range(array.shape[-1])]
        results = numpy.empty((len(self.outputs), *shape), dtype)
        _library.evaluate(self.name.encode(), policy, number, results[0].size, _library.pointers(inputs),
                          _library.pointers([*results.reshape(len(self.outputs), -1)]))
        if self.outputs[-1] == "pdf":
            return _vectors(results[:-1]), results[-1]
        return results[0][()] if self.outputs == ("value",) else _vectors(results)

    def _array(self, argument, value, dtype):
        """The value with an axis of components at its end."""
        array = numpy.asarray(value)
        if array.dtype.kind not in "fiub":
            raise TypeError(f"{self.name}: {argument.name} holds {array.dtype}; real numbers are wanted")
        if argument.size == 1:
            return array.astype(dtype)[..., None]
        if array.shape[-1:] != (argument.size,):
            raise ValueError(f"{self.name}: {argument.name} has the shape {array.shape}; "
                             f"(..., {argument.size}) is wanted")
        return array.astype(dtype)


def _shape(size):
    return "(...)" if size == 1 else f"(..., {size})"


def _vectors(components):
    return numpy.ascontiguousarray(numpy.moveaxis(components, 0, -1))


def _arguments(scalars):
    """wo_x, wo_y, wo_z, u1, u2 are wo of 3 and u of 2 components."""
    sizes = {}
    for scalar in scalars:
        name = re.sub(r"_[xyz]$", "", scalar)
        if name in ("u1", "u2") and {"u1", "u2"} <= set(scalars):
            name = "u"
        sizes[name] = sizes.get(name, 0) + 1
    return tuple(Argument(*item) for item in sizes.items())


def _comments():
    """The comment above each public function of the headers; a _with_pdf form has that of its plain form before its own."""
    found = {}
    for path in sorted((_library.FOLDER / "include").rglob("*.h")):
        pattern = r"((?:^//.*\n)+)VNDF_FN [\w ]+ (vndf_(?!impl_)\w+)\("
        for lines, name in re.findall(pattern, path.read_text("utf-8"), re.M):
            found[name] = re.sub("^// ?", "", lines, flags=re.M).rstrip()
    return {name: found.get(name.removesuffix("_with_pdf"), "") + "\n" + own if name.endswith("_with_pdf") else own
            for name, own in found.items()}


@functools.cache
def functions():
    """Every function, in the registry's order, as a tuple; those that set up lobes, and materials, at its end."""
    comments = _comments()
    known = []
    for entry in json.loads(_library.registry()):
        keys = ("density", "method", "domain", "support", "sampler", "unit", "type")
        facts = {key: entry[key] for key in keys if key in entry}
        known.append(Function(*(entry[key] for key in ("name", "kind", "ndf", "signature", "source")),
                              _arguments(entry.get("inputs", ())), tuple(entry.get("outputs", ())),
                              entry.get("bounds", {}), facts, comments.get(entry["name"], "")))
    return tuple(known)


def function(name):
    """The function of this name, with or without vndf_, or of any part that no other name has. ValueError if there is
    none, or several."""
    full = _library.resolve(name.encode())
    return next(known for known in functions() if known.name == full)
