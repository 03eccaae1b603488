#include "rig/face_contact.h"

#include "core/parallel.h"
#include "faces/face_holes.h"
#include "faces/openings.h"
#include "rig/arkit_names.h"
#include "rig/lid_edges.h"
#include "rig/mouth_shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::rig {
namespace {

constexpr double kUpperLidShare = 0.85;              // Of the way between lids that do not meet yet.
constexpr double kLidReach = 0.3, kLipReach = 0.25;  // Skin that follows an edge, as a share of the opening's width.
constexpr int kLeastRings = 3, kMostRings = 12;
constexpr int kRounds = 3;            // Of meeting and keeping outside, which undo each other.
constexpr double kLeastMove = 0.002;  // Of the skin around an eye, cm; less needs no contact.

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

/// What an expression does to the opening between the lids of an eye.
enum class LidsDo {
  kNarrow,  ///< By a share `narrows` of what eyeBlink does.
  kOpen,    ///< At least not narrow.
};

/// An expression of an eye: how the eye turns with it, positive to its outer side and down.
struct EyeTarget {
  std::string_view name;  ///< Without its side.
  double out, down;
  LidsDo lids;
  double narrows;
  double upper_share;  ///< Of a correction, that of the upper lid.
};
constexpr EyeTarget kEyeTargets[] = {
    {"eyeSquint", 0, 0, LidsDo::kNarrow, kSquintNarrows, 0.5},
    {"eyeLookDown", 0, 1, LidsDo::kNarrow, kLookDownNarrows, kUpperLidShare},
    {"eyeLookIn", -1, 0, LidsDo::kNarrow, 0, 0.5},
    {"eyeLookOut", 1, 0, LidsDo::kNarrow, 0, 0.5},
    {"eyeWide", 0, 0, LidsDo::kOpen, 0, 0},
    {"eyeLookUp", 0, -1, LidsDo::kOpen, 0, 0},
};

/// The brows are above an eye, all else below it: the other lid is the one that stays.
constexpr EyeTarget kBrowTarget = {"", 0, 0, LidsDo::kNarrow, 0, 1}, kOtherTarget = {"", 0, 0, LidsDo::kNarrow, 0, 0};

const EyeTarget& EyeTargetOf(std::string_view name, std::string_view side) {
  for (const EyeTarget& target : kEyeTargets)
    if (name.starts_with(target.name) && name.ends_with(side)) return target;
  return name.starts_with("brow") ? kBrowTarget : kOtherTarget;
}

/// What an expression does to the lips.
enum class LipsDo { kOpen, kStay, kOther };

LipsDo LipsDoIn(std::string_view name) {
  constexpr std::string_view kOpening[] = {"jawOpen",        "mouthFunnel",  "mouthShrug",
                                           "mouthLowerDown", "mouthUpperUp", "noseSneer"};
  if (name == "mouthClose" || name.starts_with("mouthPress")) return LipsDo::kOther;  // They close.
  const auto begins = [&](std::string_view part) { return name.starts_with(part); };
  if (std::ranges::any_of(kOpening, begins)) return LipsDo::kOpen;
  return begins("mouth") || begins("jaw") || begins("cheek") ? LipsDo::kStay : LipsDo::kOther;
}

/// Mean height between the edges of lids, as a share of their width.
double OpeningOf(const FaceContact::Eye& eye, const geometry::Points& points, const faces::Eyeball& eyeball) {
  const std::vector<double> heights = eye.lids.Heights(eye.Frame(points, eyeball), points);
  const std::vector<int>& edge = eye.lids.edges().upper;
  return std::accumulate(heights.begin(), heights.end(), 0.0) / double(heights.size()) /
         (points.row(edge.back()) - points.row(edge.front())).norm();
}

/// Where lids meet at first; afterwards nothing may bring them back into the ball.
SeamDepth DepthIn(int round) {
  return round == 0 ? SeamDepth::kBetween : SeamDepth::kFarther;
}

/// The sphere around an eyeball with its cornea.
faces::Eyeball WithCorneaEverywhere(faces::Eyeball eyeball) {
  eyeball.radii.array() += eyeball.bulge;
  eyeball.bulge = 0;
  return eyeball;
}

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
    const SeamEdges edges = FindLidEdges(face_template, hole, closed);
    Eye eye{side, faces::EyeballFit(surface, hole), EyeSkin(surface, hole, edges),
            SeamWithReach(face_template, edges, kLidReach), 0};
    eye.open = OpeningOf(eye, face_template.neutral, eye.fit.Fit(face_template.neutral));
    eyes_.push_back(std::move(eye));
  };
  add("Right", holes.eye_right, right_blink);
  add("Left", holes.eye_left, left_blink);
}

const std::vector<std::string_view>& FaceContact::Sources() {
  static const std::vector<std::string_view> sources = {"eyeBlinkRight", "eyeBlinkLeft", "mouthPressRight",
                                                        "mouthPressLeft", "jawOpen"};
  return sources;
}

SeamFrame FaceContact::Eye::Frame(const geometry::Points& neutral, const faces::Eyeball& eyeball) const {
  const SeamEdges& edges = lids.edges();
  const Eigen::Vector3d middle = 0.5 * (neutral.row(edges.upper.front()) + neutral.row(edges.upper.back())).transpose();
  return FrameOfSeam(edges, neutral, middle - eyeball.centre);
}

SeamFrame FaceContact::LipFrame(const geometry::Points& neutral) const {
  return FrameOfSeam(lips_.edges(), neutral, Eigen::Vector3d::UnitZ());
}

FaceContact::FittedEye FaceContact::FitBlink(const Eye& eye, const geometry::Points& neutral,
                                             MorphTargets& targets) const {
  FittedEye fitted{&eye, eye.fit.Fit(neutral), {}, {}, {}};
  fitted.anywhere = WithCorneaEverywhere(SetBack(fitted.eyeball));
  fitted.frame = eye.Frame(neutral, fitted.eyeball);
  auto column = targets.offsets.col(ColumnOf("eyeBlink" + eye.side));
  if (!column.isZero(0)) {
    const double open = OpeningOf(eye, neutral, fitted.eyeball), share = eye.open > 0 ? open / eye.open : 1;
    geometry::Points pose = Posed(neutral, float(std::clamp(share, 0.0, 1.0)) * column);
    for (int round = 0; round < kRounds; ++round) {
      eye.lids.Meet(fitted.frame, kUpperLidShare, DepthIn(round), pose);
      eye.skin.KeepOutside(fitted.eyeball, {}, neutral, pose);
      eye.skin.KeepOutside(fitted.anywhere, {}, neutral, pose);
    }
    eye.lids.Meet(fitted.frame, kUpperLidShare, DepthIn(kRounds), pose);
    column = OffsetOf(neutral, pose);
  }
  fitted.blink = column;
  return fitted;
}

Eigen::VectorXf FaceContact::FitLids(const FittedEye& fitted, std::string_view name, const geometry::Points& neutral,
                                     const Eigen::VectorXf& offset) const {
  const Eye& eye = *fitted.eye;
  const EyeTarget& target = EyeTargetOf(name, eye.side);
  const double outwards = eye.side == "Left" ? kGazeDegrees : -kGazeDegrees;
  const GazeTurn turn{target.out * outwards, target.down * kGazeDegrees};
  const geometry::Points blink = Posed(geometry::Points::Zero(neutral.rows(), 3), fitted.blink) * (1 - target.narrows);
  const bool is_own = name.ends_with(eye.side) && name.starts_with("eye");
  geometry::Points pose = Posed(neutral, offset);
  for (int round = 0; round < (is_own ? kRounds : 1); ++round) {
    eye.skin.KeepOutside(fitted.eyeball, turn, neutral, pose);
    pose += blink;
    if (is_own) eye.skin.KeepOutside(fitted.anywhere, {}, neutral, pose);
    if (target.lids == LidsDo::kNarrow && !fitted.blink.isZero(0)) {
      if (is_own) {
        eye.lids.Meet(fitted.frame, target.upper_share, DepthIn(round), pose);
      } else {  // What eyeBlink has done to the skin around is not done again.
        eye.lids.Join(fitted.frame, target.upper_share, DepthIn(round), pose);
      }
    }
    pose -= blink;
    if (target.lids == LidsDo::kOpen) eye.lids.KeepApart(fitted.frame, neutral, 1, pose);
  }
  return OffsetOf(neutral, pose);
}

/// mouthPress*.
void FaceContact::FitPressedLips(const SeamFrame& frame, const geometry::Points& neutral, MorphTargets& targets) const {
  auto left = targets.offsets.col(ColumnOf("mouthPressLeft")), right = targets.offsets.col(ColumnOf("mouthPressRight"));
  if (left.isZero(0) && right.isZero(0)) return;
  // By themselves they leave the lips to each other, so that one side does not close what the other one opens.
  geometry::Points closed = neutral;
  lips_.Join(frame, 0.5, SeamDepth::kBetween, closed);
  for (auto* side : {&left, &right}) {
    geometry::Points pose = Posed(closed, *side);
    lips_.Join(frame, 0.5, SeamDepth::kBetween, pose);
    *side = OffsetOf(closed, pose);
  }
  const geometry::Points apart = Posed(neutral, left + right);
  geometry::Points pressed = apart;
  lips_.Meet(frame, 0.5, SeamDepth::kBetween, pressed);
  const Eigen::VectorXf change = OffsetOf(apart, pressed);
  for (Eigen::Index v = 0; v < of_left_.size(); ++v) {
    left.segment<3>(3 * v) += of_left_[v] * change.segment<3>(3 * v);
    right.segment<3>(3 * v) += (1 - of_left_[v]) * change.segment<3>(3 * v);
  }
}

/// mouthClose, for a jawOpen that is fitted.
void FaceContact::FitClosedLips(const SeamFrame& frame, const geometry::Points& neutral, MorphTargets& targets) const {
  const Eigen::VectorXf jaw = targets.offsets.col(ColumnOf("jawOpen"));
  if (jaw.isZero(0)) return;
  Eigen::VectorXf with_lips_back = jaw;
  for (Eigen::Index v = 0; v < of_lips_.size(); ++v) with_lips_back.segment<3>(3 * v) *= 1 - of_lips_[v];
  geometry::Points closed = Posed(neutral, with_lips_back);
  lips_.Meet(frame, 0.5, SeamDepth::kBetween, closed);
  targets.offsets.col(ColumnOf("mouthClose")) = OffsetOf(neutral, closed) - jaw;
}

/// Of an expression that does not close them: at the neutral face and with `pressed` lips.
Eigen::VectorXf FaceContact::FitLips(const SeamFrame& frame, std::string_view name, const geometry::Points& neutral,
                                     const geometry::Points& pressed, const Eigen::VectorXf& offset) const {
  const LipsDo lips = LipsDoIn(name);
  if (lips == LipsDo::kOther || offset.isZero(0)) return offset;
  const geometry::Points press = pressed - neutral;
  geometry::Points pose = Posed(neutral, offset);
  if (lips == LipsDo::kStay) {
    pose += press;
    lips_.Join(frame, 0.5, SeamDepth::kBetween, pose);
    pose -= press;
    lips_.KeepApart(frame, neutral, 1, pose);
    return OffsetOf(neutral, pose);
  }
  for (int round = 0; round < kRounds; ++round) {
    lips_.KeepApart(frame, neutral, 1, pose);
    pose += press;
    lips_.KeepApart(frame, pressed, 1, pose);
    pose -= press;
  }
  return OffsetOf(neutral, pose);
}

void FaceContact::Apply(const geometry::Points& neutral, MorphTargets& targets, unsigned threads) const {
  std::vector<FittedEye> fitted;
  ForEachInOrder(
      static_cast<int>(eyes_.size()), [&](int i) { return FitBlink(eyes_[size_t(i)], neutral, targets); },
      [&](FittedEye eye) { fitted.push_back(std::move(eye)); }, threads);
  const SeamFrame lip_frame = LipFrame(neutral);
  FitPressedLips(lip_frame, neutral, targets);
  const geometry::Points pressed = Posed(
      neutral, targets.offsets.col(ColumnOf("mouthPressLeft")) + targets.offsets.col(ColumnOf("mouthPressRight")));
  Eigen::Index num_fitted = 0;
  ForEachInOrder(
      kNumArkitNames,
      [&](int e) {
        const std::string_view name = ArkitNames()[size_t(e)];
        Eigen::VectorXf offset = targets.offsets.col(e);
        for (const FittedEye& eye : fitted) {
          if (name == "eyeBlink" + eye.eye->side || eye.eye->skin.GreatestMove(offset) < kLeastMove) continue;
          offset = FitLids(eye, name, neutral, offset);
        }
        return FitLips(lip_frame, name, neutral, pressed, offset);
      },
      [&](const Eigen::VectorXf& offset) { targets.offsets.col(num_fitted++) = offset; }, threads);
  FitClosedLips(lip_frame, neutral, targets);
  targets.offsets.col(ColumnOf("tongueOut")) = float(kTongueOpens) * targets.offsets.col(ColumnOf("jawOpen"));
}

}  // namespace daumier::rig
