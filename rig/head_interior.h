#pragma once
#include "faces/face_model.h"
#include "faces/head_material.h"
#include "geometry/mesh.h"
#include "rig/head_charts.h"
#include "rig/morph_targets.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace daumier::rig {

/// Teeth of both jaws with gums, and a tongue, behind the lips of any face of a topology: closed surfaces of 718 vertices.
///
/// They are as large as the mouth is wide (landmarks 60 and 64), along the line of its corners, at the height of the
/// lower end of the upper lip, and as far in front as the inner lips and the skin around them allow: the skin before the
/// teeth stays there by 0.02 of the width or more. Lower teeth and tongue of a mouth that is open at rest are lower by how
/// much it is open, but for 0.04 of its width.
class HeadInterior {
 public:
  /// @throws Error if a landmark is not annotated.
  explicit HeadInterior(const faces::FaceTemplate& face_template);

  static int NumVertices();
  /// Their parts of the atlas, with vertices numbered from `first_vertex`, and the material of each triangle.
  static std::vector<ChartPiece> Charts(int first_vertex);
  static std::vector<faces::HeadMaterial> Materials();

  /// NumVertices() x 3 for a face, V x 3, cm: upper teeth, lower teeth, tongue.
  geometry::Points Vertices(const geometry::Points& face) const;

  /// 3 NumVertices() x T, as MorphTargets::offsets: how they follow targets of a face. Lower teeth and
  /// tongue follow jawOpen, jawForward, jawLeft, jawRight and tongueOut as a rigid body, by JawMotion, farther back where the
  /// skin in front of them comes back, also with mouthSmile*; tongueOut moves the
  /// tongue out over the lower lip as well; nothing else moves, whatever the target.
  Eigen::MatrixXf Offsets(const geometry::Points& face, const MorphTargets& targets) const;

  /// The rigid motion of a jaw from a face to another one: turned as the line of the jaw is (least squares), moved as the
  /// chin is.
  Eigen::Isometry3d JawMotion(const geometry::Points& from, const geometry::Points& to) const;

 private:
  struct Place {
    geometry::Vector3 origin;
    Eigen::Matrix3d axes;  ///< Columns: to the left, up and to the front, as long as the mouth is wide.
    double open;           ///< By which lower teeth and tongue are lower, in widths of the mouth.
    double lip;            ///< How far the lower lip is in front of the teeth, in widths of the mouth.
  };
  Place PlaceOf(const geometry::Points& face) const;
  double LowerPush(const Place& place, const geometry::Points& face) const;

  int right_corner_, left_corner_;
  std::vector<int> upper_lip_, lower_lip_;  ///< Along their middle, from outside to inside.
  std::vector<int> skin_;                   ///< Around the mouth.
  std::vector<int> chin_, jaw_;
  geometry::Points at_rest_;
};

}  // namespace daumier::rig
