#include "datasets/build/face_levels.h"

#include "core/files.h"
#include "faces/controls/given_controls.h"

namespace daumier::datasets {
namespace {

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

LevelMaker::LevelMaker(const faces::FaceTemplate& face_template, const FacesOptions& options,
                       const Population& population, const faces::SourceNumbering& numbering)
    : face_template_(face_template), options_(options) {
  if (options.levels == "parts") parts_ = faces::MakeFaceParts(face_template, options.parts.blend_rings);
  if (options.levels != "controls") return;
  std::vector<geometry::Points> faces;
  for (int i = 0; i < population.num_faces; ++i) faces.push_back(population.face(i));
  generator_.emplace(face_template, faces, options.caricature, options.exaggeration,
                     faces::ReadGivenControls(options.own_controls, face_template, numbering));
}

Json LevelMaker::Details() const {
  Json details = Json::object();
  if (options_.levels == "parts") details["parts"] = faces::FacePartNames();
  if (generator_.has_value()) {
    details["controls"] = generator_->controls().value_names();
    const Eigen::VectorXd& deviations = generator_->fit().deviations();
    for (const faces::GivenControl& given : generator_->controls().given()) {
      if (given.group != "own") continue;
      const auto* bytes = reinterpret_cast<const char*>(given.displacement.data());
      details["own_controls"][given.name] = Sha256({bytes, given.displacement.size() * sizeof(double)});
    }
    details["control_deviations"] = std::vector<double>(deviations.begin(), deviations.end());
  }
  return details;
}

std::vector<geometry::Points> LevelMaker::Make(const geometry::Points& neutral, int person,
                                               PersonArrays& arrays) const {
  if (options_.levels == "parts") return MakeByParts(neutral, person, arrays);
  if (options_.levels == "controls") return MakeByControls(neutral, person, arrays);
  if (options_.exaggeration.gammas == std::vector<double>{0.0}) return {neutral};
  return faces::Exaggerate(face_template_, neutral, options_.exaggeration);
}

std::vector<geometry::Points> LevelMaker::MakeByParts(const geometry::Points& neutral, int person,
                                                      PersonArrays& arrays) const {
  Rng rng = Stream(options_.seed, "parts", person);
  std::vector<geometry::Points> levels;
  for (const double gamma : options_.exaggeration.gammas) {
    const faces::PartStrengths strengths = faces::DrawPartStrengths(face_template_, parts_, gamma, options_.parts, rng);
    Append(strengths, arrays);
    levels.push_back(faces::ExaggerateParts(face_template_, parts_, neutral, strengths, options_.exaggeration));
  }
  return levels;
}

std::vector<geometry::Points> LevelMaker::MakeByControls(const geometry::Points& neutral, int person,
                                                         PersonArrays& arrays) const {
  Rng rng = Stream(options_.seed, "caricature", person);
  std::vector<geometry::Points> levels;
  for (const double amount : options_.caricature.amounts) {
    auto caricature = generator_->Make(neutral, amount, generator_->DrawValues(neutral, amount, rng));
    for (const double value : caricature.values) arrays.control_values.push_back(static_cast<float>(value));
    levels.push_back(std::move(caricature.face));
  }
  return levels;
}

}  // namespace daumier::datasets
