#pragma once
#include "tests/support/synthetic_face.h"

#include <functional>

namespace daumier::testing {

/// A linear model on SyntheticFace(): 12 Gaussian identity shapes, 7 expression shapes and 8 expressions.
inline faces::FaceModel SyntheticModel() {
  using geometry::Vector3;
  using Field = std::function<Vector3(const Vector3&)>;

  faces::FaceModel model;
  model.face_template = SyntheticFace();
  const geometry::Points& neutral = model.face_template.neutral;
  const auto landmark = [&](int l) -> Vector3 { return neutral.row(model.face_template.annotation.landmarks[l]); };
  const auto near = [](const Vector3& p, const Vector3& centre, double radius) {
    return std::exp(-0.5 * (p - centre).squaredNorm() / (radius * radius));
  };
  /// The displacement fields as the columns of a 3V x N matrix.
  const auto shapes = [&](const std::vector<Field>& fields) {
    Eigen::MatrixXf columns(neutral.size(), fields.size());
    for (size_t s = 0; s < fields.size(); ++s) {
      for (int v = 0; v < neutral.rows(); ++v)
        columns.col(s).segment<3>(3 * v) = fields[s](neutral.row(v)).cast<float>();
    }
    return columns;
  };

  const Vector3 nose = landmark(30), chin = landmark(8), brow = landmark(24), eye = landmark(43),
                mouth_corner = landmark(54);
  const auto flip = [](const Vector3& p) { return Vector3(-p.x(), p.y(), p.z()); };
  const auto on_both = [=](const Vector3& p, const Vector3& centre, double radius) {
    return near(p, centre, radius) + near(flip(p), centre, radius);
  };
  std::vector<Field> identity = {
      [](const Vector3& p) { return Vector3(0.05 * p.x(), 0, 0); },
      [](const Vector3& p) { return Vector3(0, 0.05 * p.y(), 0); },
      [](const Vector3& p) { return Vector3(0, 0, 0.05 * p.z()); },
      [=](const Vector3& p) { return Vector3(0, 0, 0.5 * near(p, nose, 1.5)); },
      [=](const Vector3& p) { return Vector3(0, -0.3 * near(p, chin, 2), 0.3 * near(p, chin, 2)); },
      [=](const Vector3& p) { return Vector3(0, 0, 0.3 * on_both(p, brow, 2)); },
      [=](const Vector3& p) { return Vector3(0.04 * p.x() * on_both(p, eye, 2), 0, 0); },
      [=](const Vector3& p) { return Vector3(0.06 * p.x() * on_both(p, mouth_corner, 3), 0, 0); },
  };
  for (int wave = 1; wave <= 4; ++wave) {
    identity.push_back([=](const Vector3& p) {
      return Vector3(0.1 * std::sin(0.3 * wave * p.x()), 0.1 * std::cos(0.25 * wave * p.y() + wave),
                     0.1 * std::sin(0.2 * wave * p.y()));
    });
  }
  model.identity_shapes = shapes(identity);
  for (int s = 0; s < model.identity_shapes.cols(); ++s) {
    model.identity_controls.push_back(
        {"shape_" + std::to_string(s), faces::IdentityControl::Kind::kGaussian, {s}, 1.0});
  }

  const double mouth_height = mouth_corner.y();
  const auto smile = [=](const Vector3& p) -> Vector3 { return Vector3(0.5, 0.6, -0.2) * near(p, mouth_corner, 1.5); };
  const auto blink = [=](const Vector3& p) {
    return Vector3(0, p.y() > eye.y() - 0.5 ? -0.5 * near(p, eye, 0.8) : 0.0, 0);
  };
  const auto mirrored = [=](const Field& field) { return [=](const Vector3& p) { return flip(field(flip(p))); }; };
  model.expression_shape_names = {"jaw_open",    "smile_left", "smile_right", "blink_left",
                                  "blink_right", "brow_raise", "pucker"};
  model.expression_shapes = shapes({
      [=](const Vector3& p) { return Vector3(0, p.y() < mouth_height ? -2.0 * near(p, chin, 3) : 0.0, 0); },
      smile,
      mirrored(smile),
      blink,
      mirrored(blink),
      [=](const Vector3& p) { return Vector3(0, 0.6 * on_both(p, brow, 1.5), 0); },
      [=](const Vector3& p) -> Vector3 { return Vector3(-0.2 * p.x(), 0, 0.4) * on_both(p, mouth_corner, 1.2); },
  });

  const auto add = [&](const std::string& name, std::initializer_list<float> weights) {
    faces::Expression expression{name, Eigen::VectorXf::Zero(model.expression_shapes.cols())};
    std::copy(weights.begin(), weights.end(), expression.weights.begin());
    model.expressions.push_back(expression);
  };
  add("neutral", {});
  add("jaw_open", {1});
  add("smile", {0, 1, 1});
  add("blink", {0, 0, 0, 1, 1});
  add("brow_raise", {0, 0, 0, 0, 0, 1});
  add("pucker", {0, 0, 0, 0, 0, 0, 1});
  add("laugh", {0.8f, 1, 1, 0.3f, 0.3f, 0.2f});
  add("smirk_left", {0, 1, 0, 0, 0, 0.3f});
  return model;
}

}  // namespace daumier::testing
