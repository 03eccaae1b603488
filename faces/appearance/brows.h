#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"
#include "faces/face_model.h"

#include <array>
#include <vector>

namespace daumier::faces {

/// Brows and lashes of faces of a topology: closed, thin relief on the skin. A brow lies on a patch of places around
/// its line (FindBrowLines) that are fixed on the template's triangles and follow every face.
class BrowPatches {
 public:
  explicit BrowPatches(const FaceTemplate& face_template);

  /// `normals`: V x 3, of the face's vertices.
  void AddBrows(const geometry::Points& face, const geometry::Points& normals, const Looks& looks,
                HeadSoup& soup) const;
  /// Along the upper lids.
  void AddLashes(const geometry::Points& face, const Looks& looks, HeadSoup& soup) const;

 private:
  static constexpr int kAlong = 21, kAcross = 11;  ///< Places of a patch.
  static constexpr double kReach = 3.2;            ///< Half of a patch's height in half heights of the brow.
  struct Place {
    std::array<int, 3> vertices;
    std::array<double, 3> weights;
  };
  struct Patch {
    std::vector<Place> places;        ///< kAlong x kAcross, across in rows.
    std::vector<double> half_height;  ///< kAlong, cm, on the template.
    bool left;
  };
  std::vector<Patch> patches_;
  std::vector<std::vector<int>> lids_;  ///< Upper lids, right and left, from the inner corner to the outer one.
  double eye_span_;
  std::array<int, 2> outer_corners_{};
};

}  // namespace daumier::faces
