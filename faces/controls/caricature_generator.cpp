#include "faces/controls/caricature_generator.h"

#include "core/error.h"
#include "faces/controls/artist_habits.h"
#include "faces/controls/smooth_warps.h"
#include "faces/landmark_order.h"
#include "geometry/alignment.h"
#include "geometry/flips.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace daumier::faces {
namespace {

double CutNormal(Rng& rng) {
  return std::clamp(rng.Normal(), -2.0, 2.0);
}

/// Student's t with four degrees of freedom, scaled to a variance of 1 before the cut.
double HeavyTailed(Rng& rng) {
  constexpr int kDegrees = 4;
  double squares = 0;
  for (int i = 0; i < kDegrees; ++i) squares += std::pow(rng.Normal(), 2);
  const double t = rng.Normal() / std::sqrt(squares / kDegrees);
  return std::clamp(t * std::sqrt((kDegrees - 2.0) / kDegrees), -3.0, 3.0);
}

std::vector<GivenControl> WithWarps(const FaceTemplate& face_template, std::vector<GivenControl> given) {
  std::vector<GivenControl> all = SmoothWarps(face_template);
  std::move(given.begin(), given.end(), std::back_inserter(all));
  return all;
}

/// Where curvature is not exaggerated: lips that touch would pass through each other.
SoftRegion AroundMouth() {
  return {{{{48}}, {{51}}, {{54}}, {{57}}, {{48}}}, geometry::Vector3(0.2, 0.2, 0.6)};
}

/// Of each vertex by how much it belongs to landmarks that an alignment uses.
Eigen::VectorXd AlignmentWeights(const FaceTemplate& face_template) {
  constexpr double kContourWeight = 0.1;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(face_template.num_vertices());
  for (int i = 0; i < kNumLandmarks; ++i)
    weights[face_template.annotation.landmarks[i]] = i < kNumContourLandmarks ? kContourWeight : 1.0;
  return weights;
}

}  // namespace

CaricatureGenerator::CaricatureGenerator(const FaceTemplate& face_template,
                                         const std::vector<geometry::Points>& population, CaricatureOptions options,
                                         ExaggerationOptions exaggeration, std::vector<GivenControl> given)
    : face_template_(face_template),
      options_(std::move(options)),
      exaggeration_(std::move(exaggeration)),
      controls_(face_template, WithWarps(face_template, std::move(given))),
      fit_(controls_, face_template, population),
      openings_(FindOpenings(face_template)),
      mouth_(WeightsOf(AroundMouth(), face_template)) {
  if (options_.amounts.empty() || options_.amounts.front() != 0)
    throw UsageError("the first of caricature.amounts has to be 0");
}

Eigen::VectorXd CaricatureGenerator::DrawValues(const geometry::Points& neutral, double amount, Rng& rng) const {
  const Eigen::VectorXd own = fit_.ValuesOf(neutral);
  const double whole = amount * std::exp(0.25 * CutNormal(rng));
  const bool inconsistent = rng.Uniform(0.0, 1.0) < options_.inconsistent;
  std::vector<double> strength, shared;
  for (size_t g = 0; g < controls_.group_names().size(); ++g) {
    const double consistent = std::exp(options_.group_spread * CutNormal(rng)), free = rng.Uniform(-0.5, 2.5);
    strength.push_back(inconsistent ? free : consistent);
    shared.push_back(HeavyTailed(rng));
  }
  const auto value = [&](int k, const ArtistHabit& habit, double invented) {
    const double unusual = std::max(0.5, std::abs(own[k]) / std::max(fit_.deviations()[k], 1e-9));
    const double exaggerated =
        strength[controls_.value_groups()[k]] * options_.own * own[k] * std::pow(unusual, options_.emphasis);
    const double drawn = habit.boldness * (exaggerated + options_.invention * invented);
    return kGreatestControlValue *
           std::tanh(whole * (drawn + options_.tendencies * habit.tendency) / kGreatestControlValue);
  };
  const Eigen::Array3d types(HeavyTailed(rng), HeavyTailed(rng), HeavyTailed(rng));
  const auto invent = [&](int k, const ArtistHabit& habit) {
    const double of_types = (types * Eigen::Map<const Eigen::Array3d>(habit.types.data())).sum();
    return of_types + 0.5 * shared[controls_.value_groups()[k]] + 0.7 * HeavyTailed(rng);
  };
  Eigen::VectorXd values(controls_.num_values());
  for (const FaceControls::Entry& entry : controls_.entries()) {
    const int k = entry.first_value;
    const ArtistHabit habit = HabitOf(entry.control.name);
    const double invented = invent(k, habit);
    if (entry.control.sides == FaceControl::Sides::kSideways) {
      values[k] = value(k, habit, 2 * options_.asymmetry * invented);
    } else if (entry.num_values() == 1) {
      values[k] = value(k, habit, invented);
    } else {
      const double difference = options_.asymmetry * HeavyTailed(rng);
      values[k] = value(k, habit, invented + difference);
      values[k + 1] = value(k + 1, habit, invented - difference);
    }
  }
  for (int k = controls_.first_given_value(); k < controls_.num_values(); ++k) {
    const GivenControl& given = controls_.given()[k - controls_.first_given_value()];
    const ArtistHabit habit = HabitOf(given.name);
    const double sideways = given.sides == FaceControl::Sides::kSideways ? 2 * options_.asymmetry : 1.0;
    values[k] =
        value(k, habit, sideways * (given.group == "warp" ? options_.looseness * HeavyTailed(rng) : invent(k, habit)));
  }
  return values;
}

geometry::Points CaricatureGenerator::Sharpened(const geometry::Points& neutral, double amount) const {
  if (amount * options_.crispness <= 0) return neutral;
  ExaggerationOptions curvature = exaggeration_;
  curvature.gammas = {amount * options_.crispness};
  geometry::Points moved = Exaggerate(face_template_, neutral, curvature).front() - neutral;
  moved.array().colwise() *= 1 - mouth_.array();
  return neutral + moved;
}

std::vector<int> CaricatureGenerator::ValuesToReduce(const geometry::Points& neutral, const geometry::Points& made,
                                                     int round) const {
  constexpr int kLocalRounds = 15;
  constexpr double kLeastMotion = 0.03, kLeastGap = 0.003;  // cm at value 1: less has no part in it.
  constexpr double kCrossing = 0.01;                        // cm
  std::vector<int> values;
  const auto& region = RegionFor(face_template_.annotation, "face", "a caricature");
  const std::vector<int> flipped = geometry::FlippedTriangles(neutral, made, face_template_.triangles, region);
  const bool lips_cross =
      CrossingDepth(openings_.lips, made) > std::max(0.0, CrossingDepth(openings_.lips, neutral)) + kCrossing;
  for (int k = 0; k < controls_.num_values(); ++k) {
    const auto motion = [&](int v) { return controls_.Jacobian().col(k).segment<3>(3 * v); };
    const bool flips = std::ranges::any_of(flipped, [&](int triangle) {
      return round >= kLocalRounds || motion(face_template_.triangles(triangle, 0)).norm() > kLeastMotion;
    });
    const bool crosses = lips_cross && std::ranges::any_of(openings_.lips.pairs, [&](const auto& pair) {
                           return std::abs(motion(pair.first).y() - motion(pair.second).y()) > kLeastGap;
                         });
    if (flips || crosses) values.push_back(k);
  }
  return values;
}

CaricatureGenerator::Caricature CaricatureGenerator::Make(const geometry::Points& neutral, double amount,
                                                          Eigen::VectorXd values) const {
  constexpr int kMaxRounds = 40;
  constexpr double kReduction = 0.8;
  const geometry::Points sharp = Sharpened(neutral, amount);
  const Eigen::VectorXd weights = AlignmentWeights(face_template_);
  geometry::Points made;
  for (int round = 0; round <= kMaxRounds; ++round) {
    made = controls_.Apply(sharp, values);
    made = geometry::AlignSimilarity(made, neutral, weights).Apply(made);
    const std::vector<int> reduced = ValuesToReduce(neutral, made, round);
    if (reduced.empty()) break;
    for (const int k : reduced) values[k] *= kReduction;
  }
  return {std::move(made), std::move(values)};
}

}  // namespace daumier::faces
