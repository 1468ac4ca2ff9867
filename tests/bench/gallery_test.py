#!/usr/bin/env python3
"""bench/gallery.py shows every scene of a folder on one page that needs no other file, and says why one is not shown.

    gallery_test.py PROJECT CLVNDF
"""
import base64
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

PROJECT, CLVNDF = pathlib.Path(sys.argv[1]), sys.argv[2]


def triangle(name):
    corners = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.5}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0],
                       "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(corners).decode()}],
        "animations": [{"channels": [], "samplers": []}]})


def gallery(*arguments):
    return subprocess.run([sys.executable, PROJECT / "bench/gallery.py", "--clvndf", CLVNDF, *arguments],
                          capture_output=True, text=True)


def expect(truth, what):
    if not truth:
        sys.exit(f"gallery_test.py: {what}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scenes = folder / "scenes"
        (scenes / "below").mkdir(parents=True)
        (scenes / "a&b.gltf").write_text(triangle("one"))
        (scenes / "below/two.gltf").write_text(triangle("two"))
        small = ("--out", folder / "out", "--", "--size", "32x24", "--spp", "2")

        run = gallery(scenes, *small)
        expect(run.returncode == 0, f"status {run.returncode}: {run.stderr}")
        page = (folder / "out/index.html").read_text("utf-8")
        expect(os.listdir(folder / "out") == ["index.html"], "more than the page was written")
        expect(page.count("<article") == 2 and "a&amp;b.gltf" in page and "below/two.gltf" in page, "scenes are missing")
        expect("a&b" not in page, "a name is taken for HTML")
        images = re.findall(r"src='data:image/png;base64,([^']*)'", page)
        expect(len(images) == 2 and all(base64.b64decode(i)[:4] == b"\x89PNG" for i in images), "images are missing")
        expect(not re.search(r"(src|href)=(?!'data:image/png|'#scene)", page), "the page needs another file")
        for part in ("VNDF_LAMBERT=1", "lambert", "Off, and not in the program: ", "animation", "--size 32x24 --spp 2"):
            expect(part in page, f"no {part} on the page")

        (scenes / "broken.gltf").write_text("{}")
        run = gallery(scenes, *small)
        page = (folder / "out/index.html").read_text("utf-8")
        expect(run.returncode == 1, f"a broken scene: status {run.returncode}")
        expect(page.count("<article") == 3 and "exit status 2: clvndf: " in page, "the page does not say what is broken")
        run = gallery(scenes, "--only", "two", *small)
        expect(run.returncode == 0 and (folder / "out/index.html").read_text("utf-8").count("<article") == 1, "--only")
        for arguments, why in (((folder / "out",), "no scene"), ((scenes, "--clvndf", folder / "none"), "no command")):
            run = gallery(*arguments)
            expect(run.returncode == 2 and why in run.stderr and run.stderr.count("\n") == 1, f"{why}: {run.stderr}")


if __name__ == "__main__":
    main()
