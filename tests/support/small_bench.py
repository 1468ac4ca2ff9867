"""A small benchmark JSON for tests out of whole ones: the aggregates that the report's plots and the README need.

    python3 tests/support/small_bench.py bench/results/pocl-3.1.json BENCH.json...
    python3 tests/docs.py BUILD
"""
import json
import re
import sys

# Every rung of the samplers without a density; of all others strict float.
KEPT = re.compile(r"(copy_(40|48)B/|fma/|vndf_\w+_sample_w[mi]_\w+(?<!_with_pdf)/|vndf_\w+/strict/float/).*")
DROPPED = ("family_index", "per_family_instance_index", "repetitions", "threads", "aggregate_unit", "iterations")


def rounded(value):
    return float(f"{value:.4g}") if isinstance(value, float) else value


result = None
for path in sys.argv[2:]:
    with open(path, encoding="utf-8") as file:
        data = json.load(file)
    entries = [{k: rounded(v) for k, v in b.items() if k not in DROPPED} for b in data["benchmarks"]
               if b.get("aggregate_name") in ("best", "median", "cv") and KEPT.fullmatch(b["run_name"])]
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
