"""Real scenes in glTF by `clvndf render` and by Mitsuba 3 (its llvm variant), which has no reader for it: whether the images
agree. What is written for either can be kept and opened: a .glb, and PLY meshes, images and a Mitsuba scene.

Materials that both have: surfaces without a metal become diffuse (an interface over Lambert's reflection is another model
there), metals are Mitsuba's principled ones (Schlick's Fresnel, separable G); glass is glass. Wherever a material is made
another, it is in both files. Ours shines on both sides, so that of an area light there are two here, back to back.
Needs mitsuba of requirements.txt, as mitsuba_render.py does. Exit status 1 if a scene may differ by more than MOST, 2, with one line,
where something is missing.
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

from gltf import Gltf, transformed
from mitsuba_render import difference, mi, noise, np, rgb, write
from newest_llvm import cannot

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZE = (480, 360)
BOUNCES = 8
MOST = 0.01  # relative root mean square difference
FAR = 10  # Mitsuba's rays begin 1e-4 from surfaces whatever the size of a scene, so that all are scaled to one
PASS = 32  # samples of a pixel by which Mitsuba's image grows


# ---- materials: what they become, in the glTF for both, and in Mitsuba ----

def matte(material):
    material["pbrMetallicRoughness"]["metallicFactor"] = 0
    material.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": 0}


def metal(material):
    """Without the colour of a dielectric; principled metals are not smoother than an alpha of 1e-3."""
    surface = material["pbrMetallicRoughness"]
    surface["metallicFactor"] = 1
    surface["roughnessFactor"] = max(surface.get("roughnessFactor", 1), 0.1)


def glass(material):
    """Of one index for all colours, and one at all."""
    material["extensions"].pop("KHR_materials_dispersion", None)
    index = material["extensions"].setdefault("KHR_materials_ior", {})
    index["ior"] = max(index.get("ior", 1.5), 1.1)
    material["pbrMetallicRoughness"]["roughnessFactor"] = 0.2


def lower_lamp(gltf):
    """Right under the ceiling it makes more noise there than a comparison can bear."""
    lamp = next(node for node in gltf.json["nodes"] if node.get("name") == "Light")
    lamp["translation"][1] -= 60


SCENES = {
    # name: file, what it shows, materials, eye, target, vertical field of view in degrees, light from around,
    # samples of a pixel: as many as bring the noise of the comparison well below what is compared
    "cornell": ("CornellBox.glb", "a lamp, light between walls", matte,
                (-278, 330, 700), (-278, 150, -280), 30, "none", 1024),
    "textures": ("TextureSettingsTest.glb", "textures, each way to go on", matte, (1, 0, 15), (0, -0.5, 0), 45, "white", 256),
    "transforms": ("TextureTransformTest/TextureTransformTest.gltf", "textures, moved, turned and scaled", matte,
                   (0, 0, 3.5), (0, 0, 0), 45, "white", 256),
    "spheres": ("MetalRoughSpheresNoTextures.glb", "metals of any roughness, an environment", metal,
                (0.0028, 0.0032, 0.011), (0.0028, 0.0032, 0), 45, "image", 256),
    "axes": ("OrientationTest.glb", "turned nodes, an environment", metal, (13, 12, 16), (0, 0, 0), 35, "image", 256),
    "prisms": ("derived/DispersionPrisms.gltf", "rough glass of five indices, an environment", glass,
               (0.05, 0.06, 0.4), (0, -0.002, 0), 16, "image", 512),
}


class Textures:
    """Images as files, each with the part of the plane that is used, since Mitsuba has one way to go on for both axes."""
    def __init__(self, gltf, folder):
        self.gltf, self.folder, self.count = gltf, folder, 0

    def __call__(self, texture, uv):
        """The texture for Mitsuba, and its coordinates."""
        data, sampler = self.gltf.image(texture["index"])
        source = self.folder / f"texture{self.count}"
        self.count += 1
        source.write_bytes(data)
        pixels = np.array(mi.Bitmap(str(source)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, True))
        source.unlink()
        uv = transformed(uv, texture)
        # One tile around, for what is interpolated.
        low, high = np.floor(uv.min(0)).astype(int) - 1, np.ceil(uv.max(0)).astype(int) + 1
        for axis, wrap in ((1, sampler.get("wrapS", 10497)), (0, sampler.get("wrapT", 10497))):
            size = pixels.shape[axis]
            at = np.arange(low[1 - axis] * size, high[1 - axis] * size)
            at = {10497: at % size, 33071: np.clip(at, 0, size - 1),
                  33648: np.where(at // size % 2, size - 1 - at % size, at % size)}[wrap]
            pixels = np.take(pixels, at, axis)
        path = source.with_suffix(".png")
        mi.Bitmap(np.ascontiguousarray(pixels), mi.Bitmap.PixelFormat.RGB).write(str(path))
        return ({"type": "bitmap", "filename": str(path), "wrap_mode": "clamp",
                 "filter_type": "nearest" if sampler.get("magFilter") == 9728 else "bilinear"},
                (uv - low) / (high - low))


def bsdf(material, colour):
    extensions, surface = material.get("extensions", {}), material["pbrMetallicRoughness"]
    if extensions.get("KHR_materials_transmission"):
        return {"type": "roughdielectric", "alpha": surface["roughnessFactor"] ** 2, "distribution": "ggx",
                "int_ior": extensions.get("KHR_materials_ior", {}).get("ior", 1.5), "ext_ior": 1.0,
                "specular_transmittance": colour}
    if surface.get("metallicFactor", 1) == 1:
        return {"type": "twosided", "bsdf": {"type": "principled", "base_color": colour, "metallic": 1.0,
                                             "roughness": surface.get("roughnessFactor", 1.0)}}
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": colour}}


def ply(path, places, normals, uv, faces):
    made = mi.Mesh("", len(places), len(faces), has_vertex_normals=normals is not None,
                   has_vertex_texcoords=uv is not None)
    parameters = mi.traverse(made)
    for name, values in (("vertex_positions", places), ("vertex_normals", normals), ("vertex_texcoords", uv)):
        if values is not None:
            parameters[name] = np.ascontiguousarray(values, np.float32).ravel()
    parameters["faces"] = faces.ravel().astype(np.uint32)
    parameters.update()
    made.write_ply(str(path))
    return {"type": "ply", "filename": str(path)}


def shape(gltf, material, arrays, faces, path, textures):
    """The shapes of a primitive: one, or two back to back if it shines."""
    if np.any(arrays.get("COLOR_0", 1) != 1):
        cannot(f"{gltf.path}: colours of vertices, which Mitsuba does not multiply with a material's")
    surface = material["pbrMetallicRoughness"]
    colour, uv = rgb(surface.get("baseColorFactor", (1, 1, 1))[:3]), None
    if texture := surface.get("baseColorTexture"):
        colour, uv = textures(texture, arrays[f"TEXCOORD_{texture.get('texCoord', 0)}"])
    made = {**ply(path, arrays["POSITION"], arrays.get("NORMAL"), uv, faces), "bsdf": bsdf(material, colour)}
    strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
    emission = strength * np.array(material.get("emissiveFactor", (0, 0, 0)), float)
    if not emission.any():
        return [made]
    made["emitter"] = {"type": "area", "radiance": rgb(emission)}
    corners = arrays["POSITION"][faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    away = 1e-5 * np.abs(corners).max() * normals[0] / np.linalg.norm(normals[0])  # it is flat
    behind = ply(path.with_suffix(".back.ply"), arrays["POSITION"] - away, None, uv, faces[:, ::-1])
    return [made, {**made, **behind}]


def blurred(image, sigma):
    """By a Gaussian of so many pixels; around columns and, roughly, over the poles."""
    frequencies = np.meshgrid(*(np.fft.fftfreq(size) for size in (2 * image.shape[0], image.shape[1])), indexing="ij")
    filter_ = np.exp(-2 * (np.pi * sigma) ** 2 * (frequencies[0] ** 2 + frequencies[1] ** 2))[:, :, None]
    spectrum = np.fft.fft2(np.concatenate([image, image[::-1]]), axes=(0, 1))
    return np.maximum(np.fft.ifft2(spectrum * filter_, axes=(0, 1)).real[:image.shape[0]], 0)


def around(sky, folder, scenes):
    """The light from all around: our options, and what is to be added to Mitsuba's scene. That of an image is blurred: seen
    directly, edges are as sharp as the map that each renderer makes of it."""
    if sky != "image":
        white = {"sky": {"type": "constant", "radiance": rgb((1, 1, 1))}}
        return ["--sky", sky], white if sky == "white" else {}
    image = np.array(mi.Bitmap(str(scenes / "env/venice_sunset_1k.hdr")))[:, :, :3].astype(float)
    path = str(folder / "environment.exr")
    mi.Bitmap(np.ascontiguousarray(blurred(image, image.shape[1] / 85), np.float32)).write(path)
    return ["--env", path], {"sky": {"type": "envmap", "filename": path}}


def camera(eye, target, fov):
    """As far from the target as everything is scaled to."""
    eye, target = (FAR / np.linalg.norm(np.subtract(eye, target)) * np.array(point) for point in (eye, target))
    frame = mi.ScalarTransform4f().look_at(list(eye), list(target), [0, 1, 0])
    return {"type": "perspective", "fov": fov, "fov_axis": "y", "to_world": frame,
            "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"},
                     "pixel_format": "rgb", "component_format": "float32"}}


def with_camera(gltf, eye, target, fov):
    """The same in glTF: looks along -z."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross((0, 1, 0), back) / np.linalg.norm(np.cross((0, 1, 0), back))
    frame = np.eye(4)
    frame[:3] = np.stack([right, np.cross(back, right), back, eye], 1)
    gltf.json["cameras"] = [{"type": "perspective", "perspective": {
        "yfov": math.radians(fov), "aspectRatio": SIZE[0] / SIZE[1], "znear": 1e-4}}]
    for node in gltf.json["nodes"]:
        node.pop("camera", None)
    gltf.json["nodes"].append({"camera": 0, "matrix": frame.T.ravel().tolist()})
    gltf.json["scenes"][gltf.json.get("scene", 0)]["nodes"].append(len(gltf.json["nodes"]) - 1)


def changed(gltf, change):
    """Every material, and one for what has none: a matte surface."""
    for material in gltf.json["materials"]:
        material.setdefault("pbrMetallicRoughness", {})
        change(material)
    gltf.json["materials"].append({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]}})
    matte(gltf.json["materials"][-1])
    for mesh in gltf.json["meshes"]:
        for primitive in mesh["primitives"]:
            primitive.setdefault("material", len(gltf.json["materials"]) - 1)


class Both:
    def __init__(self, name, scenes, folder, clvndf):
        file, self.shows, change, *view, sky, self.samples = SCENES[name]
        self.folder, self.clvndf = folder, clvndf
        gltf = Gltf(scenes / "valid" / file)
        changed(gltf, change)
        if name == "cornell":
            lower_lamp(gltf)
        self.options, sky = around(sky, folder, scenes)
        textures = Textures(gltf, folder)
        shapes = {}
        scale = FAR / np.linalg.norm(np.subtract(*view[:2]))
        for i, (material, (arrays, faces)) in enumerate(gltf.draws()):
            arrays["POSITION"] *= scale
            made = shape(gltf, gltf.json["materials"][material], arrays, faces, folder / f"mesh{i}.ply", textures)
            shapes.update({f"mesh{i}_{k}": one for k, one in enumerate(made)})
        description = {"type": "scene", "camera": camera(*view), **shapes,
                       "integrator": {"type": "path", "max_depth": BOUNCES + 1, "rr_depth": 1000}, **sky}
        parsed = mi.parser.parse_dict(mi.parser.ParserConfig(mi.variant()), description)
        mi.parser.write_file(parsed, str(folder / "scene.xml"))
        self.scene = mi.load_dict(description)
        with_camera(gltf, *view)
        gltf.write(folder / "scene.glb")
        self.effects = self.called_for()

    def theirs(self, samples, seed):
        image = np.zeros((SIZE[1], SIZE[0], 3))
        for i in range(samples // PASS):
            image += np.array(mi.render(self.scene, spp=PASS, seed=1000 * seed + i))
        return image / (samples // PASS)

    def render(self, *options, seed=1):
        subprocess.run([self.clvndf, "--quiet", "--seed", str(seed), "render", str(self.folder / "scene.glb"),
                        *self.options, "--max-bounces", str(BOUNCES), "--masking", "separable", *options], check=True)

    def called_for(self):
        """What the scene calls for, without what Mitsuba has not: the soft edges of shadows on bent normals."""
        report = self.folder / "report.json"
        self.render("--size", "16x12", "--spp", "1", "-o", str(self.folder / "small.png"), "--report", str(report))
        return ",".join(effect["name"] for effect in json.loads(report.read_text("utf-8"))["effects"]
                        if effect["on"] and effect["name"] != "terminator")

    def ours(self, samples, seed):
        path = str(self.folder / "ours.exr")
        self.render("--size", f"{SIZE[0]}x{SIZE[1]}", "--spp", str(samples), "--effects", self.effects, "-o", path,
                    seed=seed)
        return np.array(mi.Bitmap(path))[:, :, :3].astype(np.float64)

    def compared(self, samples):
        samples = samples or self.samples
        pairs = {"clvndf": [self.ours(samples, seed) for seed in (1, 2)],
                 "mitsuba": [self.theirs(samples, seed) for seed in (1, 2)]}
        for name, pair in pairs.items():
            mi.Bitmap(np.float32((pair[0] + pair[1]) / 2)).write(str(self.folder / f"{name}.exr"))
        return {"shows": self.shows, "samples": samples,
                "difference, and at most": difference(pairs["clvndf"], pairs["mitsuba"]),
                "means": {name: float(np.mean(pair)) for name, pair in pairs.items()},
                "noise": {name: noise(pair) for name, pair in pairs.items()}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("scenes", type=pathlib.Path, help="the folder with valid/ and env/")
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--only", choices=SCENES, nargs="+", default=list(SCENES))
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where clvndf is")
    parser.add_argument("--samples", type=int, help="of a pixel, in place of each scene's own")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for what is written for either, and the images")
    arguments = parser.parse_args()
    clvndf = arguments.build / "clvndf"
    if not os.access(clvndf, os.X_OK):
        cannot(f"no command {clvndf}: build it, or name its folder by --build")
    if not (arguments.scenes / "valid").is_dir():
        cannot(f"{arguments.scenes}: no folder valid in it")
    result = {"context": {"date": time.strftime("%Y-%m-%d"), "mitsuba": mi.__version__, "size": SIZE,
                          "bounces": BOUNCES}}
    with tempfile.TemporaryDirectory() as temporary:
        for name in arguments.only:
            folder = (arguments.keep or pathlib.Path(temporary)) / name
            folder.mkdir(parents=True, exist_ok=True)
            result[name] = Both(name, arguments.scenes, folder, clvndf).compared(arguments.samples)
    write(result, arguments.output)
    sys.exit(any(result[name]["difference, and at most"][1] > MOST for name in arguments.only))


if __name__ == "__main__":
    main()
