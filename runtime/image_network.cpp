#include "runtime/image_network.h"

#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/finite.h"
#include "runtime/onnx_file.h"
#include "runtime/operators.h"

#include <fmt/ranges.h>

#include <set>

namespace daumier::runtime {
namespace {

constexpr int64_t kColours = 3;

/// The layout of an image whose shape does not say it.
std::optional<ImageLayout> LayoutByReader(const Graph& graph, const std::string& input) {
  for (const GraphNode& node : graph.nodes) {
    if (!node.Reads(0) || node.inputs[0] != input) continue;
    if (node.op == "Transpose" && node.Integers("perm", {}) == std::vector<int64_t>{0, 3, 1, 2})
      return ImageLayout::kChannelsLast;
    if (node.op == "Conv") return ImageLayout::kChannelsFirst;
  }
  return std::nullopt;
}

std::optional<ImageLayout> LayoutByShape(const Shape& shape) {
  if (shape[1] == kColours) return ImageLayout::kChannelsFirst;
  if (shape[3] == kColours) return ImageLayout::kChannelsLast;
  return std::nullopt;
}

void CheckOperators(const Graph& graph) {
  std::set<std::string> missing;
  std::string first;
  for (const GraphNode& node : graph.nodes) {
    if (IsRunHere(node.op) || !missing.insert(node.op).second) continue;
    if (first.empty()) first = node.Text();
  }
  DAUMIER_CHECK(missing.empty(),
                "{}: operators that are not run here: {} (docs/runtime.md lists those that are). Export it with other "
                "operators, for inference",
                first, fmt::join(missing, ", "));
}

/// An array of one image, (1, ...), as a view of `from`.
FloatArray Rearranged(const FloatArray& from, const StridedView& view) {
  FloatArray to(view.shape);
  StridedCopy(view.shape, view.strides, StridesOf(view.shape)).Run(from.values.data(), to.values.data());
  return to;
}

/// (H, W, 3) of an output.
FloatArray PictureOf(const FloatArray& output, ImageLayout expected) {
  Shape shape = output.shape;
  if (shape.size() == 3) shape.insert(shape.begin(), 1);
  DAUMIER_CHECK(shape.size() == 4 && shape[0] == 1, "its output is {}, no image", ShapeText(output.shape));
  const auto is_colour = [&](size_t axis) { return shape[axis] == kColours || shape[axis] == 1; };
  const size_t usual = expected == ImageLayout::kChannelsFirst ? 1 : 3, other = 4 - usual;
  const size_t axis = is_colour(usual) ? usual : other;
  DAUMIER_CHECK(is_colour(axis), "its output is {}, expected 3 channels or one", ShapeText(output.shape));
  const int64_t height = axis == 1 ? shape[2] : shape[1], width = axis == 1 ? shape[3] : shape[2],
                channels = shape[axis], area = height * width;
  const int64_t of_pixel = axis == 1 ? 1 : channels, of_channel = channels == 1 ? 0 : axis == 1 ? area : 1;
  return Rearranged(output, {{height, width, kColours}, {width * of_pixel, of_pixel, of_channel}});
}

}  // namespace

ImageInput ImageInputOf(const Graph& graph) {
  DAUMIER_CHECK(graph.inputs.size() == 1, "it has {} inputs, expected one image", graph.inputs.size());
  const GraphInput& stored = graph.inputs.front();
  const Shape& shape = stored.shape;
  DAUMIER_CHECK(shape.size() == 4 && (shape[0] == 1 || shape[0] == -1),
                "its input '{}' is {}, expected one image, (1, 3, H, W) or (1, H, W, 3)", stored.name,
                ShapeText(shape));
  std::optional<ImageLayout> layout = LayoutByShape(shape);
  if (!layout) layout = LayoutByReader(graph, stored.name);
  DAUMIER_CHECK(layout, "its input '{}' is {}, expected 3 channels: (1, 3, H, W) or (1, H, W, 3)", stored.name,
                ShapeText(shape));
  const size_t rows = *layout == ImageLayout::kChannelsFirst ? 2 : 1, colours = rows == 2 ? 1 : 3;
  DAUMIER_CHECK(shape[colours] == kColours || shape[colours] == -1, "its input '{}' is {}, expected 3 channels",
                stored.name, ShapeText(shape));
  const auto fixed = [](int64_t size) { return size == -1 ? std::nullopt : std::optional(size); };
  return {stored.name, *layout, fixed(shape[rows]), fixed(shape[rows + 1]), stored.is_bytes};
}

ImageNetwork::ImageNetwork(const std::filesystem::path& file) : file_(file) {
  Graph graph = ReadOnnx(file);
  try {
    CheckOperators(graph);
    input_ = ImageInputOf(graph);
    graph.outputs.resize(1);
    output_ = graph.outputs.front();
    runner_ = std::make_unique<GraphRunner>(std::move(graph));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

FloatArray ImageNetwork::Run(const FloatArray& picture) const {
  const Shape& shape = picture.shape;
  DAUMIER_CHECK(shape.size() == 3 && shape[2] == kColours, "the picture is {}, expected (H, W, 3)", ShapeText(shape));
  try {
    const int64_t height = shape[0], width = shape[1];
    DAUMIER_CHECK(input_.height.value_or(height) == height && input_.width.value_or(width) == width,
                  "it reads pictures of {} x {} pixels (height x width; 0: any), found {} x {}",
                  input_.height.value_or(0), input_.width.value_or(0), height, width);
    const bool first = input_.layout == ImageLayout::kChannelsFirst;
    NamedArrays inputs;
    inputs[input_.name] = first
                              ? Rearranged(picture, {{1, kColours, height, width}, {0, 1, width * kColours, kColours}})
                              : FloatArray({1, height, width, kColours}, picture.values);
    const NamedArrays outputs = runner_->Run(inputs);
    FloatArray result = PictureOf(outputs.at(output_), input_.layout);
    DAUMIER_CHECK(AreFinite(result.values), "its output has numbers that are not finite");
    return result;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file_.string(), error.what()));
  }
}

}  // namespace daumier::runtime
