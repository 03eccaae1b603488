#include "render/styles/picture_buffers.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

void CheckPictureSize(int height, int width, int supersampling) {
  DAUMIER_CHECK(supersampling >= 1 && supersampling <= 3, "supersampling is {}, expected 1 to 3", supersampling);
  DAUMIER_CHECK(height > 0 && width > 0 && height % supersampling == 0 && width % supersampling == 0,
                "the buffers are {} x {}, expected positive multiples of the supersampling, {}", height, width,
                supersampling);
}

void CheckPlaneSize(const char* name, size_t found, size_t expected) {
  DAUMIER_CHECK(found == expected, "the plane {} has {} values, expected {}", name, found, expected);
}

void CheckLargest(const char* name, const std::vector<uint8_t>& values, int count) {
  uint8_t largest = 0;
  for (const uint8_t value : values) largest = std::max(largest, value);
  DAUMIER_CHECK(largest < count, "the plane {} has the value {}, expected at most {}", name, int(largest), count - 1);
}

}  // namespace

PictureBuffers EmptyPictureBuffers(int height, int width, int supersampling) {
  CheckPictureSize(height, width, supersampling);
  PictureBuffers buffers;
  buffers.height = height;
  buffers.width = width;
  buffers.supersampling = supersampling;
  const size_t size = buffers.size();
  buffers.albedo.assign(3 * size, 0.0f);
  buffers.normal.assign(3 * size, 0.0f);
  for (size_t i = 0; i < size; ++i) buffers.normal[3 * i + 2] = 1;
  buffers.shade.assign(size, 1.0f);
  buffers.depth.assign(size, std::numeric_limits<float>::infinity());
  buffers.classes.assign(size, 0);
  buffers.parts.assign(size, 0);
  return buffers;
}

void CheckPictureBuffers(const PictureBuffers& buffers) {
  CheckPictureSize(buffers.height, buffers.width, buffers.supersampling);
  DAUMIER_CHECK(buffers.pixels_per_cm > 0, "pixels_per_cm is {}, expected a positive number", buffers.pixels_per_cm);
  const size_t size = buffers.size();
  CheckPlaneSize("albedo", buffers.albedo.size(), 3 * size);
  CheckPlaneSize("normal", buffers.normal.size(), 3 * size);
  CheckPlaneSize("shade", buffers.shade.size(), size);
  CheckPlaneSize("depth", buffers.depth.size(), size);
  CheckPlaneSize("classes", buffers.classes.size(), size);
  CheckPlaneSize("parts", buffers.parts.size(), size);
  CheckLargest("classes", buffers.classes, kNumPictureClasses);
  CheckLargest("parts", buffers.parts, kNumPictureParts);
}

}  // namespace daumier::render
