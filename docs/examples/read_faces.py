"""Reads a database of faces with nothing but numpy:  python3 read_faces.py FOLDER"""
import json, pathlib, sys
import numpy as np

TYPES = {"F32": np.float32, "F64": np.float64, "I32": np.int32, "I64": np.int64}

def read_safetensors(path):
    data = np.memmap(path, mode="r")  # arrays stay on disk
    size = int.from_bytes(data[:8].tobytes(), "little")
    entries = json.loads(data[8:8 + size].tobytes())
    return {name: data[8 + size:][slice(*e["data_offsets"])].view(TYPES[e["dtype"]]).reshape(e["shape"])
            for name, e in entries.items() if name != "__metadata__"}

folder = pathlib.Path(sys.argv[1])
manifest = json.loads((folder / "manifest.json").read_text())
triangles = read_safetensors(folder / "template.safetensors")["triangles"]
faces = read_safetensors(folder / "shards/person-00000.safetensors")["vertices"]  # levels, expressions, V, 3 in cm
print(manifest["counts"]["persons"], "persons,", faces.shape, triangles.shape)
smile = manifest["details"]["expressions"].index("smile")
print("a smile moves %.3f cm at most" % np.linalg.norm(faces[0, smile] - faces[0, 0], axis=-1).max())
