#include "runtime/resize_places.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::runtime {

std::vector<double> PlacesOfPixels(const ResizedAxis& axis, const std::string& mode) {
  const float scale = axis.scale;
  const auto size = double(axis.size), wanted = double(axis.wanted);
  float shift = 0, offset = 0;  // Place i: (i + shift) / scale + offset, in float32 as ONNX Runtime: 1 / (1 / 3) is 3.
  if (mode == "half_pixel" || (mode == "pytorch_half_pixel" && axis.wanted > 1)) {
    shift = 0.5f, offset = -0.5f;
  } else if (mode == "tf_half_pixel_for_nn") {
    shift = 0.5f;
  } else if (mode == "half_pixel_symmetric") {
    shift = 0.5f, offset = float(size / 2 * (1 - wanted / (scale * size)) - 0.5);
  } else {
    DAUMIER_CHECK(mode == "asymmetric" || mode == "align_corners" || mode == "pytorch_half_pixel",
                  "there is no resizing at {} places", mode);
  }
  std::vector<double> places(size_t(axis.wanted), 0);
  if (axis.wanted == 1 && (mode == "align_corners" || mode == "pytorch_half_pixel")) return places;
  for (int64_t i = 0; i < axis.wanted; ++i)
    places[size_t(i)] =
        mode == "align_corners" ? double(i) * (size - 1) / (wanted - 1) : double((float(i) + shift) / scale + offset);
  return places;
}

std::vector<int64_t> NearestPixels(const ResizedAxis& axis, const std::string& mode, const std::string& rounding) {
  std::vector<int64_t> pixels;
  for (const double place : PlacesOfPixels(axis, mode)) {
    double rounded = std::floor(place);
    if (rounding == "round_prefer_floor") {
      rounded = std::ceil(place - 0.5);
    } else if (rounding == "round_prefer_ceil") {
      rounded = std::floor(place + 0.5);
    } else if (rounding == "ceil") {
      rounded = std::ceil(place);
    } else {
      DAUMIER_CHECK(rounding == "floor", "there is no nearest pixel by '{}'", rounding);
    }
    pixels.push_back(int64_t(std::clamp(rounded, 0.0, double(axis.size - 1))));
  }
  return pixels;
}

std::vector<Between> LinearPixels(const ResizedAxis& axis, const std::string& mode) {
  std::vector<Between> pixels;
  for (const double place : PlacesOfPixels(axis, mode)) {
    const double at = std::clamp(place, 0.0, double(axis.size - 1));
    const int64_t first = std::min(int64_t(at), axis.size - 1);
    pixels.push_back({first, std::min(first + 1, axis.size - 1), float(at - double(first))});
  }
  return pixels;
}

std::vector<CubicPixel> CubicPixels(const ResizedAxis& axis, const std::string& mode, double coefficient,
                                    bool excludes_outside) {
  const double a = coefficient;
  const auto near = [a](double x) { return ((a + 2) * x - (a + 3)) * x * x + 1; };
  const auto far = [a](double x) { return ((a * x - 5 * a) * x + 8 * a) * x - 4 * a; };
  std::vector<CubicPixel> pixels;
  for (const double place : PlacesOfPixels(axis, mode)) {
    const double floor = std::floor(place), share = place - floor;
    double weights[] = {far(share + 1), near(share), near(1 - share), far(2 - share)}, sum = 0;
    CubicPixel pixel{};
    for (int i = 0; i < 4; ++i) {
      const double at = std::clamp(floor - 1 + i, -1.0, double(axis.size));
      if (excludes_outside && (at < 0 || at > double(axis.size - 1))) weights[i] = 0;
      pixel.pixels[i] = int64_t(std::clamp(at, 0.0, double(axis.size - 1)));
      sum += weights[i];
    }
    for (int i = 0; i < 4; ++i) pixel.weights[i] = float(excludes_outside && sum != 0 ? weights[i] / sum : weights[i]);
    pixels.push_back(pixel);
  }
  return pixels;
}

}  // namespace daumier::runtime
