#include "datasets/build/sketch_views.h"

#include "core/error.h"
#include "render/strokes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

namespace daumier::datasets {
namespace {

constexpr double kFarthest = 2;  ///< Standard deviations.

double Strayed(double deviation, Rng& rng) {
  return deviation * std::clamp(rng.Normal(), -kFarthest, kFarthest);
}

}  // namespace

render::Camera SketchCamera(const faces::FaceTemplate& face_template, faces::View view, double curve_height) {
  std::vector<int> vertices;
  for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
    if (curve.view == view) vertices.insert(vertices.end(), curve.vertices.begin(), curve.vertices.end());
  }
  DAUMIER_CHECK(!vertices.empty(), "the template of source {} has no {} curve to draw; add 'curves' to its annotation",
                face_template.source, view == faces::View::kFrontal ? "frontal" : "side-view");
  const geometry::Points curves = face_template.neutral(vertices, Eigen::all);
  const Eigen::RowVector3d low = curves.colwise().minCoeff(), high = curves.colwise().maxCoeff();
  const auto camera = view == faces::View::kFrontal ? render::FrontalCamera : render::SideCamera;
  return camera((low + high).transpose() / 2, (high.y() - low.y()) / 2 / curve_height, render::kSketchCanvas);
}

render::Camera TurnedViewCamera(const render::Camera& camera, const TurnedViews& views, const ViewNoise& noise,
                                Rng& rng) {
  DAUMIER_CHECK(views.least <= views.greatest, "turned.least is {:g}, expected at most turned.greatest, {:g}",
                views.least, views.greatest);
  const double side = rng.Uniform() < 0.5 ? -1 : 1;
  const double angle = side * rng.Uniform(views.least, views.greatest) * std::numbers::pi / 180;
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  render::Camera turned = camera;
  turned.camera_from_world = rotation * camera.camera_from_world;
  turned.translation = rotation * camera.translation;
  ViewNoise without_yaw = noise;
  without_yaw.yaw = 0;
  return NoisyCamera(turned, without_yaw, rng);
}

render::Camera NoisyCamera(const render::Camera& camera, const ViewNoise& noise, Rng& rng) {
  const auto turn = [&](double deviation, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(Strayed(deviation, rng) * std::numbers::pi / 180, axis);
  };
  const auto roll = turn(noise.roll, Eigen::Vector3d::UnitZ());
  const auto pitch = turn(noise.pitch, Eigen::Vector3d::UnitX());
  const auto yaw = turn(noise.yaw, Eigen::Vector3d::UnitY());
  const Eigen::Matrix3d rotation = (roll * pitch * yaw).toRotationMatrix();
  render::Camera strayed = camera;
  strayed.camera_from_world = rotation * camera.camera_from_world;
  strayed.translation = rotation * camera.translation;
  strayed.scale *= 1 + Strayed(noise.scale, rng);
  strayed.principal_point.x() += Strayed(noise.shift, rng);
  strayed.principal_point.y() += Strayed(noise.shift, rng);
  return strayed;
}

}  // namespace daumier::datasets
