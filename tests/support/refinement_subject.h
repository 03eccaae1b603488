#pragma once
#include "faces/face_model_file.h"
#include "systems/sketch/refinement.h"
#include "tests/support/paths.h"

#include <cmath>
#include <numbers>
#include <vector>

/// The mean face of ICT-FaceKit in the shipped weights, and strokes that refine it, placed by its landmarks. Views are
/// 512 pixels a side, in which 200 mm of face height are some 340 pixels.
namespace daumier::testing {

using sketch::CanvasPoints;
using sketch::View;

class RefinementSubject {
 public:
  RefinementSubject()
      : face_template(faces::ReadFaceModelWeights(SourceRoot() / "weights/face-ict").face_template),
        front_(render::FrontalCamera({0, 1.5, 2}, 14, 512)) {}

  render::Camera Camera(const View& view) const { return sketch::ViewCamera(front_, {}, {0, 1.5, 2}, view); }

  /// Where a view shows a vertex.
  Eigen::Vector2d At(int vertex, const View& view) const {
    const geometry::Points point = face_template.neutral.row(vertex);
    return render::Project(Camera(view), point).row(0).head<2>();
  }
  Eigen::Vector2d Landmark(int landmark, const View& view) const {
    return At(face_template.annotation.landmarks[size_t(landmark)], view);
  }

  /// An ellipse as a person draws it: 40 points from the top, not quite closed.
  static CanvasPoints Loop(const Eigen::Vector2d& centre, double half_x, double half_y) {
    CanvasPoints loop;
    for (int i = 0; i < 40; ++i) {
      const double angle = 2 * std::numbers::pi * (i - 10) / 41;
      loop.push_back(centre + Eigen::Vector2d(half_x * std::cos(angle), half_y * std::sin(angle)));
    }
    return loop;
  }

  /// The line through points, moved by a half wave that begins and ends at 0.
  static CanvasPoints Swollen(CanvasPoints line, const Eigen::Vector2d& most) {
    const std::vector<double> arcs = datasets::ArcLengths(line);
    for (size_t i = 0; i < line.size(); ++i) line[i] += std::sin(std::numbers::pi * arcs[i] / arcs.back()) * most;
    return line;
  }

  /// Landmarks from one to another, in a view.
  CanvasPoints Landmarks(int first, int last, const View& view) const {
    CanvasPoints line;
    for (int landmark = first; landmark <= last; ++landmark) line.push_back(Landmark(landmark, view));
    return datasets::Resampled(line, 60);
  }

  /// The profile between two heights, cm, from above, in a view.
  CanvasPoints Profile(double top, double bottom, const View& view) const {
    CanvasPoints line;
    for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
      if (curve.kind != "side_silhouette") continue;
      for (const int v : curve.vertices)
        if (const double y = face_template.neutral(v, 1); y <= top && y >= bottom) line.push_back(At(v, view));
    }
    return datasets::Resampled(line, 60);
  }

  /// The middle of the face's own left cheek.
  Eigen::Vector2d Cheek(const View& view) const {
    return (Landmark(46, view) + Landmark(54, view) + Landmark(13, view)) / 3;
  }

  const faces::FaceTemplate face_template;

 private:
  render::Camera front_;
};

}  // namespace daumier::testing
