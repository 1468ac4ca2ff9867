"""The orbs of metal under a white sky, and under one with the day's sun in it, by `clvndf render` and by Mitsuba 3 (its llvm and
its scalar variant): whether the images agree, and the time to equal error, in turn in one run.

Mitsuba's rough conductor has the separable G, ours either. Our sun is a disc at infinity, Mitsuba's an area light: a disc of the
same size as seen from the middle of the scene, far away. Needs mitsuba of requirements.txt and, for Dr.Jit below it, an LLVM
library, as mitsuba_normals.py does. Exit status 2, with one line, where something is missing.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from newest_llvm import cannot, newest_llvm

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZE = (960, 340)
BOUNCES = 6
IDLE_S = 0.05  # Dr.Jit's threads spin for 10 ms after a launch
TIMED = {"clvndf": 64, "llvm": 64, "scalar": 16}  # samples of a pixel; a round of the last takes as long with fewer
PASS = 16  # samples of a pixel by which Mitsuba's image grows: 5 million paths at once
VARIANTS = {"llvm": "llvm_ad_rgb", "scalar": "scalar_rgb"}  # nothing is differentiated; the wheel has no variant without _ad
SKIES = ("white", "sunlit")
# Of Scene orbs(): the sun.
TO_SUN, SUN_RADIUS, SUN_IRRADIANCE, SUN_COLOUR = (-0.55, 0.62, 0.56), 0.045, 3.6, (1.0, 0.93, 0.82)
SUN_AWAY = 1e6  # the scene is 4000 wide
# host/render/scene.cpp: eta, k and alpha of five metals
METALS = (((0.155, 0.117, 0.138), (4.83, 3.12, 2.15), 0.03), ((0.143, 0.375, 1.442), (3.98, 2.39, 1.60), 0.1),
          ((0.200, 0.924, 1.102), (3.91, 2.45, 2.14), 0.2), ((2.870, 2.950, 2.650), (3.05, 2.93, 2.77), 0.3),
          ((1.345, 0.965, 0.617), (7.47, 6.40, 5.30), 0.4))
LIGHT, DARK, BOTH = (0.52, 0.48, 0.43), (0.16, 0.155, 0.15), (0.34, 0.3175, 0.29)

try:
    import numpy as np
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", newest_llvm())  # read by the next import
    import mitsuba as mi
    import drjit as dr
    mi.set_variant(VARIANTS["llvm"])
except ImportError as missing:
    cannot(f"{str(missing).splitlines()[0]} (bench/peers/requirements.txt lists the packages)")


def sphere(centre, rows):
    """Vertices, normals and triangles of Scene::add_sphere, of radius 1."""
    theta = np.pi * np.arange(rows + 1)[:, None] / rows
    phi = np.pi * (np.arange(2 * rows + 1) % (2 * rows)) / rows
    sine = np.where(np.arange(rows + 1) % rows == 0, 0, np.sin(theta[:, 0]))[:, None]
    normals = np.stack([sine * np.cos(phi), np.cos(theta) + 0 * phi, sine * np.sin(phi)], -1).astype(np.float32)
    row, column = np.mgrid[:rows, :2 * rows]
    a = row * (2 * rows + 1) + column
    b, c, d = a + 1, a + 2 * rows + 1, a + 2 * rows + 2
    faces = np.concatenate([np.stack([a, b, d], -1)[1:].reshape(-1, 3), np.stack([a, d, c], -1)[:-1].reshape(-1, 3)])
    normals = normals.reshape(-1, 3)
    return np.asarray(centre, np.float32) + normals, normals, faces


def squares(corners):
    """Of Scene::add_square, for rows x0, z0, x1, z1."""
    x0, z0, x1, z1 = np.asarray(corners, np.float32).T
    places = np.stack([np.stack([x, 0 * x, z], -1) for x, z in ((x0, z0), (x1, z0), (x1, z1), (x0, z1))], 1)
    first = 4 * np.arange(len(corners))[:, None, None]
    return places.reshape(-1, 3), None, (first + [[0, 2, 1], [0, 3, 2]]).reshape(-1, 3)


def mesh(parts, bsdf):
    places, normals, faces = parts
    made = mi.Mesh("", len(places), len(faces), has_vertex_normals=normals is not None, props=properties(bsdf))
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = places.ravel()
    parameters["faces"] = faces.ravel().astype(np.uint32)
    if normals is not None:
        parameters["vertex_normals"] = normals.ravel()
    parameters.update()
    return made


def properties(bsdf):
    result = mi.Properties()
    result["bsdf"] = mi.load_dict(bsdf)
    return result


def rgb(value):
    return {"type": "rgb", "value": list(value)}


def sun():
    direction = np.array(TO_SUN) / np.linalg.norm(TO_SUN)
    place = SUN_AWAY * direction
    radiance = SUN_IRRADIANCE / (math.pi * math.sin(SUN_RADIUS) ** 2)
    frame = mi.ScalarTransform4f().look_at([*place], [0, 0, 0], [0, 0, 1]) @ mi.ScalarTransform4f().scale(
        SUN_AWAY * math.tan(SUN_RADIUS))
    # The sky behind it is hidden, ours shines through.
    return {"type": "disk", "to_world": frame, "bsdf": {"type": "diffuse", "reflectance": rgb((0, 0, 0))},
            "emitter": {"type": "area", "radiance": rgb([1 + radiance * colour for colour in SUN_COLOUR])}}


def scene(sky):
    half, side, far = 56, 1.25, 2000
    edge = half * side
    grid = [(row, column) for row in range(-half, half) for column in range(-half, half)]
    tiles = {odd: squares([(side * c, side * r, side * (c + 1), side * (r + 1)) for r, c in grid if (r + c) & 1 == odd])
             for odd in (0, 1)}
    around = squares([(-far, -far, far, -edge), (-far, edge, far, far), (-far, -edge, -edge, edge),
                      (edge, -edge, far, edge)])
    shapes = {f"floor{i}": mesh(parts, {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(albedo)}})
              for i, (parts, albedo) in enumerate(((tiles[1], LIGHT), (tiles[0], DARK), (around, BOTH)))}
    for i, (eta, k, alpha) in enumerate(METALS):
        shapes[f"orb{i}"] = mesh(sphere((2.3 * (i - 2), 1.002, 0), 80), {
            "type": "roughconductor", "eta": rgb(eta), "k": rgb(k), "alpha": alpha, "distribution": "ggx"})
    if sky == "sunlit":
        shapes["sun"] = sun()
    camera = {"type": "perspective", "fov": math.degrees(2 * math.atan(0.41)), "fov_axis": "x", "near_clip": 1e-3,
              "to_world": mi.ScalarTransform4f().look_at([-1.5, 2.05, 14.5], [0, 0.98, 0], [0, 1, 0]),
              "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"},
                       "pixel_format": "rgb", "component_format": "float32"}}
    return mi.load_dict({"type": "scene", "camera": camera, "sky": {"type": "constant", "radiance": rgb((1, 1, 1))},
                         "integrator": {"type": "path", "max_depth": BOUNCES + 1, "rr_depth": 4}, **shapes})


class Theirs:
    def __init__(self, variant, sky):
        self.variant = VARIANTS[variant]
        mi.set_variant(self.variant)
        self.scene = scene(sky)

    def __call__(self, samples, seed):
        mi.set_variant(self.variant)
        image = np.zeros((SIZE[1], SIZE[0], 3))
        for i in range(samples // PASS):
            image += np.array(mi.render(self.scene, spp=PASS, seed=1000 * seed + i))
        return image / (samples // PASS)


class Ours:
    def __init__(self, clvndf, folder, sky):
        self.command, self.file, self.sky = clvndf, os.path.join(folder, "a.exr"), sky

    def __call__(self, samples, seed, masking="separable"):
        subprocess.run([self.command, "--quiet", "--seed", str(seed), "render", "--orbs", "metals", "--sky", self.sky,
                        "--size", f"{SIZE[0]}x{SIZE[1]}", "--max-bounces", str(BOUNCES), "--masking", masking,
                        "--effects", "conductor,lambert,shading_normal", "--spp", str(samples), "-o", self.file],
                       check=True)
        return np.array(mi.Bitmap(self.file))[:, :, :3].astype(np.float64)


def timed(render, *arguments):
    """The image, and the seconds that it took: by the clock, and of processors."""
    time.sleep(IDLE_S)
    start, before = time.perf_counter(), os.times()
    image = render(*arguments)
    after = os.times()
    return image, time.perf_counter() - start, sum(after[:4]) - sum(before[:4])


def difference(a, b):
    """The relative root mean square difference of two pairs of images beyond their noise, and what it is at most: a product
    of two differences without a common error has the mean of the square of what they share."""
    product = (a[0] - b[0]) * (a[1] - b[1])
    mean, error = max(0, product.mean()), product.std() / math.sqrt(product.size)
    return [float(np.sqrt(square) / b[0].mean()) for square in (mean, mean + 3 * error)]


def noise(pair):
    return float(np.sqrt(((pair[0] - pair[1]) ** 2).mean() / 2) / pair[0].mean())


def compared(ours, llvm, samples):
    """How far the images are apart, of many samples."""
    pairs = {masking: [ours(samples, seed, masking) for seed in (1, 2)] for masking in ("separable", "correlated")}
    pairs["mitsuba"] = [llvm(samples, seed) for seed in (1, 2)]
    return {"difference, and at most": {masking: difference(pairs[masking], pairs["mitsuba"])
                                        for masking in ("separable", "correlated")},
            "means": {name: float(np.mean(pair)) for name, pair in pairs.items()},
            "noise of the compared": {name: noise(pair) for name, pair in pairs.items()}}


def raced(renderers, rounds):
    """Their times in turn, and what they take to get to our error: errors fall with the root of the time."""
    images, seconds = {name: [] for name in renderers}, {name: [] for name in renderers}
    for name, render in renderers.items():
        render(PASS, 1)
    for round_ in range(rounds):
        for name, render in renderers.items():
            image, *took = timed(render, TIMED[name], 10 + round_)
            images[name].append(image)
            seconds[name].append(took)
    errors = {name: noise(images[name][:2]) for name in images}
    result = {"samples": TIMED, "noise of the timed": errors,
              "fastest, Msamples/s": {name: SIZE[0] * SIZE[1] * TIMED[name] / min(s[0] for s in seconds[name]) / 1e6
                                      for name in seconds}}
    for name in VARIANTS:
        ratio = np.median(np.array(seconds[name]) / np.array(seconds["clvndf"]), axis=0)
        for what, gain in (("speed", TIMED["clvndf"] / TIMED[name]),
                           ("speed to equal error", (errors[name] / errors["clvndf"]) ** 2)):
            result.setdefault(what, {})[name] = dict(zip(("clock", "processor"), map(float, ratio * gain)))
    return result


def write(result, path):
    """With four digits, into the file and on the screen."""
    short = json.loads(json.dumps(result), parse_float=lambda number: float(f"{float(number):.4g}"))
    text = json.dumps(short, indent=1) + "\n"
    path.write_text(text, "utf-8")
    print(text, end="")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    parser.add_argument("--samples", type=int, default=128, help="of a pixel, for the comparison")
    parser.add_argument("--rounds", type=int, default=5, help="of the times")
    arguments = parser.parse_args()
    clvndf = arguments.build / "clvndf"
    if not os.access(clvndf, os.X_OK):
        cannot(f"no command {clvndf}: build it, or name its folder by --build")
    result = {"context": {"date": time.strftime("%Y-%m-%d"), "mitsuba": mi.__version__, "variants": VARIANTS,
                          "drjit": dr.__version__, "threads": dr.thread_count(), "size": SIZE, "bounces": BOUNCES,
                          "compared_samples": arguments.samples, "rounds": arguments.rounds,
                          "load": os.getloadavg()}}
    with tempfile.TemporaryDirectory() as folder:
        for sky in SKIES:
            ours, theirs = Ours(clvndf, folder, sky), {name: Theirs(name, sky) for name in VARIANTS}
            result[sky] = {**compared(ours, theirs["llvm"], arguments.samples),
                           **raced({"clvndf": ours, **theirs}, arguments.rounds)}
    write(result, arguments.output)


if __name__ == "__main__":
    main()
