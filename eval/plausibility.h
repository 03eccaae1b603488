#pragma once
#include "eval/face_rows.h"
#include "faces/face_database.h"
#include "reports/report_table.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Whether predicted faces are like faces: how far each is from the nearest of a population, against how far the faces of
/// the population are from each other.
namespace daumier::eval {

/// A face of a population, and its distance in mm.
struct NearestFace {
  int face = 0;
  double distance_mm = 0;
};

/// Faces to which others are near or far. The distance of face a from face b is that of ScoreMesh(a, b).aligned: the mean
/// distance of vertices of the region `face`, mm, after the similarity that brings a nearest to b.
/// Of all pairs, root mean square distances preselect: each face is aligned to the mean face once, and one matrix product
/// gives all of them. Distances proper are measured to the kCandidates nearest alone.
class FacePopulation {
 public:
  static constexpr int kCandidates = 24;

  /// faces: V x 3 each, cm. groups: a number of each, equal for faces of the same person.
  /// @throws Error if there is no face, the numbers differ, or as RegionFor.
  FacePopulation(const std::vector<geometry::Points>& faces, std::vector<int> groups,
                 const faces::FaceTemplate& face_template);

  int size() const { return int(groups_.size()); }
  /// The nearest face. May be called from several threads. @throws Error if the number of vertices differs.
  NearestFace Nearest(const geometry::Points& face) const;
  /// Of each face the nearest one of another person. @throws Error if all faces are of one person.
  std::vector<NearestFace> AmongThemselves() const;

 private:
  /// The nearest of those candidates that are not of `group`.
  NearestFace Nearest(const geometry::Points& region, std::span<const float> squares, std::optional<int> group) const;
  FaceRows Aligned(const geometry::Points& region) const;

  std::vector<int> region_;
  int num_vertices_;
  double mm_per_cm_;
  std::vector<int> groups_;
  std::vector<geometry::Points> regions_;  ///< As given, the region's vertices alone.
  geometry::Points mean_;                  ///< Of these.
  FaceRows rows_;                          ///< n x 3R: aligned to the mean, minus the mean.
  Eigen::RowVectorXf squared_norms_;
};

struct PlausibilityScore {
  std::string name;
  NearestFace nearest;  ///< A face of the database.
  std::string nearest_name;
  bool is_within = false;
};

/// Predictions against a population.
struct PlausibilityScores {
  std::vector<PlausibilityScore> of_predictions;
  int num_faces = 0;  ///< Of the population.
  double limit_mm =
      0;  ///< The 99th percentile of distances of the population's faces to the nearest of another person.
  double median_mm = 0;  ///< Of the same.

  int num_within() const;
};

/// Of the meshes in a folder, against at most `most_faces` evenly spaced faces of a database. @throws Error naming file,
/// cause and repair as TemplateMeshReader and FacePopulation.
PlausibilityScores ScorePlausibility(const std::filesystem::path& predictions, const faces::FaceDatabase& database,
                                     int most_faces = 2000);

/// Prediction, distance, nearest face, and whether it is within.
reports::ReportTable PlausibilityTable(const PlausibilityScores& scores);
/// {unit, num_population, limit_mm, median_mm, num_predictions, num_within, predictions: [{name, distance_mm, nearest,
/// within}]}
Json PlausibilityToJson(const PlausibilityScores& scores);

}  // namespace daumier::eval
