"""Makes tests/fuzz/seeds/head/*.glb: the smallest heads that `daumier rig --from` reads, written without Daumier's own
writer. Only to remake these files: python3 make_heads.py FOLDER
"""
import json
import pathlib
import struct
import sys
import zlib

TETRAHEDRON = [(0, 0.1, 0), (0.1, -0.1, 0.05), (-0.1, -0.1, 0.05), (0, 0, -0.1)]
CORNERS = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]


class Glb:
    def __init__(self):
        self.binary = b""
        self.json = {"bufferViews": [], "accessors": [], "meshes": [], "nodes": [], "materials": []}

    def view(self, data):
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data + b"\0" * (-len(data) % 4)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, component, form, kind):
        flat = [x for row in rows for x in (row if isinstance(row, tuple) else (row,))]
        self.json["accessors"].append({"bufferView": self.view(struct.pack(f"<{len(flat)}{form}", *flat)),
                                       "componentType": component, "count": len(rows), "type": kind})
        return len(self.json["accessors"]) - 1

    def floats(self, rows):
        return self.accessor(rows, 5126, "f", f"VEC{len(rows[0])}")

    def node(self, name, size=1.0, at=None, material=0, uv=False, targets=(), colours=False, children=(), runs=None):
        """A node with a tetrahedron; returns its number."""
        attributes = {"POSITION": self.floats([tuple(size * c for c in p) for p in TETRAHEDRON])}
        if uv:
            attributes["TEXCOORD_0"] = self.floats([(0.1 + 0.2 * i, 0.3) for i in range(4)])
        if colours:
            attributes["COLOR_0"] = self.accessor([(90, 40, 10, 255)] * 4, 5121, "B", "VEC4")
        primitive = {"attributes": attributes, "indices": self.accessor(CORNERS, 5123, "H", "SCALAR"),
                     "material": material}
        mesh = {"primitives": [primitive]}
        if targets:
            moves = [[(0, 0, 0.001 * (i == t)) for i in range(4)] for t in range(len(targets))]
            primitive["targets"] = [{"POSITION": self.floats(move)} for move in moves]
            mesh["extras"] = {"targetNames": list(targets)}
        self.json["meshes"].append(mesh)
        node = {"name": name, "mesh": len(self.json["meshes"]) - 1}
        if at:
            node["translation"] = list(at)
        if children:
            node["children"] = list(children)
        if runs:
            node["extras"] = {"triangles": runs}
        self.json["nodes"].append(node)
        return len(self.json["nodes"]) - 1

    def empty(self, name, at):
        self.json["nodes"].append({"name": name, "translation": list(at)})
        return len(self.json["nodes"]) - 1

    def bytes(self, root):
        self.json["asset"] = {"version": "2.0", "generator": "Daumier 0.2.0",
                              "extras": {"name": "seed", "licence": "CC0-1.0"}}
        self.json["scenes"] = [{"nodes": [root]}]
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(self.binary), 0x004E4942) + self.binary
        return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def png():
    """2 x 2 pixels of RGB."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes([200, 150, 120] * 2) for _ in range(2))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def textured():
    """An atlas, two eyes, hair, stated materials of triangles."""
    glb = Glb()
    glb.json["images"] = [{"bufferView": glb.view(png()), "mimeType": "image/png"}]
    glb.json["textures"] = [{"source": 0}]
    glb.json["materials"] = [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                             {"name": "hair", "pbrMetallicRoughness": {}}]
    children = [glb.node("LeftEye", 0.1, (0.03, 0, 0.08), uv=True), glb.node("RightEye", 0.1, (-0.03, 0, 0.08), uv=True),
                glb.empty("Jaw", (0, -0.02, 0)), glb.node("Hair", 1.1, material=1, colours=True)]
    return glb.bytes(glb.node("Head", at=(0, 1.55, 0), uv=True, targets=("jawOpen", "eyeBlinkLeft"), children=children,
                              runs={"materials": [["skin", 3], ["throat", 1]], "neckCap": [[2, 1]]}))


def of_own_materials():
    """Materials of its own on two parts, no eyes."""
    glb = Glb()
    glb.json["materials"] = [
        {"name": name, "doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": list(colour)}}
        for name, colour in (("skin", (1, 0.5, 0.25, 1)), ("hat", (0, 0.5, 1, 0.5)))]
    children = [glb.empty("Jaw", (0, -0.02, 0)), glb.node("Head_hat", 1.0, material=1)]
    return glb.bytes(glb.node("Head", at=(0, 1.55, 0), targets=("jawOpen",), children=children))


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    for name, data in (("textured", textured()), ("own_materials", of_own_materials())):
        (folder / f"{name}.glb").write_bytes(data)
