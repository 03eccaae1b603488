#include "faces/controls/control_fit.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Points;

std::vector<Points> FacesToFit(const FaceModel& model, int count = 40) {
  std::vector<Points> faces;
  for (int i = 0; i < count; ++i) {
    Rng rng = Stream(3, "population", i);
    faces.push_back(IdentityFace(model, DrawIdentity(model, rng)));
  }
  return faces;
}

TEST(ControlFit, FindsTheValuesThatMadeAFace) {
  const FaceModel model = testing::SyntheticModel();
  const std::vector<Points> population = FacesToFit(model);
  const FaceControls controls(model.face_template);
  const ControlFit fit(controls, model.face_template, population);
  EXPECT_LT(fit.ValuesOf(fit.mean()).norm(), 1e-4);
  // A face that differs by J z: the residual of the fit is small, though the ridge shares values between like controls.
  const Eigen::VectorXf z = Eigen::VectorXf::Unit(controls.num_values(), controls.entries().back().first_value);
  const Eigen::VectorXd moved = (controls.Jacobian() * z).cast<double>();
  const Points face = fit.mean() + Eigen::Map<const Points>(moved.data(), moved.size() / 3, 3);
  const Eigen::VectorXd found = (controls.Jacobian() * fit.ValuesOf(face).cast<float>()).cast<double>();
  EXPECT_LT((found - moved).norm(), 0.1 * moved.norm());
  EXPECT_TRUE((fit.deviations().array() >= 0).all());
  EXPECT_GT(fit.deviations().maxCoeff(), 0.1);
}

TEST(ControlFit, NeedsAPopulation) {
  const FaceModel model = testing::SyntheticModel();
  const FaceControls controls(model.face_template);
  testing::ExpectError([&] { ControlFit(controls, model.face_template, FacesToFit(model, 7)); }, "too few");
}

}  // namespace
}  // namespace daumier::faces
