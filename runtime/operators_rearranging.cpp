// Padding, gathering, depth and space.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/folded_arithmetic.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace daumier::runtime {
namespace {

void CheckPads(int64_t size, int64_t before, int64_t after, const std::string& mode) {
  DAUMIER_CHECK(before >= 0 && after >= 0 && before <= kMostNumbers && after <= kMostNumbers &&
                    (mode != "reflect" || std::max(before, after) < size),
                "it pads {} pixels by {} and {}", size, before, after);
}

/// For each place along a padded axis, the place in the input, or -1 where the constant is.
std::vector<int64_t> PaddedPlaces(int64_t size, int64_t before, int64_t after, const std::string& mode) {
  std::vector<int64_t> places;
  for (int64_t i = -before; i < size + after; ++i) {
    int64_t at = i;
    if (mode == "reflect" && at < 0) at = -at;
    if (mode == "reflect" && at >= size) at = 2 * (size - 1) - at;
    if (mode == "edge") at = std::clamp(at, int64_t{0}, size - 1);
    places.push_back(at < 0 || at >= size ? -1 : at);
  }
  return places;
}

struct Padding {
  std::vector<std::vector<int64_t>> places;  ///< By axis.
  std::vector<int64_t> strides;
  float value;

  /// Fills the rest of an output of which the first `axis` indices are given.
  float* Fill(const float* from, size_t axis, bool is_inside, float* to) const {
    for (const int64_t at : places[axis]) {
      const bool inside = is_inside && at >= 0;
      const float* const next = inside ? from + at * strides[axis] : from;
      if (axis + 1 < places.size()) {
        to = Fill(next, axis + 1, inside, to);
      } else {
        *to++ = inside ? *next : value;
      }
    }
    return to;
  }
};

struct PadSizes {
  std::vector<int64_t> before, after;  ///< By axis.
};

PadSizes PadSizesOf(const GraphNode& node, const Shape& from, const PlanBuilder& plan) {
  const std::vector<int64_t>& pads = plan.Integers(node, 1);
  PadSizes sizes{std::vector<int64_t>(from.size(), 0), std::vector<int64_t>(from.size(), 0)};
  std::vector<int64_t> axes;
  for (size_t i = 0; i < from.size(); ++i) axes.push_back(int64_t(i));
  if (node.Reads(3)) axes = plan.Integers(node, 3);
  DAUMIER_CHECK(pads.size() == 2 * axes.size() && !from.empty(), "it has {} pads for {} axes", pads.size(),
                axes.size());
  for (size_t i = 0; i < axes.size(); ++i) {
    const size_t axis = AxisOf(axes[i], from.size());
    sizes.before[axis] = pads[i];
    sizes.after[axis] = pads[axes.size() + i];
  }
  return sizes;
}

float PadValueOf(const GraphNode& node, const PlanBuilder& plan) {
  if (!node.Reads(2)) return 0;
  const std::vector<float>& value = plan.Weight(node, 2).numbers;
  DAUMIER_CHECK(value.size() == 1, "its constant has {} numbers", value.size());
  return value.front();
}

/// Images of which rows and columns are padded, in the blocks of channels that they have; 1: plain.
int BlockOfPadded(const Shape& from, const PadSizes& sizes, float value, const Layout& layout) {
  const auto none = [](const std::vector<int64_t>& of) { return of[0] == 0 && of[1] == 0; };
  if (from.size() != 4 || !none(sizes.before) || !none(sizes.after)) return 0;
  const int block = std::max(BlockOf(layout, from), 1);
  return value == 0 || from[1] % block == 0 ? block : 1;  // What fills up a block stays zero.
}

/// Row by row, of which the middle is a copy.
void AddPaddedImages(const GraphNode& node, const Shape& from, const Shape& shape, const PadSizes& sizes, int block,
                     const Padding& padding, PlanBuilder& plan) {
  const Layout source = BlockedLayout(from, block), target = BlockedLayout(shape, block);
  const Place place = plan.In(node.inputs[0], source), to = plan.NewOutput(node, shape, target);
  const int64_t planes = SizeOf(target) / (shape[2] * shape[3] * block);
  plan.AddOwn(node, std::array{place, to},
              [=, rows = padding.places[2], columns = padding.places[3], value = padding.value, height = from[2],
               width = from[3], before = sizes.before[3], parts = PartsOf(planes, SizeOf(target))](Arena& arena) {
                const float* const read = arena.At(place);
                float* const written = arena.At(to);
                const auto row_size = int64_t(columns.size()) * block;
                const auto pixel = [&](const float* row, int64_t column, float* out) {
                  const int64_t at = row == nullptr ? -1 : columns[size_t(column)];
                  for (int i = 0; i < block; ++i) out[column * block + i] = at < 0 ? value : row[at * block + i];
                };
                ForEachPart(parts, [&](int64_t p) {
                  float* out = written + p * int64_t(rows.size()) * row_size;
                  for (const int64_t at : rows) {
                    const float* const row = at < 0 ? nullptr : read + (p * height + at) * width * block;
                    const int64_t copied = row == nullptr ? 0 : width;
                    for (int64_t column = 0; column < before; ++column) pixel(row, column, out);
                    if (copied > 0) std::memcpy(out + before * block, row, size_t(width * block) * sizeof(float));
                    for (int64_t column = before + copied; column < int64_t(columns.size()); ++column)
                      pixel(row, column, out);
                    out += row_size;
                  }
                });
              });
  plan.Define(node, shape, target, to);
}

void PlanPad(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const std::string mode = node.Text("mode", "constant");
  DAUMIER_CHECK(mode == "constant" || mode == "reflect" || mode == "edge", "there is no padding '{}'", mode);
  const PadSizes sizes = PadSizesOf(node, from, plan);
  Padding padding{{}, StridesOf(from), PadValueOf(node, plan)};
  Shape shape;
  for (size_t i = 0; i < from.size(); ++i) {
    CheckPads(from[i], sizes.before[i], sizes.after[i], mode);
    shape.push_back(from[i] + sizes.before[i] + sizes.after[i]);
  }
  CheckedSize(shape, "its output");
  for (size_t i = 0; i < from.size(); ++i)
    padding.places.push_back(PaddedPlaces(from[i], sizes.before[i], sizes.after[i], mode));
  if (const int block = BlockOfPadded(from, sizes, padding.value, plan.Value(node.inputs[0]).layout); block > 0)
    return AddPaddedImages(node, from, shape, sizes, block, padding, plan);
  const Place source = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{source, to}, [=, padding = std::move(padding)](Arena& arena) {
    padding.Fill(arena.At(source), 0, true, arena.At(to));
  });
  plan.Define(node, shape, PlainLayout(shape), to);
}

/// Rows of an axis, by indices that are known.
void PlanGather(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const size_t axis = AxisOf(node.Integer("axis", 0), from.size());
  const Shape of_indices = plan.ShapeOfIntegers(node, 1);
  Shape shape(from.begin(), from.begin() + std::ptrdiff_t(axis));
  shape.insert(shape.end(), of_indices.begin(), of_indices.end());
  shape.insert(shape.end(), from.begin() + std::ptrdiff_t(axis) + 1, from.end());
  CheckedSize(shape, "its output");
  const std::vector<int64_t> indices = IndicesOf(plan.Integers(node, 1), from[axis]);
  const int64_t inner = StridesOf(from)[axis], row = inner * from[axis], outer = CheckedSize(from, "its input") / row;
  const Place source = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{source, to}, [=](Arena& arena) {
    const float* rows = arena.At(source);
    float* out = arena.At(to);
    for (int64_t o = 0; o < outer; ++o, rows += row) {
      for (const int64_t index : indices) {
        std::memcpy(out, rows + index * inner, size_t(inner) * sizeof(float));
        out += inner;
      }
    }
  });
  plan.Define(node, shape, PlainLayout(shape), to);
}

int64_t BlockSizeOf(const GraphNode& node) {
  const int64_t block = node.Integer("blocksize", 0);
  DAUMIER_CHECK(block >= 1 && block <= 1024, "its blocks are of {} pixels", block);
  return block;
}

/// Channels are (y, x, c) by mode DCR, (c, y, x) by CRD.
void PlanDepthToSpace(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  const int64_t block = BlockSizeOf(node), channels = image[1] / (block * block), area = image[2] * image[3];
  const std::string mode = node.Text("mode", "DCR");
  DAUMIER_CHECK(image[1] % (block * block) == 0 && (mode == "DCR" || mode == "CRD"),
                "{} channels are no blocks of {} pixels by mode '{}'", image[1], block, mode);
  const bool depth_first = mode == "DCR";
  const int64_t of_channel = depth_first ? area : block * block * area, of_x = depth_first ? channels * area : area;
  const StridedView view{{image[0], channels, image[2], block, image[3], block},
                         {image[1] * area, of_channel, image[3], block * of_x, 1, of_x}};
  AddStridedCopy(node, view, plan.Plain(node.inputs[0]), {image[0], channels, image[2] * block, image[3] * block},
                 plan);
}

void PlanSpaceToDepth(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  const int64_t block = BlockSizeOf(node), height = image[2] / block, width = image[3] / block;
  DAUMIER_CHECK(image[2] % block == 0 && image[3] % block == 0, "{} has no blocks of {} pixels", ShapeText(image),
                block);
  const int64_t area = image[2] * image[3];
  const StridedView view{{image[0], block, block, image[1], height, width},
                         {image[1] * area, image[3], 1, area, block * image[3], block}};
  AddStridedCopy(node, view, plan.Plain(node.inputs[0]), {image[0], block * block * image[1], height, width}, plan);
}

}  // namespace

OperatorTable RearrangingOperators() {
  return {
      {"DepthToSpace", PlanDepthToSpace}, {"Gather", PlanGather}, {"Pad", PlanPad}, {"SpaceToDepth", PlanSpaceToDepth}};
}

}  // namespace daumier::runtime
