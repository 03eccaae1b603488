#pragma once
#include "faces/face_gaussian.h"
#include "tests/support/synthetic_bilinear.h"

#include <span>
#include <vector>

namespace daumier::testing {

/// The normal distribution of 40 faces of a bilinear model about the synthetic face.
inline faces::FaceGaussian PlainGaussian(const faces::FaceTemplate& face_template, const faces::BilinearModel& model) {
  constexpr int kNumFaces = 40;
  std::vector<Eigen::VectorXf> shapes;
  for (int i = 0; i < kNumFaces; ++i)
    shapes.push_back(faces::Reconstruct(model, model.identity_factors.row(i % model.identity_factors.rows()),
                                        model.expression_factors.row(i % model.expression_factors.rows())));
  return faces::FitFaceGaussian(
      kNumFaces, model.num_coordinates(),
      [&](int i) { return std::span<const float>(shapes[size_t(i)].data(), size_t(model.num_coordinates())); },
      face_template.annotation.mirror, {.num_symmetric = 8, .num_asymmetric = 4});
}

/// The same of SyntheticBilinear.
inline faces::FaceGaussian PlainGaussian(const faces::FaceTemplate& face_template) {
  return PlainGaussian(face_template, SyntheticBilinear(face_template, 6, 3, 1));
}

}  // namespace daumier::testing
