#!/usr/bin/env python3
"""The documentation is what docs.py makes of the registry, of files, of commands and of the committed benchmark; and a
change of any of them is found out.

    docs_test.py BUILD
"""
import pathlib
import re
import subprocess
import sys

try:
    import matplotlib  # noqa: F401, for the tables of the benchmark
except ImportError:
    print("skipped: no python3-matplotlib")
    sys.exit(77)

import docs

build = pathlib.Path(sys.argv[1]).resolve()
subprocess.run([sys.executable, pathlib.Path(__file__).parent / "docs.py", "--check", build], check=True)


def spoilt(text, pattern, replacement):
    changed, count = re.subn(pattern, replacement, text, count=1)
    assert count == 1 and changed != text, f"nothing to spoil: {pattern}"
    return changed


readme = (docs.ROOT / "README.md").read_text("utf-8")
kernels = (docs.ROOT / "kernels/README.md").read_text("utf-8")
host = (docs.ROOT / "host/README.md").read_text("utf-8")
bench = (docs.ROOT / "bench/README.md").read_text("utf-8")
cap = (docs.ROOT / "kernels/vndf/ggx_dupuy2023.h").read_text("utf-8")

assert docs.with_tables(spoilt(kernels, r"(\| `vndf_ggx_ndf\(.*?\| )(\d+)", r"\g<1>9\2"), build) == kernels
assert docs.with_tables(spoilt(readme, r"(\| `ggx_sample_wm_dupuy2023` \| )[0-9.]+", r"\g<1>0.1"), build) == readme
assert docs.with_tables(spoilt(bench, r"(\| `copy_40B` \| \d+, )(\d+)", r"\g<1>9\2"), build) == bench
assert docs.with_tables(spoilt(bench, r"(\| Mitsuba GGX \| )[0-9.]+", r"\g<1>0.1"), build) == bench
assert docs.with_files(spoilt(readme, r"kernel void sample_metal", "kernel void sample")) == readme
assert docs.with_outputs(spoilt(host, r"0x1\.580024p-2", "0x1.580025p-2"), build) == host
assert docs.with_accuracy(spoilt(cap, r"(// Accuracy: [^:]*: )\d+", r"\g<1>99"), build) == (cap, [])
assert docs.with_accuracy(cap.replace("// Accuracy:", "// Precision:"), build)[1] == [
    "vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wm_dupuy2023_lobe"]
