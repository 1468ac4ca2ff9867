"""The committed counts of effects are what bench/effects.py counts.

    effects_counts_test.py SOURCE_FOLDER
"""
import json
import pathlib
import subprocess
import sys

source = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(source / "bench"))
import effects  # noqa: E402

clang = effects.newest_clang()
committed = json.loads((source / "bench/results/effects.json").read_text("utf-8"))
if committed["compilers"] != effects.compilers(clang):
    print(f"skipped: counted by {committed['compilers']}, and here are {effects.compilers(clang)}")
    sys.exit(77)
entries = {entry.pop("program"): entry for entry in committed["entries"]}
variants = dict(effects.variants())
again = "; python3 bench/effects.py >bench/results/effects.json counts again"
assert list(entries) == list(variants), f"other programs{again}"
for program, switches in variants.items():
    counted = effects.counts(clang, switches)
    assert counted == entries[program], f"{program}: committed {entries[program]}, counted {counted}{again}"
# The comparison can fail: an effect that nobody asked for.
assert effects.counts(clang, {**variants["conductor alone"], "TINT": 1}) != entries["conductor alone"]
