"""What runs Mitsuba 3 (its llvm variant) and our kernels (PoCL) in one process: both beside each other, with empty caches of
compilers, so that first calls compile. Ends with one line where something is missing.
"""
import os
import tempfile

from newest_llvm import cannot, newest_llvm

caches = tempfile.TemporaryDirectory()
os.environ.update(DRJIT_CACHE_DIR=caches.name, POCL_CACHE_DIR=caches.name, PYOPENCL_NO_CACHE="1")
try:
    import numpy as np
    import pyopencl as cl
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", newest_llvm())  # read by the next import
    import mitsuba as mi
    import drjit as dr
    mi.set_variant("llvm_ad_mono")  # nothing is differentiated, and the wheel has no variant without _ad
    pocl = next(platform for platform in cl.get_platforms() if "Portable" in platform.name)
    queue = cl.CommandQueue(cl.Context(pocl.get_devices()[:1]))
except ImportError as missing:
    cannot(f"{str(missing).splitlines()[0]} (bench/peers/requirements.txt lists the packages)")
except (cl.Error, StopIteration):
    cannot("no OpenCL device of PoCL")

__all__ = ["cl", "dr", "mi", "np", "pocl", "queue"]
