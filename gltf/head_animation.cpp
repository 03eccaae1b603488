#include "gltf/head_animation.h"

#include "core/error.h"
#include "rig/gaze.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::gltf {
namespace {

void CheckClip(const rig::WeightsClip& clip) {
  DAUMIER_CHECK(clip.frames_per_second > 0 && std::isfinite(clip.frames_per_second),
                "the clip has {} frames a second, expected a positive number", clip.frames_per_second);
  DAUMIER_CHECK(std::ssize(clip.names) == clip.weights.cols(), "the clip has {} names and {} columns of weights",
                clip.names.size(), clip.weights.cols());
  DAUMIER_CHECK(std::set<std::string>(clip.names.begin(), clip.names.end()).size() == clip.names.size(),
                "the clip names a target twice");
  for (Eigen::Index n = 0; n < clip.weights.rows(); ++n) {
    for (Eigen::Index t = 0; t < clip.weights.cols(); ++t) {
      const float weight = clip.weights(n, t);
      DAUMIER_CHECK(weight >= 0 && weight <= 1, "frame {} of the clip has {} for {}, expected 0 .. 1", n, weight,
                    clip.names[size_t(t)]);
    }
  }
}

/// N x T: the clip's weights in the order of `targets`, 0 for those that it does not name.
FloatRows WeightsOf(const rig::WeightsClip& clip, const std::vector<std::string>& targets) {
  FloatRows weights = FloatRows::Zero(clip.num_frames(), std::ssize(targets));
  for (size_t c = 0; c < clip.names.size(); ++c) {
    const auto found = std::find(targets.begin(), targets.end(), clip.names[c]);
    DAUMIER_CHECK(found != targets.end(), "the clip moves {}, which is no target of this head", clip.names[c]);
    weights.col(found - targets.begin()) = clip.weights.col(Eigen::Index(c));
  }
  return weights;
}

/// N x 4 of N x 3 turns (WeightsClip); the identity where there are none.
FloatRows Quaternions(const Eigen::MatrixXf& turns, int num_frames, const char* part) {
  FloatRows quaternions(num_frames, 4);
  quaternions.rowwise() = Eigen::RowVector4f(0, 0, 0, 1);
  if (turns.size() == 0) return quaternions;
  DAUMIER_CHECK(turns.rows() == num_frames && turns.cols() == 3,
                "the clip turns the {} in {} x {} values, expected {} x 3", part, turns.rows(), turns.cols(),
                num_frames);
  DAUMIER_CHECK(turns.allFinite(), "the clip turns the {} by a value that is not finite", part);
  for (int n = 0; n < num_frames; ++n) {
    const Eigen::Vector3d turn = turns.row(n).transpose().cast<double>();
    const Eigen::Quaterniond rotation = Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX()) *
                                        Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ());
    Eigen::Vector4f coefficients = rotation.normalized().coeffs().cast<float>();
    // q and -q are one rotation; the nearer one to its predecessor is the short way between them.
    const float sign = n > 0 ? coefficients.dot(quaternions.row(n - 1).transpose()) : coefficients.w();
    quaternions.row(n) = (sign < 0 ? -1.f : 1.f) * coefficients.transpose();
  }
  return quaternions;
}

bool IsNeutral(const HeadAnimation& animation, Eigen::Index key) {
  for (const FloatRows* part : {&animation.head, &animation.right_eye, &animation.left_eye}) {
    if (part->row(key).head<3>().any()) return false;
  }
  return !animation.weights.row(key).any();
}

bool HoldsNeutral(const HeadAnimation& animation) {
  for (size_t k = 0; k < animation.times.size(); ++k) {
    if (!IsNeutral(animation, Eigen::Index(k))) return false;
    if (animation.times[k] >= float(kNeutralSeconds)) return true;
  }
  return false;
}

/// `rows` after two copies of `neutral`.
FloatRows AfterNeutral(const FloatRows& rows, const Eigen::RowVectorXf& neutral) {
  FloatRows longer(rows.rows() + 2, rows.cols());
  longer << neutral, neutral, rows;
  return longer;
}

}  // namespace

HeadAnimation ResolveClip(const rig::WeightsClip& clip, const std::vector<std::string>& targets) {
  CheckClip(clip);
  const int num_frames = clip.num_frames();
  HeadAnimation animation;
  animation.weights = WeightsOf(clip, targets);
  animation.head = Quaternions(clip.head, num_frames, "head");
  animation.right_eye = Quaternions(rig::EyeTurns(clip, rig::EyeSide::kRight), num_frames, "right eye");
  animation.left_eye = Quaternions(rig::EyeTurns(clip, rig::EyeSide::kLeft), num_frames, "left eye");
  for (int n = 0; n < num_frames; ++n) animation.times.push_back(float(n / clip.frames_per_second));
  if (num_frames == 0 || HoldsNeutral(animation)) return animation;

  animation.lead_in_seconds = 2 * kNeutralSeconds;
  for (int n = 0; n < num_frames; ++n) {
    animation.times[size_t(n)] = float(animation.lead_in_seconds + n / clip.frames_per_second);
  }
  animation.times.insert(animation.times.begin(), {0.f, float(kNeutralSeconds)});
  animation.weights = AfterNeutral(animation.weights, Eigen::RowVectorXf::Zero(animation.weights.cols()));
  for (FloatRows* part : {&animation.head, &animation.right_eye, &animation.left_eye}) {
    *part = AfterNeutral(*part, Eigen::RowVector4f(0, 0, 0, 1));
  }
  return animation;
}

}  // namespace daumier::gltf
