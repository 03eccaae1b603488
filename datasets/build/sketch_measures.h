#pragma once
#include "datasets/read/sketch_facts.h"
#include "faces/face_model.h"
#include "faces/openings.h"
#include "render/camera.h"

#include <array>
#include <vector>

namespace daumier::datasets {

/// How a camera sees a face that looks to +z.
struct HeadAngles {
  double yaw, pitch, roll;  ///< Degrees, as SketchFacts.
};
HeadAngles HeadAnglesOf(const render::Camera& camera);

/// Whether points of curves may be hidden by the face: all count as seen from the front.
enum class CurveVisibility { kAll, kSeen };

/// Measures the facts of sketches of the faces of a topology.
class SketchMeasures {
 public:
  /// `curve_vertices`: of all points of a sketch's curves.
  SketchMeasures(const faces::FaceTemplate& face_template, std::vector<int> curve_vertices);

  /// `face`: V x 3, cm. @throws Error as render::Visibility.
  SketchFacts Measure(const geometry::Points& face, const render::Camera& camera, CurveVisibility visibility) const;

  /// The vertices inside the outline: all above a plane through the jaw, but for the ears, and behind the face all
  /// above the ends of the jaw. All vertices where the template has no frontal curve of kind "silhouette".
  const std::vector<int>& skull() const { return skull_; }

 private:
  std::vector<SketchFacts::Point> Outline(const geometry::Points& pixels) const;
  std::vector<SketchFacts::Point> NoseContour(const geometry::Points& pixels) const;

  std::vector<int> curve_vertices_, skull_, nose_;
  std::array<int, 68> landmarks_;
  int hairline_ = -1;
  geometry::Triangles triangles_;
  std::vector<faces::Opening> openings_;  ///< Right and left eye, mouth: pairs of landmarks alone.
  double mm_per_cm_ = 0;
};

}  // namespace daumier::datasets
