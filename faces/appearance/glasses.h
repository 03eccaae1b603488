#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"
#include "faces/face_model.h"

#include <array>
#include <vector>

namespace daumier::faces {

/// Glasses for faces of a topology: closed tubes around the eyes, a bridge over the nose, temples to the ears, and for
/// dark ones closed lenses. Their places follow from the face: in front of all its skin behind the frames, outside of
/// its temples.
class GlassesFit {
 public:
  explicit GlassesFit(const FaceTemplate& face_template);

  void AddGlasses(const geometry::Points& face, const Looks& looks, HeadSoup& soup) const;

 private:
  std::array<std::vector<int>, 2> eyes_;   ///< Landmarks of the right and the left eye.
  std::vector<int> front_;                 ///< Vertices that may lie behind the frames.
  std::array<std::vector<int>, 2> sides_;  ///< Vertices between eyes and ears, right and left.
  double edge_ = 0;            ///< Mean length of an edge there, on the template, as a share of the eye's width.
  std::array<int, 2> ears_{};  ///< Where temples end: right and left.
};

}  // namespace daumier::faces
