#include "faces/controls/face_controls.h"

#include "core/error.h"
#include "faces/controls/control_table.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace daumier::faces {
namespace {

constexpr double kLeastWeight = 1e-4;

Motion MirroredMotion(const Motion& motion) {
  Motion mirrored = motion;
  if (motion.kind == Motion::Kind::kMove) mirrored.vector.x() *= -1;
  if (motion.kind == Motion::Kind::kTurn) mirrored.vector = {motion.vector.x(), -motion.vector.y(), -motion.vector.z()};
  return mirrored;
}

/// The affine map of a motion at a value, as a matrix and where it takes the pivot `centre`.
struct AffineMap {
  Eigen::Matrix3d matrix;
  geometry::Vector3 translation;
};

AffineMap MapOf(const Motion& motion, double value, const geometry::Vector3& centre, double eye_span) {
  const geometry::Vector3 vector = value * motion.vector;
  if (motion.kind == Motion::Kind::kMove) return {Eigen::Matrix3d::Identity(), eye_span * vector};
  Eigen::Matrix3d matrix;
  if (motion.kind == Motion::Kind::kScale)
    matrix = vector.array().exp().matrix().asDiagonal();
  else
    matrix = Eigen::AngleAxisd(vector.norm(), vector.norm() > 0 ? vector.normalized() : geometry::Vector3::UnitX());
  return {matrix, centre - matrix * centre};
}

bool HasRegion(const SoftRegion& region, const FaceTemplate& face_template) {
  return region.annotated.empty() || face_template.annotation.regions.contains(region.annotated);
}

}  // namespace

const std::vector<FaceControl>& AnatomicalControls() {
  static const std::vector<FaceControl> controls = [] {
    std::vector<FaceControl> all;
    for (const auto& rows : {EyeControls(), NoseControls(), MouthControls(), CheekAndChinControls(), HeadControls()})
      all.insert(all.end(), rows.begin(), rows.end());
    return all;
  }();
  return controls;
}

void FaceControls::AddSide(const Eigen::VectorXd& weights, const Motion& motion, const Anchor& pivot, int value,
                           Field& field) {
  Side& side = field.sides.emplace_back(Side{{}, {}, motion, pivot, value});
  for (int v = 0; v < weights.size(); ++v) {
    if (weights[v] > kLeastWeight) side.vertices.push_back(v);
  }
  side.weights = weights(side.vertices);
}

FaceControls::FaceControls(const FaceTemplate& face_template, std::vector<GivenControl> given)
    : face_template_(face_template), given_(std::move(given)) {
  const auto add_value = [&](const std::string& name, const std::string& group) {
    if (std::find(value_names_.begin(), value_names_.end(), name) != value_names_.end())
      throw UsageError(fmt::format("there are two controls of the name '{}'; rename one", name));
    auto found = std::find(group_names_.begin(), group_names_.end(), group);
    if (found == group_names_.end()) found = group_names_.insert(found, group);
    value_names_.push_back(name);
    value_groups_.push_back(static_cast<int>(found - group_names_.begin()));
    return num_values() - 1;
  };
  for (const FaceControl& control : AnatomicalControls()) {
    if (!HasRegion(control.region, face_template)) continue;
    controls_.push_back({control, num_values()});
    Field& field = fields_.emplace_back();
    const Eigen::VectorXd weights = WeightsOf(control.region, face_template),
                          mirrored = WeightsOf(Mirrored(control.region), face_template);
    if (control.sides != FaceControl::Sides::kPaired) {
      AddSide((weights + mirrored) / 2, control.motion, control.pivot, add_value(control.name, control.group), field);
      continue;
    }
    AddSide(weights, control.motion, control.pivot, add_value(control.name + "_left", control.group), field);
    AddSide(mirrored, MirroredMotion(control.motion), Mirrored(control.pivot),
            add_value(control.name + "_right", control.group), field);
  }
  for (const GivenControl& own : given_) {
    DAUMIER_CHECK(own.displacement.rows() == face_template.num_vertices(),
                  "control '{}' displaces {} vertices, the template has {}", own.name, own.displacement.rows(),
                  face_template.num_vertices());
    add_value(own.name, own.group);
  }
  jacobian_.resize(3 * face_template.num_vertices(), num_values());
  constexpr double kStep = 1e-3;
  for (int i = 0; i < num_values(); ++i) {
    const geometry::Points moved =
        (Apply(face_template.neutral, kStep * Eigen::VectorXd::Unit(num_values(), i)) - face_template.neutral) / kStep;
    jacobian_.col(i) = Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size()).cast<float>();
  }
}

geometry::Points FaceControls::Apply(const geometry::Points& face, const Eigen::VectorXd& values) const {
  DAUMIER_CHECK(face.rows() == face_template_.num_vertices() && values.size() == num_values(),
                "{} vertices and {} values for controls of {} vertices and {} values", face.rows(), values.size(),
                face_template_.num_vertices(), num_values());
  const double eye_span = EyeSpan(face_template_);
  geometry::Points result = face;
  for (int i = 0; i < static_cast<int>(given_.size()); ++i) {
    const double value = values[first_given_value() + i];
    if (value != 0) result += value * given_[i].displacement;
  }
  std::vector<geometry::Points> moves;  // Of the sides of a field, all from the face before it.
  for (const Field& field : fields_) {
    moves.clear();
    for (const Side& side : field.sides) {
      const double value = values[side.value];
      geometry::Points& move = moves.emplace_back(geometry::Points(value == 0 ? 0 : side.vertices.size(), 3));
      if (value == 0) continue;
      const AffineMap map = MapOf(side.motion, value, PositionOf(side.pivot, face_template_, result), eye_span);
      const Eigen::Matrix3d change = map.matrix - Eigen::Matrix3d::Identity();
      for (Eigen::Index i = 0; i < move.rows(); ++i) {
        const geometry::Vector3 point = result.row(side.vertices[i]);
        move.row(i) = side.weights[i] * (change * point + map.translation).transpose();
      }
    }
    for (size_t s = 0; s < moves.size(); ++s) {
      for (Eigen::Index i = 0; i < moves[s].rows(); ++i) result.row(field.sides[s].vertices[i]) += moves[s].row(i);
    }
  }
  return result;
}

}  // namespace daumier::faces
