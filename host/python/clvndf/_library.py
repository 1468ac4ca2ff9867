"""The compiled library beside this file, its functions declared as in library.cpp."""
import ctypes
import pathlib

FOLDER = pathlib.Path(__file__).resolve().parent
MATH = {"strict": 0, "builtin": 1, "native": 2}
REAL = {"float": 0, "double": 1}
LANGUAGE = {"opencl": 0, "c": 1, "c++": 2, "cuda": 3, "string": 4}

_library = ctypes.CDLL(str(FOLDER / "libclvndf.so"))
_POINTERS = ctypes.POINTER(ctypes.c_void_p)


def _text(name, *arguments):
    function = getattr(_library, "clvndf_" + name)
    function.argtypes, function.restype = arguments, ctypes.c_char_p

    def call(*values):
        """The text that the function returns; ValueError with the reason where it refuses."""
        text = function(*values)
        if text is None:
            raise ValueError(_error().decode().replace("see clvndf list", "see clvndf.functions()"))
        return text.decode()
    return call


_error = _library.clvndf_error
_error.argtypes, _error.restype = (), ctypes.c_char_p
version = _text("version")
registry = _text("registry")
text = _text("text")
options = _text("options", ctypes.c_int, ctypes.c_int, ctypes.c_bool, ctypes.c_bool)
resolve = _text("resolve", ctypes.c_char_p)
emit = _text("emit", ctypes.POINTER(ctypes.c_char_p), ctypes.c_size_t, ctypes.c_int, ctypes.c_int, ctypes.c_int,
             ctypes.c_char_p, ctypes.c_char_p, ctypes.c_bool)
evaluate = _library.clvndf_evaluate
evaluate.argtypes = (ctypes.c_char_p, ctypes.c_int, ctypes.c_int, ctypes.c_size_t, _POINTERS, _POINTERS)
evaluate.restype = None


def pointers(arrays):
    """The data of NumPy arrays, which the caller keeps alive, as an argument of evaluate."""
    return (ctypes.c_void_p * len(arrays))(*(array.ctypes.data for array in arrays))


def choice(what, value, allowed):
    """The number that the library knows `value` by."""
    if value not in allowed:
        raise ValueError(f"{what} is {value!r}; allowed are {', '.join(map(repr, allowed))}")
    return allowed[value]
