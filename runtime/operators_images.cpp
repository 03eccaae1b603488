// Pools and resizing.
#include "core/error.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace daumier::runtime {
namespace {

Shape ImageOf(const GraphNode& node, const PlanBuilder& plan) {
  const Shape& image = plan.ShapeOf(node.inputs.at(0));
  DAUMIER_CHECK(image.size() == 4, "the image is {}, expected (N, C, H, W)", ShapeText(image));
  return image;
}

void AddPool(const GraphNode& node, const Shape& image, const Window& window, PoolKind kind, PlanBuilder& plan) {
  for (size_t i = 0; i < 2; ++i)
    DAUMIER_CHECK(std::max(window.before[i], window.after[i]) < window.kernel[i],
                  "its padding is not smaller than its kernel");
  const Shape shape = WindowOutput(image, image[1], window);
  const Layout source = plan.Value(node.inputs[0]).layout;
  const Primitive primitive = MakePool(source, AnyLayout(shape), window, kind);
  const Place from = plan.In(node.inputs[0], source), to = plan.NewOutput(node, shape, primitive.target);
  plan.AddPrimitive(node, primitive, {{DNNL_ARG_SRC, source, from}, {DNNL_ARG_DST, primitive.target, to}});
  plan.Define(node, shape, primitive.target, to);
}

Window PoolWindow(const GraphNode& node) {
  const std::vector<int64_t> kernel = node.Integers("kernel_shape", {});
  DAUMIER_CHECK(kernel.size() == 2 && node.Integer("ceil_mode", 0) == 0 && node.Integer("storage_order", 0) == 0,
                "expected a kernel_shape of two numbers, ceil_mode 0 and storage_order 0");
  return WindowOf(node, kernel);
}

void PlanMaxPool(const GraphNode& node, PlanBuilder& plan) {
  AddPool(node, ImageOf(node, plan), PoolWindow(node), PoolKind::kMax, plan);
}

void PlanAveragePool(const GraphNode& node, PlanBuilder& plan) {
  DAUMIER_CHECK(node.Integer("count_include_pad", 0) == 0, "count_include_pad is not read");
  AddPool(node, ImageOf(node, plan), PoolWindow(node), PoolKind::kMean, plan);
}

void PlanGlobalAveragePool(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  AddPool(node, image, {{image[2], image[3]}, {1, 1}, {1, 1}, {0, 0}, {0, 0}}, PoolKind::kMean, plan);
}

Shape ResizedShape(const GraphNode& node, const Shape& image, const std::vector<float>& scales) {
  DAUMIER_CHECK(scales.size() == 4 && scales[0] == 1 && scales[1] == 1 && !node.Reads(3),
                "expected four scales, of which the first two are 1, and no sizes");
  Shape shape = {image[0], image[1]};
  for (size_t i = 2; i < 4; ++i) {
    const double size = std::floor(double(float(image[i]) * scales[i]));
    DAUMIER_CHECK(size >= 1 && size <= double(kMostNumbers), "{} pixels times {} are no image", image[i], scales[i]);
    shape.push_back(int64_t(size));
  }
  CheckedSize(shape, "its output");
  return shape;
}

/// The pixel that each output pixel repeats: floor(i / scale).
std::vector<int64_t> NearestPixels(int64_t size, int64_t wanted, float scale) {
  std::vector<int64_t> pixels;
  for (int64_t i = 0; i < wanted; ++i) pixels.push_back(std::min(int64_t(double(i) / double(scale)), size - 1));
  return pixels;
}

/// Rows of blocks are copied, so that the channels that fill up a block stay zero.
void AddNearest(const GraphNode& node, const Shape& image, const Shape& shape, const std::vector<float>& scales,
                PlanBuilder& plan) {
  const int found = BlockOf(plan.Value(node.inputs[0]).layout, image), block = std::max(found, 1);
  const Layout source = BlockedLayout(image, block), target = BlockedLayout(shape, block);
  const Place from = plan.In(node.inputs[0], source), to = plan.NewOutput(node, shape, target);
  const int64_t planes = SizeOf(source) / (image[2] * image[3] * block), width = image[3], height = image[2];
  const std::vector<int64_t> rows = NearestPixels(height, shape[2], scales[2]),
                             columns = NearestPixels(width, shape[3], scales[3]);
  plan.AddOwn(node, std::array{from, to}, [=](Arena& arena) {
    const float* plane = arena.At(from);
    float* out = arena.At(to);
    const auto row_size = int64_t(columns.size()) * block;
    for (int64_t p = 0; p < planes; ++p, plane += height * width * block) {
      int64_t earlier = -1;
      for (const int64_t row : rows) {
        if (row == earlier) {
          std::memcpy(out, out - row_size, size_t(row_size) * sizeof(float));
        } else {
          float* pixel = out;
          for (const int64_t column : columns) {
            const float* const read = plane + (row * width + column) * block;
            for (int i = 0; i < block; ++i) pixel[i] = read[i];
            pixel += block;
          }
        }
        earlier = row;
        out += row_size;
      }
    }
  });
  plan.Define(node, shape, target, to);
}

void AddHalfPixelLinear(const GraphNode& node, const Shape& image, const Shape& shape, PlanBuilder& plan) {
  const int block = std::max(BlockOf(plan.Value(node.inputs[0]).layout, image), 1);
  const Layout source = BlockedLayout(image, block), target = BlockedLayout(shape, block);
  const Primitive primitive = MakeLinearResize(source, target);
  const Place from = plan.In(node.inputs[0], source), to = plan.NewOutput(node, shape, target);
  plan.AddPrimitive(node, primitive, {{DNNL_ARG_SRC, source, from}, {DNNL_ARG_DST, target, to}});
  plan.Define(node, shape, target, to);
}

/// Between which pixels an output pixel lies, and how far from the first.
struct Between {
  int64_t first, second;
  float share;
};

std::vector<Between> AlignedPixels(int64_t size, int64_t wanted) {
  std::vector<Between> pixels;
  for (int64_t i = 0; i < wanted; ++i) {
    const double at = wanted == 1 ? 0 : double(i) * double(size - 1) / double(wanted - 1);
    const int64_t first = std::min(int64_t(at), size - 1);
    pixels.push_back({first, std::min(first + 1, size - 1), float(at - double(first))});
  }
  return pixels;
}

void AddAlignedLinear(const GraphNode& node, const Shape& image, const Shape& shape, PlanBuilder& plan) {
  const Place from = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  const std::vector<Between> rows = AlignedPixels(image[2], shape[2]), columns = AlignedPixels(image[3], shape[3]);
  plan.AddOwn(node, std::array{from, to},
              [=, planes = image[0] * image[1], height = image[2], width = image[3]](Arena& arena) {
                const float* plane = arena.At(from);
                float* out = arena.At(to);
                const auto mean = [](float a, float b, float share) { return a + share * (b - a); };
                for (int64_t p = 0; p < planes; ++p, plane += height * width) {
                  for (const Between& row : rows) {
                    const float *const above = plane + row.first * width, *const below = plane + row.second * width;
                    for (const Between& column : columns)
                      *out++ = mean(mean(above[column.first], above[column.second], column.share),
                                    mean(below[column.first], below[column.second], column.share), row.share);
                  }
                }
              });
  plan.Define(node, shape, PlainLayout(shape), to);
}

void PlanResize(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  const std::vector<float>& scales = plan.Weight(node, 2).numbers;
  const Shape shape = ResizedShape(node, image, scales);
  const std::string mode = node.Text("mode", "nearest"),
                    places = node.Text("coordinate_transformation_mode", "half_pixel");
  if (mode == "nearest" && places == "asymmetric" && node.Text("nearest_mode", "round_prefer_floor") == "floor")
    return AddNearest(node, image, shape, scales, plan);
  if (mode == "linear" && places == "half_pixel") return AddHalfPixelLinear(node, image, shape, plan);
  if (mode == "linear" && places == "align_corners") return AddAlignedLinear(node, image, shape, plan);
  throw Error(fmt::format("there is no resizing of mode {} at {} places", mode, places));
}

}  // namespace

OperatorTable ImageOperators() {
  return {{"AveragePool", PlanAveragePool},
          {"GlobalAveragePool", PlanGlobalAveragePool},
          {"MaxPool", PlanMaxPool},
          {"Resize", PlanResize}};
}

}  // namespace daumier::runtime
