#!/usr/bin/env python3
"""Orbs under sphere lights by each way that `clvndf render --lights-by` has, after as many samples and in as much time, as a picture.

    python3 bench/lights.py OUTPUT.jpg [--build build/release] [--samples 16] [-- OPTION ...]

Left column as many samples, right as many as take the time of those by `mis`: the processors' time, of more samples less that of fewer, so
that neither compiling nor what else the machine does counts. Each part says how many samples a pixel it has and the estimated error,
root mean square over the mean. What stands behind -- goes to `clvndf render`. Needs matplotlib with Pillow; exit status 77 without.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
WAYS = {"cap": "even samples of the caps", "bsdf": "the materials' visible normals", "mis": "both, weighed", "cones": "cones"}
SIZE, CROP = (720, 255), (0, 0, 720, 215)  # pixels

try:
    import matplotlib
    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    import PIL.Image
except ImportError:
    sys.exit(77)


def shot(clvndf, folder, way, samples, options):
    """The image, what the run told of itself, and the processors' seconds."""
    image, report = folder / "image.png", folder / "report.json"
    process = subprocess.Popen([clvndf, "--quiet", "render", "-o", image, "--report", report, "--size", "{}x{}".format(*SIZE),
                                "--lights-by", way, "--spp", str(samples), *options])
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"lights.py: clvndf render ended with {process.returncode}")
    with PIL.Image.open(image) as picture:
        return picture.convert("RGB").crop(CROP), json.loads(report.read_text("utf-8")), usage.ru_utime + usage.ru_stime


def seconds_a_sample(render, way, samples):
    render(way, 1)  # compiles
    return (render(way, 3 * samples)[2] - render(way, samples)[2]) / (2 * samples)


def caption(way, told, seconds):
    samples = told["samples_per_pixel"]
    return f"{WAYS[way]}: {samples:.0f} samples, {samples * seconds:.1f} s, error {100 * told['error']:.1f} %"


def main():
    own, more = sys.argv[1:], []
    if "--" in own:
        own, more = own[:own.index("--")], own[own.index("--") + 1:]
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    parser.add_argument("--samples", type=int, default=16)
    arguments = parser.parse_args(own)
    figure, grid = plt.subplots(len(WAYS), 2, figsize=(14.4, 9.2), constrained_layout=True)
    with tempfile.TemporaryDirectory() as folder:
        def render(way, samples):
            return shot(arguments.build / "clvndf", pathlib.Path(folder), way, samples, more or ["--light-radius", "0.3"])
        seconds = {way: seconds_a_sample(render, way, arguments.samples) for way in WAYS}
        for way, row in zip(WAYS, grid):
            as_long = max(1, round(arguments.samples * seconds["mis"] / seconds[way]))
            for axes, samples in zip(row, (arguments.samples, as_long)):
                picture, told, _ = render(way, samples)
                print(caption(way, told, seconds[way]), file=sys.stderr)
                axes.imshow(picture)
                axes.set_title(caption(way, told, seconds[way]), fontsize=10)
                axes.set_axis_off()
    figure.savefig(arguments.output, dpi=100, pil_kwargs={"quality": 85})


if __name__ == "__main__":
    main()
