#include "faces/mouth_bag.h"

#include <array>

namespace daumier::faces {
namespace {

/// A ring's depth as a share of the bag's, and its size as a share of the loop's.
struct BagRing {
  double depth, scale;
  HeadMaterial before;  ///< Of the strip between it and the ring before.
};
constexpr double kBagDepth = 0.7;
constexpr std::array<BagRing, kMouthRings> kBagRings = {{{0.07, 0.99, HeadMaterial::kInnerLip},
                                                         {0.18, 0.96, HeadMaterial::kMouth},
                                                         {0.35, 0.90, HeadMaterial::kMouth},
                                                         {0.60, 0.78, HeadMaterial::kMouth},
                                                         {0.85, 0.60, HeadMaterial::kThroat},
                                                         {1.00, 0.40, HeadMaterial::kThroat}}};

}  // namespace

geometry::Points MouthBagPoints(const geometry::Points& lips, double width) {
  const Eigen::RowVector3d centre = lips.colwise().mean();
  const double depth = kBagDepth * width;
  geometry::Points points(kMouthRings * lips.rows() + 1, 3);
  for (size_t ring = 0; ring < kBagRings.size(); ++ring) {
    const Eigen::RowVector3d moved = centre - Eigen::RowVector3d(0, 0, kBagRings[ring].depth * depth);
    points.middleRows(Eigen::Index(ring) * lips.rows(), lips.rows()) =
        (kBagRings[ring].scale * (lips.rowwise() - centre)).rowwise() + moved;
  }
  points.row(points.rows() - 1) = centre - Eigen::RowVector3d(0, 0, depth);
  return points;
}

std::vector<HeadMaterial> MouthBagMaterials(int size) {
  std::vector<HeadMaterial> materials;
  for (const BagRing& ring : kBagRings) materials.insert(materials.end(), size_t(2 * size), ring.before);
  materials.insert(materials.end(), size_t(size), HeadMaterial::kThroat);
  return materials;
}

}  // namespace daumier::faces
