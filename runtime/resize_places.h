#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace daumier::runtime {

/// One axis of ONNX's Resize: `size` pixels become `wanted`; scale: wanted / size, or as the node gives it.
struct ResizedAxis {
  int64_t size = 0, wanted = 0;
  float scale = 1;
};

/// Where the centre of each output pixel lies in the input, in pixels whose centres are at whole numbers. mode:
/// coordinate_transformation_mode. @throws Error if it is another one than align_corners, asymmetric, half_pixel,
/// half_pixel_symmetric, pytorch_half_pixel and tf_half_pixel_for_nn.
std::vector<double> PlacesOfPixels(const ResizedAxis& axis, const std::string& mode);

/// The input pixel that each output pixel repeats. rounding: nearest_mode. @throws Error if it is another one than
/// ceil, floor, round_prefer_ceil and round_prefer_floor.
std::vector<int64_t> NearestPixels(const ResizedAxis& axis, const std::string& mode, const std::string& rounding);

/// Between which pixels an output pixel lies, and how far from the first.
struct Between {
  int64_t first, second;
  float share;
};
std::vector<Between> LinearPixels(const ResizedAxis& axis, const std::string& mode);

/// The weighted pixels of an output pixel by cubic convolution [Keys 1981] with the given coefficient; those outside
/// repeat the border, or weigh nothing if `excludes_outside`.
struct CubicPixel {
  int64_t pixels[4];
  float weights[4];
};
std::vector<CubicPixel> CubicPixels(const ResizedAxis& axis, const std::string& mode, double coefficient,
                                    bool excludes_outside);

}  // namespace daumier::runtime
