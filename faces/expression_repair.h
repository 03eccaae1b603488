#pragma once
#include "faces/face_model.h"
#include "faces/openings.h"
#include "geometry/topology.h"

#include <vector>

namespace daumier::faces {

/// Repairs expressions that were transferred to a strongly changed face. With m the changed face in the expression and
/// r the regular face in the same expression (V x 3, cm), the change d = m - r is averaged over neighbours around
/// triangles of the annotation's region `face` that are flipped against r, in ever wider surroundings: where d is
/// constant, the surface is that of r, moved. Lips and lids that cross deeper than those of r are moved apart along y,
/// with the skin around them.
/// Promises: m where nothing flips or crosses; m away from such places. Thread-safe once made.
class ExpressionRepair {
 public:
  /// @throws Error as FindOpenings and RegionFor.
  explicit ExpressionRepair(const FaceTemplate& face_template);

  /// @throws Error if a shape disagrees.
  geometry::Points Repair(const geometry::Points& made, const geometry::Points& regular) const;

  /// Lips and lids that cross by this much more than the regular ones count as crossing, cm.
  static constexpr double kCrossing = 0.005;

 private:
  bool RelaxFlips(const geometry::Points& regular, int round, geometry::Points& made) const;
  void Spread(Eigen::VectorXd& shift, int num_rings) const;
  bool Separate(const Opening& opening, const geometry::Points& regular, geometry::Points& made) const;

  geometry::Triangles triangles_;  ///< Of the region `face`.
  geometry::Adjacency neighbours_;
  FaceOpenings openings_;
};

}  // namespace daumier::faces
