#include "rig/head_interior.h"

#include "faces/annotation.h"
#include "geometry/alignment.h"
#include "geometry/path.h"
#include "rig/arkit_names.h"
#include "rig/mouth_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <string_view>

namespace daumier::rig {
namespace {

constexpr int kRightCorner = 60, kLeftCorner = 64;  // Landmarks.
constexpr std::array<int, 2> kUpperLip = {51, 62}, kLowerLip = {57, 66};
constexpr int kFirstOfJaw = 4, kLastOfJaw = 12;
constexpr double kTeethChart = 0.5, kTongueChart = 0.3;                  // ChartPiece::size
constexpr double kSkinReach = 0.9, kChinReach = 0.7, kJawReach = 0.3;    // In widths of the mouth.
constexpr double kBehindLips = 0.04, kClearance = 0.02, kDeepest = 0.5;  // Likewise.
constexpr double kHighest = 0.3, kLowest = -0.3;                         // Skin that teeth are behind, likewise.
constexpr double kClosed = 0.04;  // Between the ends of lips that are closed, likewise.

enum class Motion { kNone, kJaw, kTongue };

bool IsSmile(const std::string& target) {
  const auto index = FindArkitName(target);
  return index && ArkitNames()[size_t(*index)].starts_with("mouthSmile");
}

Motion MotionOf(const std::string& target) {
  constexpr std::array<std::string_view, 4> kJawNames = {"jawOpen", "jawForward", "jawLeft", "jawRight"};
  const auto index = FindArkitName(target);
  if (!index) return Motion::kNone;
  const std::string_view name = ArkitNames()[size_t(*index)];
  if (name == "tongueOut") return Motion::kTongue;
  return std::find(kJawNames.begin(), kJawNames.end(), name) != kJawNames.end() ? Motion::kJaw : Motion::kNone;
}

}  // namespace

HeadInterior::HeadInterior(const faces::FaceTemplate& face_template) : at_rest_(NumVertices(), 3) {
  at_rest_ << TeethPoints(Jaw::kUpper), TeethPoints(Jaw::kLower), TongueAtRest();
  const auto& landmarks = face_template.annotation.landmarks;
  const geometry::Points& neutral = face_template.neutral;
  right_corner_ = landmarks[kRightCorner];
  left_corner_ = landmarks[kLeftCorner];
  const auto neighbours = geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices());
  const auto path = [&](const std::array<int, 2>& ends) {
    return geometry::ShortestPath(neutral, neighbours, landmarks[size_t(ends[0])], landmarks[size_t(ends[1])]);
  };
  upper_lip_ = path(kUpperLip);
  lower_lip_ = path(kLowerLip);
  const double width = (neutral.row(left_corner_) - neutral.row(right_corner_)).norm();
  const Eigen::RowVector3d mouth = 0.5 * (neutral.row(left_corner_) + neutral.row(right_corner_)),
                           chin = neutral.row(landmarks[faces::kChinLandmark]);
  for (int v = 0; v < neutral.rows(); ++v) {
    const auto is_near = [&](const Eigen::RowVector3d& point, double reach) {
      return (neutral.row(v) - point).norm() <= reach * width;
    };
    if (is_near(mouth, kSkinReach)) skin_.push_back(v);
    if (is_near(chin, kChinReach) && neutral(v, 1) < 0.5 * (mouth.y() + chin.y())) chin_.push_back(v);
    const auto first = landmarks.begin() + kFirstOfJaw, last = landmarks.begin() + kLastOfJaw + 1;
    if (std::any_of(first, last, [&](int l) { return is_near(neutral.row(l), kJawReach); })) jaw_.push_back(v);
  }
}

int HeadInterior::NumVertices() {
  return 2 * kTeethTube.num_vertices() + kTongueTube.num_vertices();
}

std::vector<ChartPiece> HeadInterior::Charts(int first_vertex) {
  const int num_teeth = kTeethTube.num_vertices();
  return {
      TubeChart(kTeethTube, TeethColumns(), 0.35, TextureChart::kTeeth, first_vertex, kTeethChart),
      TubeChart(kTeethTube, TeethColumns(), 0.35, TextureChart::kTeeth, first_vertex + num_teeth, kTeethChart),
      TubeChart(kTongueTube, TongueColumns(), 0.7, TextureChart::kTongue, first_vertex + 2 * num_teeth, kTongueChart)};
}

std::vector<faces::HeadMaterial> HeadInterior::Materials() {
  std::vector<faces::HeadMaterial> materials = TeethMaterials();
  const std::vector<faces::HeadMaterial> of_jaw = materials;
  materials.insert(materials.end(), of_jaw.begin(), of_jaw.end());
  materials.insert(materials.end(), size_t(kTongueTube.num_triangles()), faces::HeadMaterial::kTongue);
  return materials;
}

HeadInterior::Place HeadInterior::PlaceOf(const geometry::Points& face) const {
  const geometry::Vector3 right = face.row(right_corner_), left = face.row(left_corner_);
  const double width = (left - right).norm();
  geometry::Vector3 across = left - right;
  across.z() = 0;
  across.normalize();
  const geometry::Vector3 up(-across.y(), across.x(), 0);
  Place place{0.5 * (left + right), {}, 0, 0};
  place.axes << across, up, geometry::Vector3::UnitZ();
  place.axes *= width;
  const geometry::Points upper = face(upper_lip_, Eigen::all), lower = face(lower_lip_, Eigen::all);
  const double upper_end = (upper * up).minCoeff(), lower_end = (lower * up).maxCoeff();
  place.origin += up * (upper_end - up.dot(place.origin));
  place.open = std::max(0.0, (upper_end - lower_end) / width - kClosed);
  place.origin.z() = std::min(upper(upper.rows() - 1, 2), lower(lower.rows() - 1, 2)) - kBehindLips * width;
  // Behind all skin before the front of the upper teeth, which are in front of the lower ones.
  double push = 0;
  for (const int v : skin_) {
    const geometry::Vector3 p = place.axes.transpose() * (face.row(v).transpose() - place.origin) / (width * width);
    if (p.y() > kHighest || p.y() < kLowest - place.open || !IsInArch(Jaw::kUpper, p.x())) continue;
    push = std::max(push, ArchDepth(Jaw::kUpper, p.x()) + kClearance - p.z());
  }
  place.origin.z() -= std::min(push, kDeepest) * width;
  place.lip = (Eigen::VectorXd(lower.col(2)).maxCoeff() - place.origin.z()) / width;
  return place;
}

/// In widths of the mouth: how much farther back the lower teeth of a place must be behind the skin of a face.
double HeadInterior::LowerPush(const Place& place, const geometry::Points& face) const {
  constexpr double kTop = -0.08;  // Lips above it may be open.
  double push = 0;
  for (const int v : skin_) {
    const geometry::Vector3 p =
        place.axes.transpose() * (face.row(v).transpose() - place.origin) / place.axes.col(0).squaredNorm();
    if (p.y() > kTop - place.open || p.y() < kLowest - place.open || !IsInArch(Jaw::kLower, p.x())) continue;
    push = std::max(push, ArchDepth(Jaw::kLower, p.x()) + kClearance - p.z());
  }
  return std::min(push, kDeepest);
}

geometry::Points HeadInterior::Vertices(const geometry::Points& face) const {
  const Place place = PlaceOf(face);
  geometry::Points vertices = at_rest_;
  vertices.bottomRows(NumVertices() - kTeethTube.num_vertices()).col(1).array() -= place.open;
  return (vertices * place.axes.transpose()).rowwise() + place.origin.transpose();
}

Eigen::Isometry3d HeadInterior::JawMotion(const geometry::Points& from, const geometry::Points& to) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = geometry::AlignSimilarity(from(jaw_, Eigen::all), to(jaw_, Eigen::all)).rotation;
  const geometry::Points chin = from(chin_, Eigen::all), moved = to(chin_, Eigen::all);
  motion.translation() = moved.colwise().mean().transpose() - motion.linear() * chin.colwise().mean().transpose();
  return motion;
}

Eigen::MatrixXf HeadInterior::Offsets(const geometry::Points& face, const MorphTargets& targets) const {
  using Flat = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  const geometry::Points vertices = Vertices(face);
  const Eigen::Index num_upper = kTeethTube.num_vertices();
  geometry::Points smile = geometry::Points::Zero(face.rows(), 3);  // It draws the skin back over the lower teeth.
  for (Eigen::Index t = 0; t < targets.num_targets(); ++t)
    if (IsSmile(targets.names[size_t(t)])) smile += Flat(targets.offsets.col(t).data(), face.rows(), 3).cast<double>();
  Eigen::MatrixXf offsets = Eigen::MatrixXf::Zero(3 * NumVertices(), targets.num_targets());
  for (Eigen::Index t = 0; t < targets.num_targets(); ++t) {
    const Motion motion = MotionOf(targets.names[size_t(t)]);
    if (motion == Motion::kNone) continue;
    geometry::Points moved = vertices;
    if (motion == Motion::kTongue) {
      const Place place = PlaceOf(face);
      moved.bottomRows(kTongueTube.num_vertices()) += (TongueOut(place.lip) - TongueAtRest()) * place.axes.transpose();
    }
    if (!targets.offsets.col(t).isZero(0)) {
      const geometry::Points pose = face + Flat(targets.offsets.col(t).data(), face.rows(), 3).cast<double>(),
                             smiling = pose + smile;
      const Eigen::Isometry3d jaw = JawMotion(face, pose), back = jaw.inverse();
      const geometry::Points turned_back =
          (smiling * back.linear().transpose()).rowwise() + back.translation().transpose();
      const Place place = PlaceOf(face);
      const Eigen::RowVector3d push = LowerPush(place, turned_back) * place.axes.col(2).transpose();
      for (Eigen::Index v = num_upper; v < vertices.rows(); ++v)
        moved.row(v) = (jaw * (moved.row(v) - push).transpose()).transpose();
    }
    const geometry::Points moves = moved - vertices;
    offsets.col(t) = Eigen::Map<const Eigen::VectorXd>(moves.data(), moves.size()).cast<float>();
  }
  return offsets;
}

}  // namespace daumier::rig
