#pragma once
#include "faces/controls/caricature_generator.h"
#include "faces/source.h"
#include "rig/arkit_names.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Persons and caricatures of a source whose heads head_contact measures and expression_sheets draws.
namespace daumier {

/// Of caricatures of level 4, the highest of configs/faces/caricature.toml.
inline constexpr double kLevel4Amount = 3;

/// Expressions that are shown at once, by name and weight.
using ExpressionWeights = std::vector<std::pair<std::string, double>>;

inline ExpressionWeights Both(const std::string& name, double weight = 1) {
  return {{name + "Left", weight}, {name + "Right", weight}};
}
inline ExpressionWeights operator+(ExpressionWeights a, const ExpressionWeights& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The face (V x 3, cm) with these expressions.
inline geometry::Points PoseOf(const geometry::Points& neutral, const rig::MorphTargets& targets,
                               const ExpressionWeights& weights) {
  geometry::Points pose = neutral;
  for (const auto& [name, weight] : weights) {
    const Eigen::VectorXd offset = weight * targets.offsets.col(rig::FindArkitName(name).value()).cast<double>();
    Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += offset;
  }
  return pose;
}

class ExpressionSubject {
 public:
  explicit ExpressionSubject(const faces::SourceOptions& source)
      : model_(faces::LoadFaceModel(source)), expressions_(model_), head_rig_(model_.face_template) {
    constexpr int kPopulation = 60;
    std::vector<geometry::Points> population;
    for (int i = 0; i < kPopulation; ++i) population.push_back(Drawn("population", i));
    generator_.emplace(model_.face_template, population, faces::CaricatureOptions{}, faces::ExaggerationOptions{});
  }

  const faces::FaceModel& model() const { return model_; }
  const rig::ExpressionTargets& expressions() const { return expressions_; }
  const rig::HeadRig& head_rig() const { return head_rig_; }

  geometry::Points Person(int i) const { return Drawn("identity", i); }
  geometry::Points Caricature(int i) const {
    const geometry::Points person = Person(i);
    Rng rng = Stream(1, "caricature", uint64_t(i));
    return generator_->Make(person, kLevel4Amount, generator_->DrawValues(person, kLevel4Amount, rng)).face;
  }

 private:
  geometry::Points Drawn(const char* stream, int i) const {
    Rng rng = Stream(1, stream, uint64_t(i));
    return faces::IdentityFace(model_, faces::DrawIdentity(model_, rng));
  }

  faces::FaceModel model_;
  rig::ExpressionTargets expressions_;
  rig::HeadRig head_rig_;
  std::optional<faces::CaricatureGenerator> generator_;
};

}  // namespace daumier
