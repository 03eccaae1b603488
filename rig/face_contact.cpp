#include "rig/face_contact.h"

#include "core/parallel.h"
#include "faces/face_holes.h"
#include "faces/openings.h"
#include "rig/arkit_names.h"
#include "rig/lid_edges.h"
#include "rig/mouth_shares.h"

#include <algorithm>
#include <cmath>

namespace daumier::rig {
namespace {

constexpr double kUpperLidShare = 0.85;              // Of the way between lids that do not meet yet.
constexpr double kLidReach = 0.3, kLipReach = 0.25;  // Skin that follows an edge, as a share of the opening's width.
constexpr int kLeastRings = 3, kMostRings = 12;

Eigen::Index ColumnOf(std::string_view name) {
  return *FindArkitName(name);
}

geometry::Points Posed(const geometry::Points& neutral, const Eigen::VectorXf& offset) {
  geometry::Points pose = neutral;
  Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += offset.cast<double>();
  return pose;
}

Eigen::VectorXf OffsetOf(const geometry::Points& neutral, const geometry::Points& pose) {
  const geometry::Points offset = pose - neutral;
  return Eigen::Map<const Eigen::VectorXd>(offset.data(), offset.size()).cast<float>();
}

/// A seam whose skin follows as far as `reach` times its width.
Seam SeamWithReach(const faces::FaceTemplate& face_template, const SeamEdges& edges, double reach) {
  const geometry::Points& points = face_template.neutral;
  const geometry::Adjacency neighbours =
      geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices());
  double sum = 0;
  int count = 0;
  for (const int v : edges.upper) {
    for (const int other : neighbours[v]) sum += (points.row(v) - points.row(other)).norm(), ++count;
  }
  const double width = (points.row(edges.upper.back()) - points.row(edges.upper.front())).norm();
  const int rings = std::clamp(int(std::lround(reach * width * count / sum)), kLeastRings, kMostRings);
  return {{points, face_template.triangles}, edges, rings};
}

/// The expressions of an eye, without its side; how the eye turns with them, positive to its outer side and down; and the
/// share of the opening that they leave.
struct EyeTarget {
  const char* name;
  double out, down, kept_share;
};
constexpr EyeTarget kEyeTargets[] = {{"eyeBlink", 0, 0, 0},   {"eyeSquint", 0, 0, 1 - kSquintNarrows},
                                     {"eyeWide", 0, 0, 1},    {"eyeLookDown", 0, 1, 1 - kLookDownNarrows},
                                     {"eyeLookUp", 0, -1, 1}, {"eyeLookIn", -1, 0, 1},
                                     {"eyeLookOut", 1, 0, 1}};

}  // namespace

FaceContact::FaceContact(const faces::FaceTemplate& face_template, const geometry::Points& right_blink,
                         const geometry::Points& left_blink)
    : lips_([&] {
        const faces::Opening lips = faces::FindOpenings(face_template).lips;
        return SeamWithReach(face_template, {lips.upper, lips.lower}, kLipReach);
      }()),
      of_lips_(ShareOfLips(face_template)),
      of_left_(ShareOfLeftSide(face_template)) {
  const faces::FaceHoles holes = faces::FindHoles(face_template);
  const geometry::TriangleMesh surface{face_template.neutral, face_template.triangles};
  const auto add = [&](const std::string& side, const std::vector<int>& hole, const geometry::Points& closed) {
    if (hole.empty()) return;
    eyes_.push_back({side, faces::EyeballFit(surface, hole), EyeSkin(surface, hole),
                     SeamWithReach(face_template, FindLidEdges(face_template, hole, closed), kLidReach)});
  };
  add("Right", holes.eye_right, right_blink);
  add("Left", holes.eye_left, left_blink);
}

SeamFrame FaceContact::Eye::Frame(const geometry::Points& neutral, const faces::Eyeball& eyeball) const {
  const SeamEdges& edges = lids.edges();
  const Eigen::Vector3d middle = 0.5 * (neutral.row(edges.upper.front()) + neutral.row(edges.upper.back())).transpose();
  return FrameOfSeam(edges, neutral, middle - eyeball.centre);
}

SeamFrame FaceContact::LipFrame(const geometry::Points& neutral) const {
  return FrameOfSeam(lips_.edges(), neutral, Eigen::Vector3d::UnitZ());
}

void FaceContact::FitEye(const Eye& eye, const geometry::Points& neutral, MorphTargets& targets) const {
  constexpr int kRounds = 3;
  const faces::Eyeball eyeball = eye.fit.Fit(neutral);
  const SeamFrame frame = eye.Frame(neutral, eyeball);
  const double outwards = eye.side == "Left" ? kGazeDegrees : -kGazeDegrees;
  for (const EyeTarget& target : kEyeTargets) {
    auto column = targets.offsets.col(ColumnOf(target.name + eye.side));
    if (column.isZero(0)) continue;
    const bool is_blink = std::string_view(target.name) == "eyeBlink";
    const GazeTurn turn{target.out * outwards, target.down * kGazeDegrees};
    geometry::Points pose = Posed(neutral, column);
    for (int round = 0; round < kRounds; ++round) {
      if (is_blink) {
        eye.lids.Meet(frame, kUpperLidShare, pose);
      } else {
        eye.lids.KeepApart(frame, neutral, target.kept_share, pose);
      }
      eye.skin.KeepOutside(eyeball, turn, neutral, pose);
      if (!is_blink) break;
    }
    if (is_blink) eye.lids.Meet(frame, kUpperLidShare, pose);
    column = OffsetOf(neutral, pose);
  }
}

void FaceContact::FitMouth(const geometry::Points& neutral, MorphTargets& targets) const {
  const SeamFrame frame = LipFrame(neutral);
  const auto column = [&](std::string_view name) { return targets.offsets.col(ColumnOf(name)); };
  for (int e = 0; e < kNumArkitNames; ++e) {
    const std::string_view name = ArkitNames()[size_t(e)];
    if (!name.starts_with("mouth") && !name.starts_with("jaw")) continue;
    if (name == "mouthClose" || name.starts_with("mouthPress") || targets.offsets.col(e).isZero(0)) continue;
    geometry::Points pose = Posed(neutral, targets.offsets.col(e));
    lips_.KeepApart(frame, neutral, 0, pose);
    targets.offsets.col(e) = OffsetOf(neutral, pose);
  }

  if (const Eigen::VectorXf jaw = column("jawOpen"); !jaw.isZero(0)) {
    Eigen::VectorXf with_lips_back = jaw;
    for (Eigen::Index v = 0; v < of_lips_.size(); ++v) with_lips_back.segment<3>(3 * v) *= 1 - of_lips_[v];
    geometry::Points closed = Posed(neutral, with_lips_back);
    lips_.Meet(frame, 0.5, closed);
    column("mouthClose") = OffsetOf(neutral, closed) - jaw;
  }

  if (column("mouthPressLeft").isZero(0) && column("mouthPressRight").isZero(0)) return;
  const Eigen::VectorXf both = column("mouthPressLeft") + column("mouthPressRight");
  const geometry::Points apart = Posed(neutral, both);
  geometry::Points pressed = apart;
  lips_.Meet(frame, 0.5, pressed);
  const Eigen::VectorXf change = OffsetOf(apart, pressed);
  for (Eigen::Index v = 0; v < of_left_.size(); ++v) {
    column("mouthPressLeft").segment<3>(3 * v) += of_left_[v] * change.segment<3>(3 * v);
    column("mouthPressRight").segment<3>(3 * v) += (1 - of_left_[v]) * change.segment<3>(3 * v);
  }
}

void FaceContact::Apply(const geometry::Points& neutral, MorphTargets& targets, unsigned threads) const {
  const int num_eyes = static_cast<int>(eyes_.size());
  ForEachInOrder(
      num_eyes + 1,
      [&](int i) {
        if (i < num_eyes) {
          FitEye(eyes_[size_t(i)], neutral, targets);
        } else {
          FitMouth(neutral, targets);
        }
        return 0;  // Each writes to columns of its own.
      },
      [](int) {}, threads);
}

}  // namespace daumier::rig
