#include "faces/model_frame.h"

#include "core/error.h"

#include <vector>

namespace daumier::faces {
namespace {

// The template of [Jung et al. 2022] in its own units.
constexpr double kHeadHeight = 2.1, kChinY = -0.71, kFrontZ = 0.63;

}  // namespace

geometry::Points ModelFrame::FromCm(const geometry::Points& points) const {
  return (scale * points).rowwise() + offset.transpose();
}

geometry::Points ModelFrame::ToCm(const geometry::Points& points) const {
  return (points.rowwise() - offset.transpose()) / scale;
}

ModelFrame HeadFrame(const FaceTemplate& face_template, double head_height) {
  const geometry::Points& neutral = face_template.neutral;
  const Eigen::RowVector3d low = neutral.colwise().minCoeff(), high = neutral.colwise().maxCoeff();
  const double chin = neutral(face_template.annotation.landmarks[kChinLandmark], 1);
  DAUMIER_CHECK(high.y() > chin, "the chin of {} is its highest vertex", face_template.source);
  DAUMIER_CHECK(head_height > 0, "a head that is {} units high", head_height);
  ModelFrame frame;
  frame.scale = head_height / (high.y() - chin);
  const double size = head_height / kHeadHeight;
  frame.offset = {-frame.scale * (low.x() + high.x()) / 2, size * kChinY - frame.scale * chin,
                  size * kFrontZ - frame.scale * high.z()};
  return frame;
}

Json ModelFrameToJson(const ModelFrame& frame) {
  return {{"scale", frame.scale}, {"offset", std::vector<double>(frame.offset.begin(), frame.offset.end())}};
}

ModelFrame ModelFrameFromJson(const Json& json) {
  const auto offset = json.at("offset").get<std::vector<double>>();
  DAUMIER_CHECK(offset.size() == 3, "malformed model frame: offset has {} numbers, expected 3", offset.size());
  ModelFrame frame;
  frame.scale = json.at("scale").get<double>();
  DAUMIER_CHECK(frame.scale > 0, "malformed model frame: scale is {}", frame.scale);
  frame.offset = Eigen::Map<const Eigen::Vector3d>(offset.data());
  return frame;
}

}  // namespace daumier::faces
