#pragma once
#include "datasets/styles/styled_dataset.h"
#include "runtime/network_runner.h"
#include "systems/sketch/parser_network_options.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace daumier::testing {

/// Where IdealParserNetwork sees the points of a face in the extents of its lines, as shares of width and height: eyes
/// at 0.4, mouth at 0.8, chin at the bottom; right and left mirror each other.
inline std::array<Eigen::Vector2d, faces::kNumFacePoints> PlainPointShares() {
  using enum faces::FacePoint;
  std::array<Eigen::Vector2d, faces::kNumFacePoints> shares;
  const auto pair = [&](faces::FacePoint right, double x, double y) {
    shares[size_t(right)] = {x, y};
    shares[size_t(MirroredPoint(right))] = {1 - x, y};
  };
  pair(kEyeRightOuter, 0.2, 0.4);
  pair(kEyeRightInner, 0.4, 0.4);
  pair(kEyeRightTop, 0.3, 0.37);
  pair(kEyeRightBottom, 0.3, 0.42);
  pair(kEyeRightCentre, 0.3, 0.4);
  pair(kBrowRightOuter, 0.15, 0.3);
  pair(kBrowRightInner, 0.4, 0.3);
  pair(kNoseBottom, 0.5, 0.62);
  pair(kNoseWingRight, 0.42, 0.6);
  pair(kMouthRight, 0.35, 0.8);
  pair(kLipTop, 0.5, 0.77);
  pair(kLipBottom, 0.5, 0.84);
  pair(kInnerTop, 0.5, 0.8);
  pair(kInnerBottom, 0.5, 0.8);
  pair(kChin, 0.5, 1);
  pair(kContourRight, 0.05, 0.7);
  return shares;
}

/// A parser that sees PlainPointShares in the extents of the ink, labels every line as silhouette, and closed mouths and
/// open eyes from the front. The middle of a line is where it is: the extents are those of half-covered pixels.
class IdealParserNetwork : public runtime::NetworkRunner {
 public:
  explicit IdealParserNetwork(const sketch::ParserNetworkOptions& options) : options_(options) {}

  NamedArrays Run(const NamedArrays& inputs) const override {
    const FloatArray& pictures = inputs.at("pictures");
    const int64_t count = pictures.shape[0], map = options_.map_side(), labels = options_.label_side();
    NamedArrays outputs;
    FloatArray& maps = outputs["heat_maps"] = FloatArray({count, faces::kNumFacePoints, map, map});
    FloatArray& classes = outputs["labels"] = FloatArray({count, faces::kNumLineLabels, labels, labels});
    FloatArray& states = outputs["states"] = FloatArray({count, 11});
    for (int64_t row = 0; row < count; ++row) {
      std::fill_n(classes.row(row), labels * labels, 9.0f);  // kSilhouette is the first.
      for (const int state : {0, 3, 5, 7}) states.row(row)[state] = 9;
      const Eigen::AlignedBox2d box = InkOf(pictures.row(row));
      const auto shares = PlainPointShares();
      for (size_t point = 0; point < shares.size(); ++point) {
        const Eigen::Vector2d at = (box.min() + box.sizes().cwiseProduct(shares[point])) / 4;
        float* const cells = maps.row(row) + int64_t(point) * map * map;
        for (int64_t y = 0; y < map; ++y) {
          for (int64_t x = 0; x < map; ++x) {
            const double distance = (Eigen::Vector2d(double(x) + 0.5, double(y) + 0.5) - at).squaredNorm();
            cells[y * map + x] = float(-0.5 * distance / (options_.deviation * options_.deviation));
          }
        }
      }
    }
    return outputs;
  }

 private:
  /// Pixels of the picture.
  Eigen::AlignedBox2d InkOf(const float* picture) const {
    const int side = options_.resolution;
    Eigen::AlignedBox2d box;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (picture[y * side + x] > 0.5f) box.extend(Eigen::Vector2d(x + 0.5, y + 0.5));
    return box;
  }

  sketch::ParserNetworkOptions options_;
};

}  // namespace daumier::testing
