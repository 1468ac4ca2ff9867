"""What the scripts beside share: the LLVM library for Dr.Jit, and how they end where something is missing."""
import itertools
import os
import pathlib
import re
import sys


def cannot(why):
    print(f"{os.path.basename(sys.argv[0])}: {why}", file=sys.stderr)
    sys.exit(2)


def newest_llvm():
    paths = itertools.chain(*(pathlib.Path("/usr").glob(f"{at}/libLLVM*") for at in ("lib*", "lib/*", "lib/*/lib")))
    found = {int(version[1]): path for path in paths if (version := re.match(r"libLLVM(?:-|\.so\.)(\d+)", path.name))}
    if max(found, default=0) < 17:  # Dr.Jit refuses 14; 15 and 16 abort while they compile Mitsuba's GGX
        cannot("no LLVM library of version 17 or later: install libllvm19 or set DRJIT_LIBLLVM_PATH")
    return str(found[max(found)])
