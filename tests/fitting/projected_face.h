#pragma once
#include "fitting/projected_curves.h"
#include "render/camera.h"
#include "tests/support/synthetic_bilinear.h"

namespace daumier::fitting {

/// The synthetic face and a bilinear model of it, seen from the front on the canvas of sketches.
struct ProjectedFace {
  faces::FaceTemplate face_template = testing::SyntheticFace();
  faces::BilinearModel model = testing::SyntheticBilinear(face_template, 4, 3, 5);
  ProjectedCurves curves =
      SeeCurves(face_template, {"silhouette", "brow_left", "brow_right", "nose", "upper_mouth", "lower_mouth"},
                render::FrontalCamera({0, 1, 0}, 16, render::kSketchCanvas));

  Eigen::VectorXf Face(int identity, int expression) const {
    return faces::Reconstruct(model, model.identity_factors.row(identity), model.expression_factors.row(expression));
  }
  std::vector<float> Points(const Eigen::VectorXf& face) const {
    return Project(curves, {face.data(), size_t(face.size())});
  }
  std::vector<float> Ones() const { return std::vector<float>(size_t(curves.num_points()), 1.0f); }
};

/// Mean distance of the vertices of two faces, 3V, cm.
inline double MeanDistance(const Eigen::VectorXf& a, const Eigen::VectorXf& b) {
  const Eigen::VectorXf difference = a - b;
  return Eigen::Map<const Eigen::Matrix3Xf>(difference.data(), 3, difference.size() / 3).colwise().norm().mean();
}

}  // namespace daumier::fitting
