"""The committed counts of instructions hold every sampler on every target, and every listing with its lean form.

    instructions_test.py SOURCE_FOLDER CLVNDF
"""
import json
import pathlib
import re
import subprocess
import sys

source, clvndf = map(pathlib.Path, sys.argv[1:])
functions = json.loads(subprocess.run([clvndf, "list", "--json"], check=True, stdout=subprocess.PIPE).stdout)
samplers = {f["name"] for f in functions if f["kind"] == "sampler"}
listings = set(re.findall(r"^PUBLISHED\((\w+)", (source / "bench/published/batch.cl").read_text(), re.M))
listings = {f"vndf_{name}" for name in listings}
assert len(samplers) >= 30 and len(listings) >= 7 and listings < samplers, (samplers, listings)

entries = json.loads((source / "bench/results/instructions.json").read_text())["entries"]
counts = {(e["target"], e["form"], e["division"], e["function"]): e for e in entries}
assert len(counts) == len(entries), "an entry twice"
for target in ("sm_80", "gfx900", "gfx1030"):
    for division in ("ieee", "fast"):
        for form, wanted in (("strict", samplers), ("lean", listings), ("published", listings)):
            found = {key[3] for key in counts if key[:3] == (target, form, division)}
            assert found == wanted, (target, form, division, found ^ wanted)
        copy = counts[target, "copy", division, "copy_40B"]["instructions"]
        assert all(e["instructions"] > copy for key, e in counts.items() if key[0] == target and "copy" not in key)
    assert {key[3] for key in counts if key[:3] == (target, "published", "fast-math")} == listings, target
assert not any(e["spills"] for e in entries), "the README says that nothing spills"
