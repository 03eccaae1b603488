#!/usr/bin/env python3
"""Checks `daumier import` by PyTorch itself (1.13.1 of Debian 12), on a model that was trained by `daumier train`.

    python3 authors_layout.py write RUN FOLDER            checkpoint.pth, older.pth, template.obj and template.json
    python3 authors_layout.py compare FOLDER EDIT         the faces of `daumier edit` against the authors' equations
"""
import collections
import json
import pathlib
import struct
import sys

import numpy
import torch

TYPES = {"F32": numpy.float32, "F64": numpy.float64, "I32": numpy.int32, "U8": numpy.uint8}


def read_safetensors(path):
    data = path.read_bytes()
    begin = 8 + struct.unpack("<Q", data[:8])[0]
    header = json.loads(data[8:begin])
    arrays = {}
    for name, entry in header.items():
        if name != "__metadata__":
            first, last = entry["data_offsets"]
            array = numpy.frombuffer(data[begin + first : begin + last], TYPES[entry["dtype"]])
            arrays[name] = array.reshape(entry["shape"])
    return arrays


def branches():
    for branch in range(10):
        for layer, part in enumerate(["first", "second", "last"]):
            for kind in ["weight", "bias"]:
                ours = f"network.{['weights', 'biases'][branch % 2]}_{branch // 2}.{part}.{kind}"
                yield ours, f"hyper_net.nets.{branch}.net.{layer}.0.{kind}"


def write(run, folder):
    ours = read_safetensors(run / "best/model.safetensors")
    state = collections.OrderedDict({"latent_codes.weight": torch.from_numpy(ours["codes"].copy())})
    for layer, (inputs, outputs) in enumerate([(3, 128), (128, 128), (128, 128), (128, 128), (128, 3)]):
        state[f"deform_net.net.net.{layer}.0.weight"] = torch.randn(outputs, inputs)
        state[f"deform_net.net.net.{layer}.0.bias"] = torch.randn(outputs)
    for name, theirs in branches():
        state[theirs] = torch.from_numpy(ours[name].copy())
    print(len(state), "tensors,", sum(tensor.numel() for tensor in state.values()), "numbers")
    folder.mkdir(exist_ok=True)
    torch.save(state, folder / "checkpoint.pth")
    parallel = {"module." + name: tensor for name, tensor in state.items()}
    torch.save({"epoch": 1500, "model": parallel}, folder / "older.pth", _use_new_zipfile_serialization=False)
    with open(folder / "template.obj", "w") as obj:
        for vertex in ours["network.template_vertices"]:
            obj.write("v %.9g %.9g %.9g 0.5 0.5 0.5\n" % tuple(vertex))
        for triangle in read_safetensors(run / "template.safetensors")["triangles"]:
            obj.write("f %d %d %d\n" % tuple(triangle + 1))
    template = json.loads((run / "template.json").read_text())
    annotation = {
        "format": 1,
        "landmarks": template["landmarks"],
        "hairline": template["hairline_vertex"],
        "cm_per_unit": 1 / float(ours["network.model_from_cm"][0]),
    }
    (folder / "template.json").write_text(json.dumps(annotation))


def vertices(path, count=None):
    lines = [line.split()[1:4] for line in open(path) if line.startswith("v ")]
    return torch.tensor([[float(number) for number in line] for line in lines[:count]])


def positions(state, code, points):
    def made(branch):
        x = code
        for layer in range(3):
            name = f"hyper_net.nets.{branch}.net.{layer}.0."
            x = torch.nn.functional.linear(x, state[name + "weight"], state[name + "bias"])
            x = torch.relu(x) if layer < 2 else x
        return x

    x = points
    for layer in range(5):
        bias = made(2 * layer + 1)
        x = x @ made(2 * layer).reshape(len(bias), -1).t() + bias
        x = torch.sin(30 * x) if layer < 4 else x
    return points + x


def compare(folder, edit):
    state = torch.load(folder / "checkpoint.pth")
    cm = json.loads((folder / "template.json").read_text())["cm_per_unit"]
    points = vertices(folder / "template.obj")
    for face in json.loads((edit / "edit.json").read_text())["faces"]:
        ours = vertices(edit / (face["name"] + ".obj"), len(points)) / cm
        truth = positions(state, torch.tensor(face["latent"]), points)
        print(face["name"], "largest difference", (ours - truth).abs().max().item(), "of", truth.abs().max().item())


{"write": write, "compare": compare}[sys.argv[1]](*map(pathlib.Path, sys.argv[2:]))
