#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"
#include "faces/face_model.h"

#include <array>
#include <vector>

namespace daumier::faces {

/// Beards of faces of a topology: closed shells over triangles of the skin, which leave it where their height is above 0.
class BeardShells {
 public:
  explicit BeardShells(const FaceTemplate& face_template);

  /// `normals`: V x 3, of the face's vertices.
  void AddBeard(const geometry::Points& face, const geometry::Points& normals, const Looks& looks, double size,
                HeadSoup& soup) const;

 private:
  struct Shell {
    std::vector<int> vertices;               ///< Of the face.
    std::vector<double> weights, chin;       ///< Of each: 0.5 where the beard ends; how much it hangs from the chin.
    std::vector<double> bulk;                ///< Of each: thinner at the ears.
    std::vector<double> waves;               ///< Of each, about -1 to 1.
    std::vector<Eigen::Vector3i> triangles;  ///< Indices into `vertices`.
    std::vector<std::array<int, 2>> border;  ///< Directed edges without a neighbour.
  };
  std::array<Shell, kBeardStyleNames.size()> shells_;
};

}  // namespace daumier::faces
