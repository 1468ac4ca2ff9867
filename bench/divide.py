#!/usr/bin/env python3
"""What software division costs a device that does not need it: the table of bench/README.md.

    python3 bench/divide.py OUTPUT.json [--build build/release]

Samplers in strict float with a lobe of their own, in cache: nanoseconds a sample with the device's division and with
VNDF_SOFTWARE_DIVIDE, interleaved in one run of `clvndf bench`.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FORMS = ("strict", "strict_div")


def best_of(clvndf, only):
    """The device of a run of `clvndf bench`, and the best nanoseconds a sample of each entry."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "bench.json"
        subprocess.run([clvndf, "--quiet", "bench", "--only", only, "--json", path], check=True, stdout=subprocess.DEVNULL)
        run = json.loads(path.read_text("utf-8"))
    device = {name: run["context"].get(name) for name in ("device", "driver_version", "date", "clvndf_version")}
    return device, {entry["run_name"]: entry["ns_per_sample"] for entry in run["benchmarks"] if entry.get("aggregate_name") == "best"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    arguments = parser.parse_args()
    device, best = best_of(arguments.build / "clvndf", "_sample_w/strict")
    ns = {}
    for name in best:
        function, *form = name.split("/")
        if form == ["strict_div", "float", "cached"]:
            ns[function] = [round(best[f"{function}/{form}/float/cached"], 3) for form in FORMS]
    arguments.output.write_text(json.dumps({"context": device, "ns": ns}, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
