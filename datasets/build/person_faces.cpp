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

void Append(const faces::PartStrengths& strengths, PersonArrays& arrays) {
  for (Eigen::Index p = 0; p < strengths.gammas.size(); ++p) {
    arrays.part_strengths.push_back(static_cast<float>(strengths.gammas[p]));
    for (int k = 0; k < 3; ++k) arrays.part_strengths.push_back(static_cast<float>(strengths.log_stretches(p, k)));
  }
  for (const faces::GaussianBump& bump : strengths.bumps) {
    arrays.bumps.insert(arrays.bumps.end(), {static_cast<float>(bump.vertex), static_cast<float>(bump.radius)});
    for (const double offset : bump.offset) arrays.bumps.push_back(static_cast<float>(offset));
  }
}

}  // namespace

PersonFacesMaker::PersonFacesMaker(const faces::FaceModel& model, const std::vector<faces::Expression>& expressions,
                                   const FacesOptions& options)
    : model_(model), options_(options), transfer_(model, expressions) {
  if (options.levels == "parts") parts_ = faces::MakeFaceParts(model.face_template, options.parts.blend_rings);
}

std::vector<geometry::Points> MakeLevels(const faces::FaceTemplate& face_template, const faces::FaceParts& parts,
                                         const geometry::Points& neutral, const FacesOptions& options, int person,
                                         PersonArrays& arrays) {
  if (options.levels == "whole" && options.exaggeration.gammas == std::vector<double>{0.0}) return {neutral};
  if (options.levels == "whole") return faces::Exaggerate(face_template, neutral, options.exaggeration);
  Rng rng = Stream(options.seed, "parts", person);
  std::vector<geometry::Points> levels;
  for (const double gamma : options.exaggeration.gammas) {
    const faces::PartStrengths strengths = faces::DrawPartStrengths(face_template, parts, gamma, options.parts, rng);
    Append(strengths, arrays);
    levels.push_back(faces::ExaggerateParts(face_template, parts, neutral, strengths, options.exaggeration));
  }
  return levels;
}

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
  for (const geometry::Points& level : MakeLevels(model_.face_template, parts_, neutral, options_, person, arrays)) {
    const Eigen::VectorXf base = Eigen::Map<const Eigen::VectorXd>(level.data(), level.size()).cast<float>();
    const Eigen::MatrixXf offsets = transfer_.Offsets(level);
    for (Eigen::Index e = 0; e < offsets.cols(); ++e) {
      const Eigen::VectorXf face = base + strengths[e] * offsets.col(e);
      arrays.vertices.insert(arrays.vertices.end(), face.begin(), face.end());
    }
  }
  return arrays;
}

}  // namespace daumier::datasets
