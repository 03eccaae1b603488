#include "fitting/landmark_head.h"

#include "core/error.h"
#include "fitting/fine_alignment.h"

#include <limits>

namespace daumier::fitting {

FarCamera FarCameraOf(const ScaledView& view) {
  constexpr double kDistance = 1e4;
  return {PoseOfRotation(view.rotation),
          {.view = {.focal = view.scale * kDistance, .centre = 0, .distance = kDistance}, .shift = view.shift}};
}

ShownHead ShownHeadOf(const rig::HeadRig& rig, const faces::FaceTemplate& face_template, const geometry::Points& face,
                      const ScaledView& view, const PicturePoints& landmarks) {
  DAUMIER_CHECK(landmarks.rows() == 68, "{} landmarks of a picture, expected 68", landmarks.rows());
  const auto [pose, camera] = FarCameraOf(view);
  PicturePoints in_view = landmarks.rowwise() - view.shift.transpose();
  Eigen::VectorXd confidences = Eigen::VectorXd::Ones(68);
  for (Eigen::Index k = 0; k < 68; ++k)
    if (!in_view.row(k).allFinite()) in_view.row(k).setZero(), confidences[k] = 0;
  if (confidences.isZero()) return ShownHeadOf(rig, face, pose, camera, PortraitLight{});
  const FineAlignment alignment(face_template);
  return ShownHeadOf(rig, alignment.Align(face, pose, in_view, confidences, camera.view).vertices, pose, camera,
                     PortraitLight{});
}

PicturePoints LandmarksAmong(const faces::FaceTemplate& face_template, const std::vector<PicturedPoint>& points) {
  PicturePoints landmarks = PicturePoints::Constant(68, 2, std::numeric_limits<double>::quiet_NaN());
  for (const PicturedPoint& point : points)
    for (Eigen::Index k = 0; k < 68; ++k)
      if (face_template.annotation.landmarks[size_t(k)] == point.vertex) landmarks.row(k) = point.pixel.transpose();
  return landmarks;
}

}  // namespace daumier::fitting
