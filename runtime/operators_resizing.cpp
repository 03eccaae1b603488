// Resize, of images in blocks of channels or plain.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/operators.h"
#include "runtime/resize_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace daumier::runtime {
namespace {

/// An image and what it becomes.
struct Resizing {
  Shape image, shape;
  std::array<ResizedAxis, 2> axes;  ///< H and W.

  /// Whether the scales are those of the sizes.
  bool IsExact() const {
    return std::ranges::all_of(
        axes, [](const ResizedAxis& axis) { return double(axis.wanted) == double(axis.size) * double(axis.scale); });
  }
};

/// The numbers of a node for the axes that it names, with `otherwise` for the others.
template <class T>
std::vector<T> ByAxis(const GraphNode& node, const std::vector<T>& given, const std::vector<T>& otherwise) {
  const std::vector<int64_t> axes = node.Integers("axes", {});
  if (axes.empty()) return given;
  DAUMIER_CHECK(axes.size() == given.size(), "it has {} axes for {} sizes or scales", axes.size(), given.size());
  std::vector<T> all = otherwise;
  for (size_t i = 0; i < axes.size(); ++i) all[AxisOf(axes[i], all.size())] = given[i];
  return all;
}

Resizing ResizingByScales(const GraphNode& node, const Shape& image, const PlanBuilder& plan) {
  const std::vector<float> scales = ByAxis(node, plan.Weight(node, 2).numbers, std::vector<float>(4, 1));
  DAUMIER_CHECK(scales.size() == 4 && scales[0] == 1 && scales[1] == 1,
                "expected four scales, of which the first two are 1");
  Resizing resizing{image, {image[0], image[1]}, {}};
  for (size_t i = 2; i < 4; ++i) {
    const double size = std::floor(double(float(image[i]) * scales[i]));
    DAUMIER_CHECK(size >= 1 && size <= double(kMostNumbers), "{} pixels times {} are no image", image[i], scales[i]);
    resizing.shape.push_back(int64_t(size));
    resizing.axes[i - 2] = {image[i], int64_t(size), scales[i]};
  }
  return resizing;
}

Resizing ResizingBySizes(const GraphNode& node, const Shape& image, const PlanBuilder& plan) {
  const std::vector<int64_t> sizes = ByAxis(node, plan.Integers(node, 3), image);
  DAUMIER_CHECK(sizes.size() == 4 && sizes[0] == image[0] && sizes[1] == image[1],
                "expected four sizes, of which the first two are those of {}", ShapeText(image));
  DAUMIER_CHECK(node.Text("keep_aspect_ratio_policy", "stretch") == "stretch", "keep_aspect_ratio_policy is not read");
  Resizing resizing{image, sizes, {}};
  for (size_t i = 2; i < 4; ++i) {
    DAUMIER_CHECK(sizes[i] >= 1 && sizes[i] <= kMostNumbers, "{} pixels are no image", sizes[i]);
    resizing.axes[i - 2] = {image[i], sizes[i], float(double(sizes[i]) / double(image[i]))};
  }
  return resizing;
}

/// Source and target of a loop over planes of blocks of channels. What fills up a block stays zero.
struct ResizedPlanes {
  int block;
  Layout target;
  Place from, to;
  Parts planes;
  int64_t pixels_from, pixels_to;

  /// Calls plane(from, to) for each.
  template <class Plane>
  void ForEach(Arena& arena, const Plane& plane) const {
    const float* const source = arena.At(from);
    float* const result = arena.At(to);
    ForEachPart(planes, [&](int64_t p) { plane(source + p * pixels_from * block, result + p * pixels_to * block); });
  }
};

ResizedPlanes PlanesOf(const GraphNode& node, const Resizing& resizing, PlanBuilder& plan) {
  const int block = std::max(BlockOf(plan.Value(node.inputs[0]).layout, resizing.image), 1);
  const Layout source = BlockedLayout(resizing.image, block), target = BlockedLayout(resizing.shape, block);
  const Place from = plan.In(node.inputs[0], source), to = plan.NewOutput(node, resizing.shape, target);
  const int64_t pixels_from = resizing.image[2] * resizing.image[3], pixels_to = resizing.shape[2] * resizing.shape[3];
  return {block,       target,   from, to, PartsOf(SizeOf(target) / (pixels_to * block), SizeOf(target)),
          pixels_from, pixels_to};
}

void AddNearest(const GraphNode& node, const Resizing& resizing, const std::string& places, const std::string& rounding,
                PlanBuilder& plan) {
  const ResizedPlanes planes = PlanesOf(node, resizing, plan);
  const int block = planes.block;
  const int64_t width = resizing.image[3];
  const std::vector<int64_t> rows = NearestPixels(resizing.axes[0], places, rounding),
                             columns = NearestPixels(resizing.axes[1], places, rounding);
  plan.AddOwn(node, std::array{planes.from, planes.to}, [=](Arena& arena) {
    const auto row_size = int64_t(columns.size()) * block;
    planes.ForEach(arena, [&](const float* plane, float* out) {
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
    });
  });
  plan.Define(node, resizing.shape, planes.target, planes.to);
}

void AddHalfPixelLinear(const GraphNode& node, const Resizing& resizing, PlanBuilder& plan) {
  const int block = std::max(BlockOf(plan.Value(node.inputs[0]).layout, resizing.image), 1);
  const Layout source = BlockedLayout(resizing.image, block), target = BlockedLayout(resizing.shape, block);
  const Primitive primitive = MakeLinearResize(source, target);
  const Place from = plan.In(node.inputs[0], source), to = plan.NewOutput(node, resizing.shape, target);
  plan.AddPrimitive(node, primitive, {{DNNL_ARG_SRC, source, from}, {DNNL_ARG_DST, target, to}});
  plan.Define(node, resizing.shape, target, to);
}

void AddLinear(const GraphNode& node, const Resizing& resizing, const std::string& places, PlanBuilder& plan) {
  const ResizedPlanes planes = PlanesOf(node, resizing, plan);
  const std::vector<Between> rows = LinearPixels(resizing.axes[0], places),
                             columns = LinearPixels(resizing.axes[1], places);
  plan.AddOwn(node, std::array{planes.from, planes.to}, [=, width = resizing.image[3]](Arena& arena) {
    const auto mean = [](float a, float b, float share) { return a + share * (b - a); };
    const int block = planes.block;
    planes.ForEach(arena, [&](const float* plane, float* out) {
      for (const Between& row : rows) {
        const float *const above = plane + row.first * width * block, *const below = plane + row.second * width * block;
        for (const Between& column : columns) {
          const int64_t first = column.first * block, second = column.second * block;
          for (int i = 0; i < block; ++i)
            *out++ = mean(mean(above[first + i], above[second + i], column.share),
                          mean(below[first + i], below[second + i], column.share), row.share);
        }
      }
    });
  });
  plan.Define(node, resizing.shape, planes.target, planes.to);
}

void AddCubic(const GraphNode& node, const Resizing& resizing, const std::string& places, PlanBuilder& plan) {
  const ResizedPlanes planes = PlanesOf(node, resizing, plan);
  const double coefficient = node.Real("cubic_coeff_a", -0.75f);
  const bool excludes = node.Integer("exclude_outside", 0) != 0;
  const std::vector<CubicPixel> rows = CubicPixels(resizing.axes[0], places, coefficient, excludes),
                                columns = CubicPixels(resizing.axes[1], places, coefficient, excludes);
  plan.AddOwn(node, std::array{planes.from, planes.to}, [=, width = resizing.image[3]](Arena& arena) {
    const int block = planes.block;
    planes.ForEach(arena, [&](const float* plane, float* out) {
      for (const CubicPixel& row : rows) {
        for (const CubicPixel& column : columns) {
          for (int i = 0; i < block; ++i) {
            float sum = 0;
            for (int y = 0; y < 4; ++y) {
              float of_row = 0;
              for (int x = 0; x < 4; ++x)
                of_row += column.weights[x] * plane[(row.pixels[y] * width + column.pixels[x]) * block + i];
              sum += row.weights[y] * of_row;
            }
            *out++ = sum;
          }
        }
      }
    });
  });
  plan.Define(node, resizing.shape, planes.target, planes.to);
}

void PlanResize(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  const Resizing resizing = node.Reads(3) ? ResizingBySizes(node, image, plan) : ResizingByScales(node, image, plan);
  CheckedSize(resizing.shape, "its output");
  const bool is_smaller = resizing.shape[2] < image[2] || resizing.shape[3] < image[3];
  DAUMIER_CHECK(node.Integer("antialias", 0) == 0 || !is_smaller, "antialias is not read");
  const std::string mode = node.Text("mode", "nearest"),
                    places = node.Text("coordinate_transformation_mode", "half_pixel");
  if (mode == "nearest")
    return AddNearest(node, resizing, places, node.Text("nearest_mode", "round_prefer_floor"), plan);
  if (mode == "cubic") return AddCubic(node, resizing, places, plan);
  DAUMIER_CHECK(mode == "linear", "there is no resizing of mode {}", mode);
  const bool half_pixel =
      places == "half_pixel" || (places == "pytorch_half_pixel" && resizing.shape[2] > 1 && resizing.shape[3] > 1);
  if (half_pixel && resizing.IsExact()) return AddHalfPixelLinear(node, resizing, plan);
  AddLinear(node, resizing, places, plan);
}

}  // namespace

OperatorTable ResizingOperators() {
  return {{"Resize", PlanResize}};
}

}  // namespace daumier::runtime
