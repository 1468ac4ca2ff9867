"""glTF 2.0 as arrays, as far as the scenes that mitsuba_gltf.py compares need it: triangles, no sparse accessors, skins or
morphs. Written back it is one .glb."""
import base64
import json
import math
import pathlib
import struct
import urllib.parse

import numpy as np

TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
CHUNKS = {0x4E4F534A: "json", 0x004E4942: "bin"}


def rotation(x, y, z, w):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    result = np.eye(4)
    result[:3, :3] = rotation(*node.get("rotation", (0, 0, 0, 1))) * node.get("scale", (1, 1, 1))
    result[:3, 3] = node.get("translation", (0, 0, 0))
    return result


def transformed(uv, texture):
    """Coordinates by KHR_texture_transform, if there is one."""
    change = texture.get("extensions", {}).get("KHR_texture_transform", {})
    angle = change.get("rotation", 0)
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return (uv * change.get("scale", (1, 1))) @ turn.T + change.get("offset", (0, 0))


class Gltf:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        data = self.path.read_bytes()
        chunks = {"json": data, "bin": b""}
        if data[:4] == b"glTF":
            at = 12
            while at < len(data):
                length, kind = struct.unpack_from("<II", data, at)
                chunks[CHUNKS.get(kind, kind)] = data[at + 8:at + 8 + length]
                at += 8 + length
        self.json = json.loads(chunks["json"])
        self.buffers = [self.bytes_of(buffer["uri"]) if "uri" in buffer else chunks["bin"]
                        for buffer in self.json.get("buffers", [])]

    def bytes_of(self, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return (self.path.parent / urllib.parse.unquote(uri)).read_bytes()

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.buffers[view["buffer"]][start:start + view["byteLength"]], view.get("byteStride")

    def accessor(self, index):
        item = self.json["accessors"][index]
        kind, width = np.dtype(TYPES[item["componentType"]]), WIDTHS[item["type"]]
        data, stride = self.view(item["bufferView"])
        values = np.ndarray((item["count"], width), kind, data, item.get("byteOffset", 0),
                            (stride or width * kind.itemsize, kind.itemsize))
        if not item.get("normalized"):
            return values
        return np.maximum(values / np.float32(np.iinfo(kind).max), -1)

    def image(self, texture):
        """The bytes of the texture's image, and its sampler."""
        texture = self.json["textures"][texture]
        image = self.json["images"][texture["source"]]
        data = self.view(image["bufferView"])[0] if "bufferView" in image else self.bytes_of(image["uri"])
        return data, self.json["samplers"][texture["sampler"]] if "sampler" in texture else {}

    def nodes(self):
        """Each node of the scene, with its matrix in the world."""
        def below(index, before):
            node = self.json["nodes"][index]
            world = before @ matrix(node)
            yield node, world
            for child in node.get("children", []):
                yield from below(child, world)
        for root in self.json["scenes"][self.json.get("scene", 0)]["nodes"]:
            yield from below(root, np.eye(4))

    def draws(self):
        """Of each primitive of each node: its material's number, and vertices in the world by attribute with their triangles."""
        for node, world in self.nodes():
            for primitive in self.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
                if primitive.get("mode", 4) == 4:
                    yield primitive.get("material"), self.placed(primitive, world)

    def placed(self, primitive, world):
        arrays = {name: np.array(self.accessor(index), float) for name, index in primitive["attributes"].items()}
        count = len(arrays["POSITION"])
        faces = np.arange(count) if "indices" not in primitive else self.accessor(primitive["indices"]).ravel()
        faces = faces.astype(np.int64).reshape(-1, 3)
        linear = world[:3, :3]
        arrays["POSITION"] = arrays["POSITION"] @ linear.T + world[:3, 3]
        if "NORMAL" in arrays:
            normals = arrays["NORMAL"] @ np.linalg.inv(linear)
            arrays["NORMAL"] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        return arrays, faces if np.linalg.det(linear) > 0 else faces[:, ::-1]

    def write(self, path):
        """As a .glb, with everything in it."""
        binary, starts = b"", []

        def append(data):
            nonlocal binary
            starts.append(len(binary))
            binary += data + bytes(-len(data) % 4)

        for data in self.buffers:
            append(data)
        out = json.loads(json.dumps(self.json))
        for view in out.get("bufferViews", []):
            view["byteOffset"] = view.get("byteOffset", 0) + starts[view["buffer"]]
            view["buffer"] = 0
        for image in out.get("images", []):
            if "uri" in image:
                data = self.bytes_of(image.pop("uri"))
                append(data)
                out["bufferViews"].append({"buffer": 0, "byteOffset": starts[-1], "byteLength": len(data)})
                image.update(bufferView=len(out["bufferViews"]) - 1,
                             mimeType="image/png" if data[:4] == b"\x89PNG" else "image/jpeg")
        out["buffers"] = [{"byteLength": len(binary)}]
        text = json.dumps(out).encode()
        text += b" " * (-len(text) % 4)
        chunks = b"".join(struct.pack("<II", len(data), kind) + data
                          for kind, data in zip(CHUNKS, (text, binary)))
        pathlib.Path(path).write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
