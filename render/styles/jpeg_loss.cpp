#include "render/styles/jpeg_loss.h"

#include "core/error.h"
#include "render/styles/colour_planes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::render {
namespace {

constexpr int kBlock = 8;
using BlockValues = std::array<float, 64>;

// Tables K.1 and K.2 of ITU T.81, row by row.
constexpr std::array<int, 64> kLumaSteps = {16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
                                            14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
                                            18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
                                            49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};
constexpr std::array<int, 64> kChromaSteps = {17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99,
                                              24, 26, 56, 99, 99, 99, 99, 99, 47, 66, 99, 99, 99, 99, 99, 99,
                                              99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
                                              99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99};

BlockValues ScaledSteps(const std::array<int, 64>& steps, int quality) {
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  BlockValues scaled{};
  for (int i = 0; i < 64; ++i) scaled[i] = static_cast<float>(std::clamp((steps[i] * scale + 50) / 100, 1, 255));
  return scaled;
}

/// Row k: the k-th cosine, so that the transform is orthonormal.
BlockValues CosineRows() {
  BlockValues rows{};
  for (int k = 0; k < kBlock; ++k) {
    for (int i = 0; i < kBlock; ++i) {
      const double norm = k == 0 ? std::sqrt(0.125) : 0.5;
      rows[8 * k + i] = static_cast<float>(norm * std::cos((2 * i + 1) * k * 3.14159265358979323846 / 16));
    }
  }
  return rows;
}

/// a b, 8 x 8.
BlockValues BlockProduct(const BlockValues& a, const BlockValues& b) {
  BlockValues product{};
  for (int i = 0; i < kBlock; ++i) {
    for (int k = 0; k < kBlock; ++k) {
      const float factor = a[8 * i + k];
      for (int j = 0; j < kBlock; ++j) product[8 * i + j] += factor * b[8 * k + j];
    }
  }
  return product;
}

BlockValues TransposedBlock(const BlockValues& block) {
  BlockValues transposed{};
  for (int i = 0; i < kBlock; ++i) {
    for (int j = 0; j < kBlock; ++j) transposed[8 * j + i] = block[8 * i + j];
  }
  return transposed;
}

/// Values in 0..255 about 128.
void QuantisePlane(Plane& plane, const BlockValues& steps, const BlockValues& cosines, const BlockValues& transposed) {
  for (int top = 0; top < plane.height; top += kBlock) {
    for (int left = 0; left < plane.width; left += kBlock) {
      BlockValues block{};
      for (int i = 0; i < kBlock; ++i) {
        const float* source = plane.row(std::min(top + i, plane.height - 1));
        for (int j = 0; j < kBlock; ++j) block[8 * i + j] = source[std::min(left + j, plane.width - 1)] - 128;
      }
      block = BlockProduct(BlockProduct(cosines, block), transposed);
      for (int i = 0; i < 64; ++i) {
        const float ratio = block[i] / steps[i];
        block[i] = steps[i] * static_cast<float>(static_cast<int>(ratio + (ratio < 0 ? -0.5f : 0.5f)));
      }
      block = BlockProduct(BlockProduct(transposed, block), cosines);
      for (int i = 0; i < std::min(kBlock, plane.height - top); ++i) {
        float* target = plane.row(top + i);
        for (int j = 0; j < std::min(kBlock, plane.width - left); ++j) target[left + j] = block[8 * i + j] + 128;
      }
    }
  }
}

/// Means of 2 x 2 pixels; the last ones of fewer.
Plane HalvedPlane(const Plane& plane) {
  Plane half((plane.height + 1) / 2, (plane.width + 1) / 2);
  for (int row = 0; row < half.height; ++row) {
    const float *above = plane.row(2 * row), *below = plane.row(std::min(2 * row + 1, plane.height - 1));
    for (int column = 0; column < half.width; ++column) {
      const int left = 2 * column, right = std::min(2 * column + 1, plane.width - 1);
      half.at(row, column) = 0.25f * (above[left] + above[right] + below[left] + below[right]);
    }
  }
  return half;
}

}  // namespace

Image JpegLoss(const Image& image, int quality) {
  DAUMIER_CHECK(image.channels == 3 && image.height > 0 && image.width > 0,
                "the picture is {} x {} with {} channels, expected RGB", image.height, image.width, image.channels);
  DAUMIER_CHECK(quality >= 1 && quality <= 100, "the JPEG quality is {}, expected 1 to 100", quality);
  Plane luma(image.height, image.width), blue(image.height, image.width), red(image.height, image.width);
  const size_t size = luma.values.size();
  for (size_t i = 0; i < size; ++i) {
    const float r = image.pixels[3 * i], g = image.pixels[3 * i + 1], b = image.pixels[3 * i + 2];
    luma.values[i] = 0.299f * r + 0.587f * g + 0.114f * b;
    blue.values[i] = 128 - 0.168736f * r - 0.331264f * g + 0.5f * b;
    red.values[i] = 128 + 0.5f * r - 0.418688f * g - 0.081312f * b;
  }
  static const BlockValues cosines = CosineRows();
  const BlockValues transposed = TransposedBlock(cosines);
  QuantisePlane(luma, ScaledSteps(kLumaSteps, quality), cosines, transposed);
  blue = HalvedPlane(blue);
  red = HalvedPlane(red);
  QuantisePlane(blue, ScaledSteps(kChromaSteps, quality), cosines, transposed);
  QuantisePlane(red, ScaledSteps(kChromaSteps, quality), cosines, transposed);
  Image lossy(image.height, image.width, 3);
  const auto byte = [](float value) { return static_cast<uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f); };
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const float y = luma.at(row, column), cb = blue.at(row / 2, column / 2) - 128,
                  cr = red.at(row / 2, column / 2) - 128;
      uint8_t* target = &lossy.at(row, column);
      target[0] = byte(y + 1.402f * cr);
      target[1] = byte(y - 0.344136f * cb - 0.714136f * cr);
      target[2] = byte(y + 1.772f * cb);
    }
  }
  return lossy;
}

}  // namespace daumier::render
