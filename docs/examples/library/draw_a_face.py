"""A drawing -> a face -> its nose pulled out -> a rigged head, by the C library and numpy: python3 draw_a_face.py drawing.svg head.glb"""
import ctypes
import sys

import numpy as np

daumier = ctypes.CDLL("libdaumier.so.0")
daumier.daumier_last_error.restype = ctypes.c_char_p
daumier.daumier_face_num_vertices.restype = ctypes.c_size_t


def call(name, *arguments):
    if getattr(daumier, "daumier_" + name)(*arguments) != 0:
        sys.exit(daumier.daumier_last_error().decode())


def make(name, *arguments):
    """The object that a function makes, as its last argument."""
    made = ctypes.c_void_p()
    call(name, *arguments, ctypes.byref(made))
    return made


def buffer(array):
    return ctypes.c_void_p(array.ctypes.data), ctypes.c_size_t(array.size)


face = make("predict_file", make("predictor_open", b"sketch-ict"), sys.argv[1].encode())
xyz = np.empty((daumier.daumier_face_num_vertices(face), 3), np.float32)
call("face_vertices", face, *buffer(xyz))

model = make("model_open", None)
nose = np.array([daumier.daumier_model_landmark(model, 30)], np.int32)
edit = make("edit_begin", model, *buffer(xyz), *buffer(nose), 1)
call("edit_move", edit, *buffer(np.array([0, 0, 1], np.float32)), *buffer(xyz))  # 1 cm to the front

call("head_write", make("rig_head", make("rig_open", None), *buffer(xyz)), sys.argv[2].encode())
print("%d vertices, nose at %.2f %.2f %.2f cm" % (len(xyz), *xyz[nose[0]]))
