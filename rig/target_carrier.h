#pragma once
#include "geometry/sparse_factor.h"
#include "rig/head_parts.h"
#include "rig/head_slits.h"
#include "rig/template_match.h"

#include <optional>
#include <vector>

namespace daumier::rig {

/// Carries targets of a registered template to the places of a head of another topology. A place of the skin takes
///   m = sum_k b_k o_k
/// of the nearest point of the template (barycentrics b, offsets o of its triangle) among those that face as it does and
/// are not on the other side of its slit, with a trust w that falls from 1 at 0.25 cm to 0 at 0.8 cm from it. Then
///   min_d sum_p w_p / (1.001 - w_p) |d_p - m_p|^2 + 0.05 sum over edges |d_p - d_q|^2
/// fills what has no such point (the bag of a mouth, the back of a lid) from what is around it. Places farther than 3 cm
/// from the template, other than around a slit, stay.
/// Places of attached parts take what the nearest place of the skin has, less with its distance: nothing from 3 cm on.
class TargetCarrier {
 public:
  /// head: in the frame of the template. @throws Error if the system has no solution.
  TargetCarrier(const TemplateMatch& match, const HeadSurface& head, const HeadParts& parts,
                const std::vector<FaceSide>& sides);

  /// 3P x T from offsets of the template, 3V x T. Parts of eyes and of the mouth do not move. On all cores.
  Eigen::MatrixXf Carry(const Eigen::MatrixXf& offsets) const;

  /// P: of each place of the skin the point of the template that it takes; nothing where it has none.
  const std::vector<std::optional<geometry::SurfacePoint>>& points() const { return points_; }

 private:
  struct Follower {
    int place, leader;
    float share;
  };
  geometry::Triangles triangles_;  ///< Of the template.
  std::vector<std::optional<geometry::SurfacePoint>> points_;
  std::vector<int> skin_;  ///< Places, ascending.
  Eigen::VectorXd trust_;  ///< Of the places of skin_: w / (1.001 - w).
  std::optional<geometry::SparseFactor> factor_;
  std::vector<Follower> followers_;
};

}  // namespace daumier::rig
