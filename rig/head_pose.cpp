#include "rig/head_pose.h"

#include "core/error.h"
#include "rig/gaze.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace daumier::rig {
namespace {

Eigen::Vector3f TurnAt(const Eigen::MatrixXf& turns, Eigen::Index frame) {
  return turns.rows() == 0 ? Eigen::Vector3f::Zero().eval() : Eigen::Vector3f(turns.row(frame).transpose());
}

}  // namespace

std::vector<HeadPose> PosesOf(const WeightsClip& clip, const std::vector<std::string>& targets) {
  std::vector<size_t> places;
  for (const std::string& name : clip.names) {
    const auto found = std::ranges::find(targets, name);
    DAUMIER_CHECK(found != targets.end(), "a clip names the target '{}', which the head does not have", name);
    places.push_back(size_t(found - targets.begin()));
  }
  const Eigen::MatrixXf right = EyeTurns(clip, EyeSide::kRight), left = EyeTurns(clip, EyeSide::kLeft);
  std::vector<HeadPose> poses;
  for (Eigen::Index frame = 0; frame < clip.weights.rows(); ++frame) {
    HeadPose pose{.weights = std::vector<float>(targets.size(), 0.0f)};
    for (size_t t = 0; t < places.size(); ++t) pose.weights[places[t]] = clip.weights(frame, Eigen::Index(t));
    pose.head = TurnAt(clip.head, frame);
    pose.right_eye = TurnAt(right, frame);
    pose.left_eye = TurnAt(left, frame);
    poses.push_back(std::move(pose));
  }
  return poses;
}

HeadPose PoseNamed(const std::vector<std::string>& targets,
                   std::initializer_list<std::pair<std::string_view, float>> weights) {
  WeightsClip clip;
  clip.names = targets;
  clip.weights = Eigen::MatrixXf::Zero(1, Eigen::Index(targets.size()));
  for (const auto& [name, weight] : weights) {
    const auto found = std::ranges::find(targets, name);
    if (found != targets.end()) clip.weights(0, found - targets.begin()) = weight;
  }
  return PosesOf(clip, targets).front();
}

Eigen::Matrix3d RotationOf(const Eigen::Vector3f& turn) {
  const Eigen::Vector3d angles = turn.cast<double>();
  return (Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

PosableHead::PosableHead(const RiggedHead& head)
    : skin_(head.mesh.vertices, head.targets), head_pivot_(head.head_pivot) {
  DAUMIER_CHECK(head.eyes.empty() || head.eyes.size() == 2, "a head has {} eyes, expected 0 or 2", head.eyes.size());
  for (const RiggedEye& eye : head.eyes) {
    eyes_.push_back(eye.mesh.vertices);
    eye_centres_.push_back(eye.centre);
  }
  for (const HeadAttachment& attachment : head.attachments) attachments_.push_back(attachment.mesh.vertices);
}

geometry::Points PosableHead::Vertices(const HeadPose& pose) const {
  Eigen::Index num_vertices = skin_.num_vertices();
  for (const geometry::Points& eye : eyes_) num_vertices += eye.rows();
  for (const geometry::Points& attachment : attachments_) num_vertices += attachment.rows();
  geometry::Points vertices(num_vertices, 3);
  Eigen::Index row = skin_.num_vertices();
  vertices.topRows(row) = skin_.At(pose.weights);
  for (size_t i = 0; i < eyes_.size(); ++i) {
    const Eigen::Matrix3d rotation = RotationOf(i == 0 ? pose.right_eye : pose.left_eye);
    vertices.middleRows(row, eyes_[i].rows()) =
        (eyes_[i] * rotation.transpose()).rowwise() + eye_centres_[i].transpose();
    row += eyes_[i].rows();
  }
  for (const geometry::Points& attachment : attachments_) {
    vertices.middleRows(row, attachment.rows()) = attachment;
    row += attachment.rows();
  }
  if (pose.head.isZero(0)) return vertices;
  const Eigen::RowVector3d pivot = head_pivot_.transpose();
  return ((vertices.rowwise() - pivot) * RotationOf(pose.head).transpose()).rowwise() + pivot;
}

}  // namespace daumier::rig
