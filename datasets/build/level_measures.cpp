#include "datasets/build/level_measures.h"

#include "core/error.h"
#include "datasets/build/stats.h"
#include "faces/openings.h"
#include "geometry/alignment.h"
#include "geometry/flips.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

constexpr int kMaxCandidates = 150, kMaxMeasuredFaces = 1500;

double MeanVertexDistance(const geometry::Points& a, const geometry::Points& b) {
  return (a - b).rowwise().norm().mean();
}

geometry::Points AlignedOnto(const geometry::Points& target, const geometry::Points& points) {
  return geometry::AlignSimilarity(points, target).Apply(points);
}

/// The regular neutral faces of the first persons, by which faces are recognised.
class Candidates {
 public:
  explicit Candidates(std::vector<geometry::Points> faces) : aligned_(std::move(faces)), target_(MeanOf(aligned_)) {
    for (geometry::Points& face : aligned_) face = AlignedOnto(target_, face);
    mean_ = MeanOf(aligned_);
    for (const geometry::Points& face : aligned_)
      directions_.push_back((face - mean_) / std::max((face - mean_).norm(), 1e-12));
  }

  struct Nearest {
    size_t by_angle, by_distance;
  };
  Nearest Recognise(const geometry::Points& face) const {
    const geometry::Points aligned = AlignedOnto(target_, face), deviation = aligned - mean_;
    std::vector<double> cosines, distances;
    for (size_t i = 0; i < aligned_.size(); ++i) {
      cosines.push_back(deviation.cwiseProduct(directions_[i]).sum());
      distances.push_back(MeanVertexDistance(aligned, aligned_[i]));
    }
    return {size_t(std::max_element(cosines.begin(), cosines.end()) - cosines.begin()),
            size_t(std::min_element(distances.begin(), distances.end()) - distances.begin())};
  }

 private:
  static geometry::Points MeanOf(const std::vector<geometry::Points>& faces) {
    geometry::Points mean = geometry::Points::Zero(faces.front().rows(), 3);
    for (const geometry::Points& face : faces) mean += face / double(faces.size());
    return mean;
  }

  std::vector<geometry::Points> aligned_, directions_;  ///< Directions: unit deviations from the mean.
  geometry::Points target_, mean_;
};

void MeasureNeutrals(const faces::FaceDatabase& database, const std::vector<int>& region,
                     std::vector<LevelMeasures>& rows) {
  const auto neutral = [&](int person, int level) -> geometry::Points {
    return database.points(database.index({person, level, 0}))(region, Eigen::all);
  };
  const int num_persons = std::min(kMaxCandidates, database.num_persons());
  std::vector<geometry::Points> regular;
  for (int person = 0; person < num_persons; ++person) regular.push_back(neutral(person, 0));
  const Candidates candidates(regular);
  const double mm_per_cm = faces::MillimetresPerCm(database.face_template());
  for (LevelMeasures& row : rows) {
    row.num_persons = num_persons;
    int num_by_angle = 0, num_by_distance = 0;
    for (int person = 0; person < num_persons; ++person) {
      const geometry::Points face = neutral(person, row.level);
      row.displacement_mm +=
          mm_per_cm / num_persons * MeanVertexDistance(AlignedOnto(regular[person], face), regular[person]);
      const auto [by_angle, by_distance] = candidates.Recognise(face);
      num_by_angle += by_angle == size_t(person);
      num_by_distance += by_distance == size_t(person);
    }
    row.own_by_angle = double(num_by_angle) / num_persons;
    row.own_by_distance = double(num_by_distance) / num_persons;
  }
}

void MeasureSurfaces(const faces::FaceDatabase& database, const std::vector<int>& region,
                     std::vector<LevelMeasures>& rows) {
  const faces::FaceTemplate& face_template = database.face_template();
  const faces::FaceOpenings openings = faces::FindOpenings(face_template);
  const double mm_per_cm = faces::MillimetresPerCm(face_template);
  const auto lids_depth = [&](const geometry::Points& points) {
    return std::max(faces::CrossingDepth(openings.lids[0], points), faces::CrossingDepth(openings.lids[1], points));
  };
  const auto beyond_rest = [&](double depth, double rest, int& num_crossed, double& most_mm) {
    const double mm = mm_per_cm * (depth - rest);
    if (mm > kCrossingMm) ++num_crossed;
    most_mm = std::max(most_mm, mm);
  };
  for (const int face : SampleFaces(database, kMaxMeasuredFaces)) {
    if (face >= database.num_grid_faces()) continue;
    const faces::FaceId id = database.id(face);
    if (id.level == 0) continue;
    LevelMeasures& row = rows[id.level - 1];
    const geometry::Points points = database.points(face),
                           rest = database.points(database.index({id.person, 0, id.expression}));
    ++row.num_faces;
    const int flipped = geometry::CountFlippedTriangles(rest, points, face_template.triangles, region);
    if (flipped > 0) ++row.num_faces_flipped;
    row.most_flipped = std::max(row.most_flipped, flipped);
    beyond_rest(faces::CrossingDepth(openings.lips, points), faces::CrossingDepth(openings.lips, rest),
                row.num_lips_crossed, row.lips_crossed_mm);
    beyond_rest(lids_depth(points), lids_depth(rest), row.num_lids_crossed, row.lids_crossed_mm);
  }
}

}  // namespace

std::vector<LevelMeasures> MeasureLevels(const faces::FaceDatabase& database) {
  DAUMIER_CHECK(database.num_levels() > 1 && database.num_persons() > 1,
                "{}: {} persons in {} levels, expected two or more of each to compare levels",
                database.directory().string(), database.num_persons(), database.num_levels());
  const std::vector<int>& region =
      faces::RegionFor(database.face_template().annotation, "face", "a comparison of levels");
  const std::vector<double> gammas = database.gammas();
  std::vector<LevelMeasures> rows(database.num_levels() - 1);
  for (int level = 1; level < database.num_levels(); ++level) {
    rows[level - 1].level = level;
    rows[level - 1].gamma = gammas.at(level);
  }
  MeasureNeutrals(database, region, rows);
  MeasureSurfaces(database, region, rows);
  return rows;
}

}  // namespace daumier::datasets
