"""Makes tests/fuzz/seeds/onnx/style_*.onnx and shapes.onnx: small networks of random weights in the form that other
exporters give to theirs. Only to remake these files: apt-get install python3-onnx; python3 make_style_networks.py FOLDER
"""
import sys

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

rng = np.random.default_rng(3)
LONG = np.int64


class Network:
    def __init__(self, operator_set, ir_version):
        self.nodes, self.weights, self.count = [], [], 0
        self.operator_set, self.ir_version = operator_set, ir_version

    def name(self, prefix="t"):
        self.count += 1
        return f"{prefix}{self.count}"

    def weight(self, array):
        self.weights.append(numpy_helper.from_array(array, self.name("w")))
        return self.weights[-1].name

    def random(self, *shape, scale=None):
        fan = np.prod(shape[1:]) if len(shape) > 1 else 1
        scale = scale if scale is not None else (2.0 / fan) ** 0.5
        return self.weight((rng.standard_normal(shape).astype(np.float32) * scale).astype(np.float32))

    def integers(self, *values):
        return self.weight(np.array(values, LONG))

    def constant(self, array):
        output = self.name("c")
        self.nodes.append(helper.make_node("Constant", [], [output], value=numpy_helper.from_array(np.asarray(array))))
        return output

    def op(self, op, *inputs, **attributes):
        return self.ops(op, *inputs, count=1, **attributes)[0]

    def ops(self, op, *inputs, count, **attributes):
        outputs = [self.name() for _ in range(count)]
        self.nodes.append(helper.make_node(op, list(inputs), outputs, **attributes))
        return outputs

    def save(self, path, input_shape, output, output_shape=None, weights_as_inputs=False):
        self.nodes.append(helper.make_node("Identity", [output], ["y"]))
        value = lambda name, shape: helper.make_tensor_value_info(name, TensorProto.FLOAT, shape)
        inputs = [value("x", input_shape)]
        if weights_as_inputs:
            inputs += [helper.make_tensor_value_info(w.name, w.data_type, list(w.dims)) for w in self.weights]
        graph = helper.make_graph(self.nodes, "style", inputs, [value("y", output_shape)], self.weights)
        model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", self.operator_set)])
        model.ir_version = self.ir_version
        onnx.save(model, path)


def nearest(path, size=16, channels=2, blocks=1):
    """fast-neural-style of the ONNX model zoo: set 9, weights among the inputs, reflecting pads, Upsample."""
    net = Network(9, 3)

    def conv(x, i, o, k, stride):
        p = k // 2
        if p:
            x = net.op("Pad", x, mode="reflect", pads=[0, 0, p, p, 0, 0, p, p])
        return net.op("Conv", x, net.random(o, i, k, k), net.random(o, scale=0.1), kernel_shape=[k, k],
                      strides=[stride, stride], pads=[0] * 4, dilations=[1, 1], group=1)

    def norm(x, c):
        scale = net.weight(rng.uniform(0.5, 1.5, c).astype(np.float32))
        return net.op("InstanceNormalization", x, scale, net.random(c, scale=0.3), epsilon=1e-5)

    relu = lambda x: net.op("Relu", x)
    c = channels
    x = relu(norm(conv("x", 3, c, 9, 1), c))
    x = relu(norm(conv(x, c, 2 * c, 3, 2), 2 * c))
    x = relu(norm(conv(x, 2 * c, 4 * c, 3, 2), 4 * c))
    for _ in range(blocks):
        y = relu(norm(conv(x, 4 * c, 4 * c, 3, 1), 4 * c))
        x = net.op("Add", norm(conv(y, 4 * c, 4 * c, 3, 1), 4 * c), x)
    for i, o in ((4 * c, 2 * c), (2 * c, c)):
        x = net.op("Upsample", x, net.constant(np.array([1, 1, 2, 2], np.float32)), mode="nearest")
        x = relu(norm(conv(x, i, o, 3, 1), o))
    net.save(path, [1, 3, size, size], conv(x, c, 3, 9, 1), [1, 3, size, size], weights_as_inputs=True)


def groups(path, height=16, width=16, c=1):
    """AnimeGANv2 from PyTorch, set 11: computed pads, group norms as instance norms, sizes by shape arithmetic."""
    net = Network(11, 6)

    def reflect(x, p):
        zeros = net.op("ConstantOfShape", net.constant(np.array([4], LONG)),
                       value=helper.make_tensor("v", TensorProto.INT64, [1], [0]))
        pads = net.op("Concat", net.constant(np.array([p] * 4, LONG)), zeros, axis=0)
        pads = net.op("Reshape", pads, net.constant(np.array([-1, 2], LONG)))
        pads = net.op("Slice", pads, *[net.constant(np.array([v], LONG)) for v in (-1, -9223372036854775807, 0, -1)])
        pads = net.op("Reshape", net.op("Transpose", pads, perm=[1, 0]), net.constant(np.array([-1], LONG)))
        pads = net.op("Cast", pads, to=TensorProto.INT64)
        return net.op("Pad", x, pads, net.constant(np.array(0, np.float32)), mode="reflect")

    def norm(x, channels):
        y = net.op("Reshape", x, net.constant(np.array([0, 1, -1], LONG)))
        y = net.op("InstanceNormalization", y, net.constant(np.ones(1, np.float32)),
                   net.constant(np.zeros(1, np.float32)), epsilon=1e-5)
        y = net.op("Mul", net.op("Reshape", y, net.op("Shape", x)), net.random(channels, 1, 1, scale=1.0))
        return net.op("Add", y, net.random(channels, 1, 1, scale=0.3))

    def conv(x, i, o, k, stride=1, group=1):
        return net.op("Conv", x, net.random(o, i // group, k, k), kernel_shape=[k, k], strides=[stride, stride],
                      group=group)

    def block(x, i, o, k=3, stride=1, group=1):
        x = reflect(x, k // 2) if k > 1 else x
        return net.op("LeakyRelu", norm(conv(x, i, o, k, stride, group), o), alpha=0.2)

    def residual(x, i, o):
        y = block(block(x, i, 2 * i, 1), 2 * i, 2 * i, 3, group=2 * i)
        return net.op("Add", norm(conv(y, 2 * i, o, 1), o), x)

    def size_of(x, axis):
        return net.op("Gather", net.op("Shape", x), net.constant(np.array(axis, LONG)), axis=0)

    def resize(x, sizes, places):
        first = net.op("Slice", net.op("Shape", x), *[net.constant(np.array([v], LONG)) for v in (0, 2, 0)])
        none = [net.constant(np.zeros(0, np.float32)) for _ in range(2)]
        return net.op("Resize", x, *none, net.op("Concat", first, *sizes, axis=0), mode="linear",
                      coordinate_transformation_mode=places, nearest_mode="floor")

    def as_large_as(x, other):
        sizes = [net.op("Unsqueeze", size_of(other, axis), axes=[0]) for axis in (2, 3)]
        return resize(x, sizes, "pytorch_half_pixel")

    def halved(x):
        sizes = []
        for axis in (2, 3):
            half = net.op("Mul", net.op("Cast", size_of(x, axis), to=TensorProto.FLOAT),
                          net.constant(np.array(0.5, np.float32)))
            sizes.append(net.op("Unsqueeze", net.op("Cast", net.op("Floor", half), to=TensorProto.INT64), axes=[0]))
        return resize(x, sizes, "align_corners")

    a = block(block("x", 3, c, 7), c, 2 * c, 3, 2)
    b = residual(block(a, 2 * c, 4 * c, 3, 2), 4 * c, 4 * c)
    u = block(as_large_as(b, a), 4 * c, 2 * c)
    u = block(as_large_as(u, "x"), 2 * c, c)
    u = net.op("Add", u, as_large_as(halved(u), "x"))
    net.save(path, [1, 3, height, width], net.op("Tanh", conv(u, c, 3, 1)), [1, 3, height, width])


def last(path, height=16, width=16, c=1):
    """White-box Cartoonization by tf2onnx, set 13: channels last, auto_pad, shape arithmetic in int32."""
    net = Network(13, 7)

    def conv(x, i, o, k=3, stride=1, auto_pad="SAME_UPPER"):
        return net.op("Conv", x, net.random(o, i, k, k), net.random(o, scale=0.1), auto_pad=auto_pad,
                      strides=[stride, stride], kernel_shape=[k, k], dilations=[1, 1], group=1)

    leaky = lambda x: net.op("LeakyRelu", x, alpha=0.2)
    part = lambda x, begin, end: net.op("Slice", x, net.integers(begin), net.integers(end), net.integers(0))

    def twice(x):
        shape = net.op("Cast", net.op("Shape", net.op("Transpose", x, perm=[0, 2, 3, 1])), to=TensorProto.INT32)
        sizes = net.op("Mul", part(shape, 1, 3), net.weight(np.array([2, 2], np.int32)))
        sizes = net.op("Concat", part(net.op("Shape", x), 0, 2), net.op("Cast", sizes, to=TensorProto.INT64), axis=0)
        return net.op("Resize", x, "", "", sizes, mode="linear", coordinate_transformation_mode="half_pixel")

    x0 = leaky(conv(net.op("Transpose", "x", perm=[0, 3, 1, 2]), 3, c, 7))
    x1 = leaky(conv(leaky(conv(x0, c, c, 3, 2)), c, 2 * c))
    x2 = leaky(conv(leaky(conv(x1, 2 * c, 2 * c, 3, 2)), 2 * c, 4 * c))
    x2 = net.op("Add", conv(leaky(conv(x2, 4 * c, 4 * c)), 4 * c, 4 * c), x2)
    x3 = net.op("Add", twice(leaky(conv(x2, 4 * c, 2 * c))), x1)
    x3 = leaky(conv(leaky(conv(x3, 2 * c, 2 * c)), 2 * c, c))
    x4 = net.op("Resize", x3, "", net.weight(np.array([1, 1, 2, 2], np.float32)), mode="linear",
                coordinate_transformation_mode="asymmetric")
    y = net.op("DepthToSpace", conv(leaky(conv(net.op("Add", x4, x0), c, c)), c, 12), blocksize=2, mode="DCR")
    y = conv(y, 3, 3, 3, 2, "SAME_LOWER")
    y = net.op("Clip", y, net.weight(np.array(-1, np.float32)), net.weight(np.array(1, np.float32)))
    net.save(path, [1, height, width, 3], net.op("Transpose", y, perm=[0, 2, 3, 1]))


def transposed(path, height=16, width=16, c=1):
    """CycleGAN, set 17: transposed convolutions with output padding, constants as attributes of lists."""
    net = Network(17, 8)

    def listed(kind, values):
        output = net.name("c")
        net.nodes.append(helper.make_node("Constant", [], [output], **{kind: values}))
        return output

    def conv(x, i, o, k, stride, p):
        return net.op("Conv", x, net.random(o, i, k, k), net.random(o, scale=0.1), kernel_shape=[k, k],
                      strides=[stride, stride], pads=[p] * 4)

    def norm(x, n):
        return net.op("InstanceNormalization", x, listed("value_floats", [1.0] * n), listed("value_floats", [0.0] * n))

    reflect = lambda x, p: net.op("Pad", x, listed("value_ints", [0, 0, p, p, 0, 0, p, p]), mode="reflect")
    relu = lambda x: net.op("Relu", x)
    x = relu(norm(conv(reflect("x", 3), 3, c, 7, 1, 0), c))
    x = relu(norm(conv(x, c, 2 * c, 3, 2, 1), 2 * c))
    y = relu(norm(conv(reflect(x, 1), 2 * c, 2 * c, 3, 1, 0), 2 * c))
    y = net.ops("Dropout", y, count=2)[0]
    x = net.op("Add", x, norm(conv(reflect(y, 1), 2 * c, 2 * c, 3, 1, 0), 2 * c))
    x = net.op("ConvTranspose", x, net.random(2 * c, c, 3, 3, scale=0.08), net.random(c, scale=0.1), kernel_shape=[3, 3],
               strides=[2, 2], pads=[1] * 4, output_padding=[1, 1])
    y = conv(reflect(relu(norm(x, c)), 3), c, 3, 7, 1, 0)
    net.save(path, [1, 3, height, width], net.op("Tanh", y))


def shapes(path):
    """Operators on shapes and parts."""
    net = Network(13, 8)
    shape = net.op("Shape", "x")
    height = net.op("Gather", shape, net.weight(np.array(2, LONG)))
    rows = net.op("Range", net.weight(np.array(0, LONG)), height, net.weight(np.array(1, LONG)))
    rows = net.op("Where", net.op("Equal", rows, net.integers(1)), net.weight(np.array([2.0], np.float32)),
                  net.op("Cast", rows, to=TensorProto.FLOAT))
    half = net.op("Mul", net.op("Cast", shape, to=TensorProto.FLOAT), net.weight(np.array([1, 1, 0.5, 0.5], np.float32)))
    half = net.op("Cast", net.op("Floor", half), to=TensorProto.INT64)
    filled = net.op("ConstantOfShape", half, value=helper.make_tensor("v", TensorProto.FLOAT, [1], [0.5]))
    x = net.op("Mul", "x", net.op("Reshape", rows, net.integers(1, 1, -1, 1)))
    a, b = net.ops("Split", net.op("SpaceToDepth", x, blocksize=2), axis=1, count=2)
    x = net.op("Sum", a, b, a)
    first = net.op("Slice", net.op("Shape", x), net.integers(0), net.integers(2))
    x = net.op("Resize", x, "", "", net.op("Concat", first, net.integers(5, 7), axis=0), mode="cubic")
    x = net.op("Pad", x, net.integers(0, 0, 1, 1, 0, 0, 1, 1), mode="edge")
    x = net.op("Gather", x, net.integers(1, 0, -1), axis=1)
    x = net.op("Softmax", net.op("HardSigmoid", x), axis=1)
    net.save(path, [1, 4, 6, 6], net.op("Add", x, net.op("ReduceSum", filled)))


for make in (nearest, groups, last, transposed):
    make(f"{sys.argv[1]}/style_{make.__name__}.onnx")
shapes(f"{sys.argv[1]}/shapes.onnx")
