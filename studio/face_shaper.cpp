#include "studio/face_shaper.h"

#include "core/error.h"
#include "core/options.h"
#include "core/random.h"
#include "faces/face_model_file.h"
#include "fitting/code_handles.h"
#include "fitting/exaggerated_face.h"
#include "fitting/mesh_code.h"
#include "rig/arkit_names.h"
#include "systems/deform/edit_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace daumier::studio {
namespace {

/// The place of a name. @throws UsageError suggesting the nearest.
template <class Names>
int PlaceOf(std::string_view name, const Names& names, std::string_view what) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return int(found - names.begin());
  const std::string nearest = NearestWord(name, {names.begin(), names.end()});
  throw UsageError(fmt::format("there is no {} '{}'{}", what, name.substr(0, 40),
                               nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

std::string TitleOf(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

bool AreEqual(const geometry::Points& first, const geometry::Points& second) {
  return first.rows() == second.rows() && first == second;
}

/// Expressions by the part of the face that their names begin with.
Json ExpressionGroups() {
  constexpr std::array<std::pair<const char*, const char*>, 8> kGroups = {{{"brow", "brows"},
                                                                           {"eye", "eyes"},
                                                                           {"nose", "nose and cheeks"},
                                                                           {"cheek", "nose and cheeks"},
                                                                           {"jaw", "jaw"},
                                                                           {"mouth", "mouth"},
                                                                           {"tongue", "mouth"},
                                                                           {"", "others"}}};
  Json groups = Json::object();
  for (const std::string_view name : rig::ArkitNames())
    for (const auto& [prefix, group] : kGroups)
      if (name.starts_with(prefix)) {
        groups[group].push_back(name);
        break;
      }
  return groups;
}

deform::EditHandles HandlesOf(const std::vector<ShapeHandle>& handles, Eigen::Index num_vertices) {
  deform::EditHandles moved;
  moved.displacements.resize(std::ssize(handles), 3);
  for (const ShapeHandle& handle : handles) {
    if (handle.vertex < 0 || handle.vertex >= num_vertices || std::ranges::count(moved.points, handle.vertex) > 0)
      throw UsageError(fmt::format("the handle {} is no vertex of the face, or comes twice", handle.vertex));
    moved.displacements.row(std::ssize(moved.points)) = handle.move.transpose();
    moved.points.push_back(handle.vertex);
  }
  return moved;
}

/// What the handles' parts of the face leave still; nothing where they are on the skull or the neck.
std::vector<int> OutsideOf(const faces::FaceTemplate& face_template, const deform::EditHandles& handles) {
  try {
    return deform::OutsideOfPart(face_template, handles);
  } catch (const UsageError&) {
    throw;
  } catch (const Error&) {  // They belong to no part.
    return {};
  }
}

}  // namespace

FaceShaper::FaceShaper(const std::filesystem::path& face_model)
    : model_(faces::ReadFaceModelWeights(face_model)),
      opened_(deform::OpenCodeModel(face_model)),
      controls_(model_.face_template),
      expressions_(model_) {}

Json FaceShaper::Description() const {
  Json controls = Json::array();
  for (const faces::FaceControls::Entry& entry : controls_.entries())
    controls.push_back({{"name", entry.control.name},
                        {"title", TitleOf(entry.control.name)},
                        {"group", entry.control.group},
                        {"sides", entry.num_values()},
                        {"least", -faces::kGreatestControlValue},
                        {"greatest", faces::kGreatestControlValue}});
  Json names = Json::array();
  for (const std::string_view name : rig::ArkitNames()) names.push_back(name);
  return {{"controls", std::move(controls)},
          {"expressions", std::move(names)},
          {"expression_groups", ExpressionGroups()},
          {"caricature", {0, kMostCaricature}},
          {"exaggeration", {0, kMostExaggeration}}};
}

Eigen::VectorXd FaceShaper::ValuesOf(const ShapeDocument& shape) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(controls_.num_values());
  for (const auto& [name, value] : shape.controls) values[PlaceOf(name, controls_.value_names(), "control")] = value;
  return values;
}

Eigen::VectorXf FaceShaper::WeightsOf(const ShapeDocument& shape) const {
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(rig::kNumArkitNames);
  for (const auto& [name, weight] : shape.expressions)
    weights[PlaceOf(name, rig::ArkitNames(), "expression")] = float(weight);
  for (const auto& [name, gain] : shape.gains) weights[PlaceOf(name, rig::ArkitNames(), "expression")] *= float(gain);
  return weights;
}

geometry::Points FaceShaper::WithHandles(const geometry::Points& face, const std::vector<ShapeHandle>& handles) {
  const fitting::CodeModel& model = *opened_.model;
  const deform::EditHandles moved = HandlesOf(handles, face.rows());
  if (!handle_start_ || handle_start_->face != face || handle_start_->vertices != moved.points) {
    HandleStart start{.face = face, .code = {}, .vertices = moved.points, .outside = {}};
    start.code = handle_start_ && handle_start_->face == face ? handle_start_->code : fitting::CodeOfMesh(model, face);
    start.outside = OutsideOf(model_.face_template, moved);
    handle_start_ = std::move(start);
  }
  const fitting::HandleOptions options{.outside = handle_start_->outside, .fixed = opened_.expression};
  const fitting::HandleEdit edit =
      fitting::EditByHandles(model, handle_start_->code.code, moved.points, moved.displacements, options);
  return face + model.Vertices(edit.code) - handle_start_->code.vertices;
}

geometry::Points FaceShaper::Exaggerated(const geometry::Points& face, double gamma) {
  if (!exaggeration_start_ || !AreEqual(exaggeration_start_->face, face))
    exaggeration_start_.emplace(face, faces::FaceExaggerator(model_.face_template, face, {}));
  return exaggeration_start_->exaggerator.At(gamma);
}

geometry::Points FaceShaper::BeforeHandles(const ShapeDocument& shape, const geometry::Points& base,
                                           const geometry::Points& toward) {
  geometry::Points face = base;
  if (shape.toward) face += shape.toward->share * (toward - base);
  face = controls_.Apply(face, ValuesOf(shape));
  if (shape.exaggeration > 0) face = Exaggerated(face, shape.exaggeration);
  if (shape.caricature > 0)
    face = fitting::Exaggerate(*opened_.model, face, shape.caricature, opened_.expression).vertices;
  return face;
}

geometry::Points FaceShaper::WithExpressions(const geometry::Points& face, const Eigen::VectorXf& weights) {
  if (!targets_)
    targets_ = {Eigen::MatrixXf::Zero(face.size(), rig::kNumArkitNames), std::vector<bool>(rig::kNumArkitNames)};
  std::vector<int> missing;
  for (int e = 0; e < rig::kNumArkitNames; ++e)
    if (weights[e] != 0 && !targets_->is_made[size_t(e)]) missing.push_back(e);
  if (!missing.empty()) {
    const rig::MorphTargets made = expressions_.OnlyOn(face, missing);
    for (const int e : missing) {
      targets_->offsets.col(e) = made.offsets.col(e);
      targets_->is_made[size_t(e)] = true;
    }
  }
  Eigen::VectorXf offsets = Eigen::VectorXf::Zero(face.size());
  for (int e = 0; e < rig::kNumArkitNames; ++e)
    if (weights[e] != 0) offsets += weights[e] * targets_->offsets.col(e);
  geometry::Points shown = face;
  Eigen::Map<Eigen::VectorXd>(shown.data(), shown.size()) += offsets.cast<double>();
  return shown;
}

geometry::Points FaceShaper::Make(const ShapeDocument& shape, const NamedFace& named) {
  const auto face_of = [&](const std::string& name) {
    geometry::Points face = name == "mean" ? model_.face_template.neutral : named(name);
    DAUMIER_CHECK(face.rows() == model_.face_template.num_vertices(), "'{}' is a face of another topology", name);
    return face;
  };
  const Eigen::VectorXf weights = WeightsOf(shape);
  const std::scoped_lock lock(mutex_);
  Made made{.shape = shape.Neutral(), .base = face_of(shape.base), .toward = {}, .before_handles = {}, .face = {}};
  if (shape.toward) made.toward = face_of(shape.toward->face);
  const bool has_base = last_ && AreEqual(last_->base, made.base) && AreEqual(last_->toward, made.toward);
  if (!has_base || last_->shape != made.shape) {
    const bool has_start = has_base && last_->shape.WithoutHandles() == made.shape.WithoutHandles();
    made.before_handles = has_start ? last_->before_handles : BeforeHandles(made.shape, made.base, made.toward);
    made.face = shape.handles.empty() ? made.before_handles : WithHandles(made.before_handles, shape.handles);
    last_ = std::move(made);
    targets_.reset();
  }
  if ((weights.array() == 0).all()) return last_->face;
  return WithExpressions(last_->face, weights);
}

std::map<std::string, double> FaceShaper::RandomControls(uint64_t seed, double spread) const {
  Rng rng = Stream(seed, "studio controls");
  std::map<std::string, double> values;
  for (const faces::FaceControls::Entry& entry : controls_.entries()) {
    const double limit = faces::kGreatestControlValue;
    const double value = std::clamp(spread * rng.Normal(), -limit, limit);
    if (entry.control.sides == faces::FaceControl::Sides::kSideways) continue;
    for (int i = 0; i < entry.num_values(); ++i) values[controls_.value_names()[size_t(entry.first_value + i)]] = value;
  }
  return values;
}

}  // namespace daumier::studio
