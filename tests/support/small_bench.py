"""A small benchmark JSON for tests out of whole ones: the aggregates that the report's plots and the README need.

    python3 tests/support/small_bench.py bench/results/pocl-3.1.json BENCH.json...
    python3 tests/docs.py BUILD
"""
import json
import re
import sys

FUNCTIONS = ("ggx_sample_wm_heitz_deon2014", "ggx_sample_wm_heitz2018", "ggx_sample_wm_dupuy2023",
             "ggx_sample_wm_benyoub2024", "ggx_sample_wi_eto2023", "beckmann_sample_wm_heitz_deon2014",
             "beckmann_sample_wm_jakob2014")
# For equal time: the cost of a sample with its density.
EQUAL_TIME = re.compile(r"vndf_ggx_(sample_wm_(walter2007|dupuy2023)_with_pdf|sample_wi_\w+_with_pdf|sigma_visible)"
                        r"/strict/float/compute")
# For the README's table of times.
TIMES = re.compile(r"vndf_\w+_sample_w[mi]_\w+(?<!_with_pdf)"
                   r"/(strict/float/(stream|compute)|(builtin|cpp|published)/float/stream|strict/double/stream)")


def rounded(value):
    return float(f"{value:.4g}") if isinstance(value, float) else value


result = None
for path in sys.argv[2:]:
    with open(path, encoding="utf-8") as file:
        data = json.load(file)
    entries = [{k: rounded(v) for k, v in b.items()} for b in data["benchmarks"]
               if b.get("aggregate_name") in ("best", "median", "cv")
               and (b["run_name"].split("/")[0].removeprefix("vndf_") in FUNCTIONS
                    or EQUAL_TIME.fullmatch(b["run_name"]) or TIMES.fullmatch(b["run_name"])
                    or b["run_name"].startswith(("copy_40B/", "copy_48B/", "fma/")))]
    if result is None:
        result = data
        result["context"] = {k: v for k, v in data["context"].items() if k not in ("host_name", "executable")}
        result["benchmarks"] = []
        result["lobes"] = [{k: rounded(v) for k, v in lobe.items()} for lobe in data["lobes"]]
    known = {(b["run_name"], b["aggregate_name"]) for b in result["benchmarks"]}
    result["benchmarks"] += [b for b in entries if (b["run_name"], b["aggregate_name"]) not in known]
with open(sys.argv[1], "w", encoding="utf-8") as file:
    json.dump(result, file, indent=0)
    file.write("\n")
