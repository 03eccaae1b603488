#!/usr/bin/env python3
"""Writes tests/fuzz/seeds/torch by PyTorch itself: python3 make_torch_files.py seeds/torch (PyTorch 1.13.1 of Debian 12)."""
import collections
import pathlib
import sys

import torch

out = pathlib.Path(sys.argv[1])
grid = torch.arange(12, dtype=torch.float32).reshape(3, 4)
state = collections.OrderedDict()
state["module.plain"] = grid / 8
state["module.transposed"] = grid.t()
state["module.part"] = grid[1:, 1:3]  # A view of the same storage.
state["module.repeated"] = torch.tensor([0.5]).expand(2, 3)
state["module.parameter"] = torch.nn.Parameter(torch.tensor([1.5, -2.5]))
state["module.float16"] = torch.tensor([0.25, -65504.0], dtype=torch.float16)
state["module.bfloat16"] = torch.tensor([0.5, -3.0], dtype=torch.bfloat16)
state["module.float64"] = torch.tensor([0.1, 1e300], dtype=torch.float64)
state["module.int64"] = torch.tensor(7)
state["module.int32"] = torch.tensor([-7], dtype=torch.int32)
state["module.uint8"] = torch.tensor([255], dtype=torch.uint8)
state["module.bool"] = torch.tensor([True, False])
state["module.empty"] = torch.zeros(0, 3)
state._metadata = collections.OrderedDict({"": {"version": 1}})
network = torch.nn.Linear(2, 1)
optimiser = torch.optim.Adam(network.parameters())
network(torch.ones(2)).backward()
optimiser.step()
checkpoint = {"epoch": 1500, "error": 0.25, "model": state, "optimizer": optimiser.state_dict(), "note": None}
torch.save(checkpoint, out / "zip.pth")
torch.save(checkpoint, out / "older.pth", _use_new_zipfile_serialization=False)
torch.save({"a": grid}, out / "protocol4.pth", pickle_protocol=4)
