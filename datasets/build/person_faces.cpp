#include "datasets/build/person_faces.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// A strength of each expression about 1, cut at two deviations; 1 of neutral.
Eigen::VectorXf DrawExpressionStrengths(int num_expressions, double deviation, Rng& rng) {
  Eigen::VectorXf strengths = Eigen::VectorXf::Ones(num_expressions);
  for (int e = 1; e < num_expressions; ++e)
    strengths[e] = static_cast<float>(1 + deviation * std::clamp(rng.Normal(), -2.0, 2.0));
  return strengths;
}

/// The persons of whom a model's mean and deviations are measured.
Population PopulationOf(const faces::FaceModel& model, const FacesOptions& options) {
  constexpr int kNumFaces = 200;
  return {kNumFaces, [&](int i) {
            Rng rng = Stream(options.seed, "population", i);
            return faces::IdentityFace(model, faces::DrawIdentity(model, rng, options.identity_spread));
          }};
}

}  // namespace

PersonFacesMaker::PersonFacesMaker(const faces::FaceModel& model, const std::vector<faces::Expression>& expressions,
                                   const FacesOptions& options)
    : model_(model),
      options_(options),
      transfer_(model, expressions),
      levels_(model.face_template, options, PopulationOf(model, options), model.numbering),
      repair_(options.levels == "controls" ? std::optional<faces::ExpressionRepair>(model.face_template)
                                           : std::nullopt) {}

PersonArrays PersonFacesMaker::Make(int person) const {
  Rng identity_rng = Stream(options_.seed, "identity", person);
  const Eigen::VectorXf identity = faces::DrawIdentity(model_, identity_rng, options_.identity_spread);
  Rng strengths_rng = Stream(options_.seed, "expression strengths", person);
  const Eigen::VectorXf strengths =
      DrawExpressionStrengths(transfer_.num_expressions(), options_.expression_variation, strengths_rng);

  PersonArrays arrays;
  arrays.identity_weights.assign(identity.begin(), identity.end());
  arrays.expression_strengths.assign(strengths.begin(), strengths.end());
  const geometry::Points neutral = faces::IdentityFace(model_, identity);
  std::vector<geometry::Points> regular;  // Of the first level, one an expression.
  for (const geometry::Points& level : levels_.Make(neutral, person, arrays)) {
    const Eigen::VectorXf base = Eigen::Map<const Eigen::VectorXd>(level.data(), level.size()).cast<float>();
    const bool is_regular = regular.size() < size_t(transfer_.num_expressions());
    const Eigen::MatrixXf offsets = transfer_.Offsets(level);
    for (Eigen::Index e = 0; e < offsets.cols(); ++e) {
      Eigen::VectorXf face = base + strengths[e] * offsets.col(e);
      if (repair_.has_value()) {
        const Eigen::VectorXd coordinates = face.cast<double>();
        const Eigen::Map<const geometry::Points> points(coordinates.data(), level.rows(), 3);
        if (is_regular) {
          regular.emplace_back(points);
        } else {
          const geometry::Points repaired = repair_->Repair(points, regular[e]);
          face = Eigen::Map<const Eigen::VectorXd>(repaired.data(), repaired.size()).cast<float>();
        }
      }
      arrays.vertices.insert(arrays.vertices.end(), face.begin(), face.end());
    }
  }
  return arrays;
}

}  // namespace daumier::datasets
