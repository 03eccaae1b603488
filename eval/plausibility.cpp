#include "eval/plausibility.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/statistics.h"
#include "eval/predicted_meshes.h"
#include "geometry/alignment.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace daumier::eval {
namespace {

constexpr double kLimitPercent = 99;

double MeanDistanceAligned(const geometry::Points& from, const geometry::Points& to) {
  return (geometry::AlignSimilarity(from, to).Apply(from) - to).rowwise().norm().mean();
}

std::vector<double> DistancesOf(const std::vector<NearestFace>& nearest) {
  std::vector<double> distances;
  for (const NearestFace& face : nearest) distances.push_back(face.distance_mm);
  return distances;
}

}  // namespace

FacePopulation::FacePopulation(const std::vector<geometry::Points>& faces, std::vector<int> groups,
                               const faces::FaceTemplate& face_template)
    : region_(faces::RegionFor(face_template.annotation, "face", "the distance of faces")),
      num_vertices_(face_template.num_vertices()),
      mm_per_cm_(faces::MillimetresPerCm(face_template)),
      groups_(std::move(groups)) {
  DAUMIER_CHECK(!faces.empty(), "a population needs a face");
  DAUMIER_CHECK(faces.size() == groups_.size(), "{} faces of {} persons", faces.size(), groups_.size());
  mean_ = geometry::Points::Zero(Eigen::Index(region_.size()), 3);
  for (const geometry::Points& face : faces) {
    DAUMIER_CHECK(face.rows() == num_vertices_, "a face of {} vertices in a population of {}", face.rows(),
                  num_vertices_);
    regions_.emplace_back(face(region_, Eigen::all));
    mean_ += regions_.back() / double(faces.size());
  }
  rows_ = RowsOnAllCores(faces.size(), 3 * mean_.rows(), [&](int i) {
    const FaceRows row = Aligned(regions_[size_t(i)]);
    return std::vector<float>(row.data(), row.data() + row.size());
  });
  squared_norms_ = rows_.rowwise().squaredNorm().transpose();
}

FaceRows FacePopulation::Aligned(const geometry::Points& region) const {
  const geometry::Points moved = geometry::AlignSimilarity(region, mean_).Apply(region) - mean_;
  FaceRows row(1, moved.size());
  for (Eigen::Index i = 0; i < moved.rows(); ++i) row.block<1, 3>(0, 3 * i) = moved.row(i).cast<float>();
  return row;
}

NearestFace FacePopulation::Nearest(const geometry::Points& region, std::span<const float> squares,
                                    std::optional<int> group) const {
  std::vector<int> candidates;
  for (int i = 0; i < size(); ++i)
    if (groups_[size_t(i)] != group) candidates.push_back(i);
  DAUMIER_CHECK(!candidates.empty(), "the faces of a population are all of one person (expected two persons or more)");
  const auto count = std::min(candidates.size(), size_t(kCandidates));
  std::ranges::partial_sort(candidates, candidates.begin() + ptrdiff_t(count), {},
                            [&](int i) { return std::pair(squares[size_t(i)], i); });
  candidates.resize(count);
  NearestFace best{.face = candidates.front(), .distance_mm = std::numeric_limits<double>::infinity()};
  for (const int i : candidates) {
    const double distance = mm_per_cm_ * MeanDistanceAligned(region, regions_[size_t(i)]);
    if (distance < best.distance_mm) best = {i, distance};
  }
  return best;
}

NearestFace FacePopulation::Nearest(const geometry::Points& face) const {
  DAUMIER_CHECK(face.rows() == num_vertices_, "a face of {} vertices for a population of {}", face.rows(),
                num_vertices_);
  const geometry::Points region = face(region_, Eigen::all);
  const FaceRows products = Product(Aligned(region), rows_.transpose());
  const Eigen::RowVectorXf squares = squared_norms_ - 2 * products.row(0);  // Without the norm of the face itself.
  return Nearest(region, {squares.data(), size_t(squares.size())}, std::nullopt);
}

std::vector<NearestFace> FacePopulation::AmongThemselves() const {
  FaceRows squares = Product(rows_, rows_.transpose());
  squares *= -2;
  squares.rowwise() += squared_norms_;
  std::vector<NearestFace> nearest;
  ForEachInOrder(
      size(), [&](int i) { return Nearest(regions_[size_t(i)], RowSpan(squares, size_t(i)), groups_[size_t(i)]); },
      [&](const NearestFace& found) { nearest.push_back(found); });
  return nearest;
}

int PlausibilityScores::num_within() const {
  return int(std::ranges::count(of_predictions, true, &PlausibilityScore::is_within));
}

PlausibilityScores ScorePlausibility(const std::filesystem::path& predictions, const faces::FaceDatabase& database,
                                     int most_faces) {
  const std::map<std::string, std::filesystem::path> meshes = MeshesIn(predictions);
  std::vector<int> chosen(size_t(database.num_faces()));
  std::iota(chosen.begin(), chosen.end(), 0);
  chosen = EvenlySpaced(chosen, most_faces);
  std::vector<geometry::Points> faces;
  std::vector<int> groups;
  for (const int face : chosen) {
    faces.push_back(database.points(face));
    groups.push_back(database.group(face));
  }
  const FacePopulation population(faces, groups, database.face_template());
  const std::vector<double> among = DistancesOf(population.AmongThemselves());
  PlausibilityScores scores{
      .num_faces = population.size(), .limit_mm = Percentile(among, kLimitPercent), .median_mm = Median(among)};
  const TemplateMeshReader reader(database.face_template());
  for (const auto& [name, file] : meshes) {
    NearestFace nearest = population.Nearest(reader.Read(file));
    nearest.face = chosen[size_t(nearest.face)];
    scores.of_predictions.push_back(
        {name, nearest, database.Describe(nearest.face), nearest.distance_mm <= scores.limit_mm});
  }
  return scores;
}

reports::ReportTable PlausibilityTable(const PlausibilityScores& scores) {
  reports::ReportTable table{"Distance to the nearest face", {"prediction", "mm", "nearest face", "within"}, {}};
  for (const PlausibilityScore& score : scores.of_predictions)
    table.rows.push_back({score.name, fmt::format("{:.2f}", score.nearest.distance_mm), score.nearest_name,
                          score.is_within ? "yes" : "no"});
  return table;
}

Json PlausibilityToJson(const PlausibilityScores& scores) {
  Json predictions = Json::array();
  for (const PlausibilityScore& score : scores.of_predictions)
    predictions.push_back({{"name", score.name},
                           {"distance_mm", score.nearest.distance_mm},
                           {"nearest", score.nearest_name},
                           {"within", score.is_within}});
  return {{"unit", "mm"},
          {"num_population", scores.num_faces},
          {"limit_mm", scores.limit_mm},
          {"median_mm", scores.median_mm},
          {"num_predictions", scores.of_predictions.size()},
          {"num_within", scores.num_within()},
          {"predictions", std::move(predictions)}};
}

}  // namespace daumier::eval
