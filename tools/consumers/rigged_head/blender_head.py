# blender -b --factory-startup --python-exit-code 1 --python blender_head.py -- FILE OUT TIME...: what Blender's importer makes of
# a head, as JSON.
import json
import sys

import numpy

# Debian 12's Blender 3.4.1 imports no mesh without this: its importer uses a name that NumPy 1.24 no longer has.
numpy.bool = bool
import bpy

file, out, *times = sys.argv[sys.argv.index("--") + 1:]
for item in list(bpy.data.objects):
    bpy.data.objects.remove(item)
bpy.ops.import_scene.gltf(filepath=file)

head = bpy.data.objects["Head"]
keys = head.data.shape_keys.key_blocks
basis = keys[0].data
found = {
    "version": bpy.app.version_string,
    "objects": [item.name for item in bpy.data.objects],
    "keys": [key.name for key in keys],
    "opening": [key.value for key in keys],
    "lowest": min(point.co[2] - rest.co[2] for point, rest in zip(keys["jawOpen"].data, basis)),
    "images": [image.name for image in bpy.data.images if image.packed_file],
    "samples": [],
}
scene = bpy.context.scene
per_second = scene.render.fps / scene.render.fps_base
for time in map(float, times):
    frame = time * per_second
    scene.frame_set(int(frame), subframe=frame - int(frame))
    turns = {}
    for name in ("Head", "LeftEye", "RightEye"):
        w, x, y, z = bpy.data.objects[name].rotation_quaternion.normalized()
        turns[name] = [x, z, -y, w]  # Blender's z is glTF's y.
    found["samples"].append({"weights": [key.value for key in keys[1:]], "turns": turns})
with open(out, "w") as stream:
    json.dump(found, stream)
