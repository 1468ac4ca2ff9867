#!/usr/bin/env python3
"""Of a whole run of `clvndf bench --json RUN.json` what is committed: results/pocl-3.1.json.

    python3 bench/slim.py RUN.json KEPT.json

KEPT.json, the run before, says which entries are kept; of functions that it lacks those in strict float and double and as C++;
and all that was measured twice, which the spread is of, and the other ways to sample caps. Of each entry the best, the median
and the spread of its repetitions, in four digits.
"""
import json
import pathlib
import sys

if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
    sys.exit(__doc__)
source, target = map(pathlib.Path, sys.argv[1:])
run, before = (json.loads(path.read_text("utf-8")) for path in (source, target))
kept = {entry["run_name"] for entry in before["benchmarks"]}
fields = {field for entry in before["benchmarks"] for field in entry}
functions = {name.split("/")[0] for name in kept}


def wanted(name):
    function, form, *_ = name.split("/")
    new = function not in functions and function.startswith("vndf_")
    return name in kept or form.startswith(("strict_again", "evenly", "both")) or (new and form in ("cpp", "strict"))


def short(value):
    return float(f"{value:.4g}") if isinstance(value, float) else value


run["benchmarks"] = [{field: short(value) for field, value in entry.items() if field in fields} for entry in run["benchmarks"]
                     if entry.get("aggregate_name") in ("best", "median", "cv") and wanted(entry["run_name"])]
target.write_text(json.dumps(run, indent=0) + "\n", "utf-8")
