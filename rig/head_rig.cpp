#include "rig/head_rig.h"

#include "core/error.h"
#include "faces/mouth_bag.h"
#include "rig/arkit_names.h"
#include "rig/eye_clearance.h"
#include "rig/head_charts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr double kCapSize = 0.14, kRimSize = 0.08, kBagSize = 0.24;  // ChartPiece::size
constexpr double kSmallestMove = 1e-7;                               // cm; less is rounding.
constexpr double kLeastTurn = 5 * std::numbers::pi / 180;            // Of a jaw that opens by turning.

/// The face with a target at weight 1.
geometry::Points Moved(const geometry::Points& face, const MorphTargets& targets, Eigen::Index target) {
  using Flat = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  return face + Flat(targets.offsets.col(target).data(), face.rows(), 3).cast<double>();
}

}  // namespace

HeadRig::HeadRig(const faces::FaceTemplate& face_template)
    : source_(face_template.source),
      licence_(face_template.provenance.value("licence", "unknown")),
      finished_(face_template) {
  const auto& landmarks = face_template.annotation.landmarks;
  const auto ears = face_template.annotation.regions.find("ears");
  ears_ = ears != face_template.annotation.regions.end() && !ears->second.empty()
              ? ears->second
              : std::vector<int>{landmarks.front(), landmarks[16]};

  std::vector<ChartPiece> pieces = {
      SkinChart({finished_.Vertices(face_template.neutral),
                 finished_.skin().topRows(finished_.skin().rows() - finished_.num_cap_triangles())},
                face_template.annotation)};
  for (const faces::HoleClosure& cap : finished_.caps())
    pieces.push_back(ClosureChart(cap, TextureChart::kNeckCap, kCapSize));
  for (const faces::HoleClosure& rim : finished_.rims())
    pieces.push_back(ClosureChart(rim, TextureChart::kLidRim, kRimSize));
  if (finished_.mouth()) pieces.push_back(ClosureChart(*finished_.mouth(), TextureChart::kMouth, kBagSize));

  std::vector<int> used;
  for (const ChartPiece& piece : pieces)
    used.insert(used.end(), piece.triangles.data(), piece.triangles.data() + piece.triangles.size());
  kept_ = geometry::MapKept(used, finished_.num_vertices());
  for (ChartPiece& piece : pieces) {
    piece.triangles = piece.triangles.unaryExpr([&](int v) { return kept_.new_from_old[size_t(v)]; }).eval();
    const bool is_rim = piece.chart == TextureChart::kLidRim;
    if (piece.chart == TextureChart::kMouth) {
      const auto of_bag = faces::MouthBagMaterials(finished_.mouth()->size());
      materials_.insert(materials_.end(), of_bag.begin(), of_bag.end());
    } else {
      materials_.insert(materials_.end(), size_t(piece.triangles.rows()),
                        is_rim ? faces::HeadMaterial::kLidRim : faces::HeadMaterial::kSkin);
    }
  }
  int num_vertices = int(kept_.old_from_new.size());
  if (finished_.mouth()) {
    interior_.emplace(face_template);
    for (ChartPiece& piece : HeadInterior::Charts(num_vertices)) pieces.push_back(std::move(piece));
    const auto of_interior = HeadInterior::Materials();
    materials_.insert(materials_.end(), of_interior.begin(), of_interior.end());
    num_vertices += HeadInterior::NumVertices();
  }
  for (const ChartPiece& piece : pieces) {
    num_mesh_triangles_ += piece.triangles.rows();
    num_mesh_uv_ += piece.uv.rows();
  }
  for (int eye = 0; eye < finished_.num_eyes(); ++eye) {
    pieces.push_back(EyeChart(eye == 0 ? TextureChart::kRightEye : TextureChart::kLeftEye,
                              num_vertices + eye * faces::NumEyeballVertices()));
    num_eye_uv_ = pieces.back().uv.rows();
  }
  texture_space_ = AssembleCharts(pieces);
  texture_space_.materials = materials_;
  for (int eye = 0; eye < finished_.num_eyes(); ++eye) {
    const auto& of_eye = faces::EyeballTopology().materials;
    texture_space_.materials.insert(texture_space_.materials.end(), of_eye.begin(), of_eye.end());
  }
  for (const faces::HoleClosure& rim : finished_.rims()) still_.push_back(kept_.new_from_old[size_t(rim.apex())]);
}

std::vector<faces::Eyeball> HeadRig::Eyeballs(const geometry::Points& neutral) const {
  std::vector<faces::Eyeball> eyeballs = finished_.Eyeballs(neutral);
  for (faces::Eyeball& eyeball : eyeballs) eyeball = SetBack(eyeball);
  return eyeballs;
}

RiggedEye HeadRig::EyeOf(const faces::Eyeball& eyeball, size_t side) const {
  RiggedEye eye{.centre = eyeball.centre};
  const Eigen::Index num_triangles = Eigen::Index(faces::EyeballTopology().triangles.size()),
                     first_triangle = num_mesh_triangles_ + Eigen::Index(side) * num_triangles,
                     first_row = num_mesh_uv_ + Eigen::Index(side) * num_eye_uv_;
  eye.mesh.vertices = faces::EyeballPoints(eyeball).rowwise() - eyeball.centre.transpose();
  eye.mesh.triangles = texture_space_.triangles.middleRows(first_triangle, num_triangles).array() -
                       texture_space_.triangles.middleRows(first_triangle, num_triangles).minCoeff();
  eye.mesh.uv = texture_space_.uv.middleRows(first_row, num_eye_uv_);
  eye.mesh.uv_triangles =
      texture_space_.uv_triangles.middleRows(first_triangle, num_triangles).array() - int(first_row);
  eye.materials = faces::EyeballTopology().materials;
  return eye;
}

geometry::Vector3 HeadRig::HeadPivot(const geometry::Points& neutral) const {
  const geometry::Points ears = neutral(ears_, Eigen::all);
  return 0.5 * (ears.colwise().minCoeff() + ears.colwise().maxCoeff()).transpose();
}

geometry::Vector3 HeadRig::JawPivot(const geometry::Points& neutral, const MorphTargets& targets) const {
  const geometry::Vector3 otherwise = HeadPivot(neutral);
  const auto open = std::find_if(targets.names.begin(), targets.names.end(), [](const std::string& name) {
    const auto index = FindArkitName(name);
    return index && ArkitNames()[size_t(*index)] == "jawOpen";
  });
  if (!interior_ || open == targets.names.end()) return otherwise;
  const Eigen::Isometry3d motion = interior_->JawMotion(neutral, Moved(neutral, targets, open - targets.names.begin()));
  if (Eigen::AngleAxisd(motion.linear()).angle() < kLeastTurn) return otherwise;
  // The point of the plane x = 0 of the pivot that the motion keeps: (I - R) p = t in y and z.
  const Eigen::Matrix2d turn = Eigen::Matrix2d::Identity() - motion.linear().bottomRightCorner<2, 2>();
  const Eigen::Vector2d pivot = turn.inverse() * motion.translation().tail<2>();
  return {otherwise.x(), pivot.x(), pivot.y()};
}

RiggedHead HeadRig::On(const geometry::Points& neutral, const MorphTargets& targets) const {
  DAUMIER_CHECK(targets.offsets.rows() == 3 * neutral.rows() && targets.offsets.cols() == targets.num_targets(),
                "{} targets of {} numbers were given for {} vertices", targets.num_targets(), targets.offsets.rows(),
                neutral.rows());
  const std::vector<faces::Eyeball> eyeballs = Eyeballs(neutral);
  const geometry::Points finished = finished_.Vertices(neutral, eyeballs);
  const geometry::Points interior = interior_ ? interior_->Vertices(neutral) : geometry::Points(0, 3);
  const Eigen::Index num_kept = Eigen::Index(kept_.old_from_new.size()), num_vertices = num_kept + interior.rows();

  RiggedHead head;
  head.mesh.vertices.resize(num_vertices, 3);
  head.mesh.vertices << geometry::SelectPoints(finished, kept_), interior;
  head.mesh.triangles = texture_space_.triangles.topRows(num_mesh_triangles_);
  head.mesh.uv = texture_space_.uv.topRows(num_mesh_uv_);
  head.mesh.uv_triangles = texture_space_.uv_triangles.topRows(num_mesh_triangles_);
  head.materials = materials_;
  for (int f = 0; f < num_mesh_triangles_; ++f)
    if (texture_space_.charts[size_t(f)] == TextureChart::kNeckCap) head.neck_cap.push_back(f);
  for (size_t side = 0; side < eyeballs.size(); ++side) head.eyes.push_back(EyeOf(eyeballs[side], side));

  head.targets.names = targets.names;
  head.targets.offsets = Eigen::MatrixXf::Zero(3 * num_vertices, targets.num_targets());
  if (interior_) head.targets.offsets.bottomRows(3 * interior.rows()) = interior_->Offsets(neutral, targets);
  for (Eigen::Index t = 0; t < targets.num_targets(); ++t) {
    if (targets.offsets.col(t).isZero(0)) continue;
    geometry::Points moves =
        geometry::SelectPoints(finished_.Vertices(Moved(neutral, targets, t), eyeballs) - finished, kept_);
    for (const int v : still_) moves.row(v).setZero();
    moves = moves.array().unaryExpr([](double move) { return std::abs(move) < kSmallestMove ? 0 : move; }).eval();
    head.targets.offsets.col(t).head(3 * num_kept) =
        Eigen::Map<const Eigen::VectorXd>(moves.data(), moves.size()).cast<float>();
  }
  head.head_pivot = HeadPivot(neutral);
  head.jaw_pivot = JawPivot(neutral, targets);
  head.source = source_;
  head.licence = licence_;
  return head;
}

}  // namespace daumier::rig
