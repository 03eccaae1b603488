#include "eval/mesh_score.h"

#include "core/error.h"
#include "core/options.h"
#include "core/statistics.h"
#include "eval/predicted_meshes.h"
#include "geometry/alignment.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

namespace daumier::eval {
namespace {

namespace fs = std::filesystem;

/// A number of MeshScore: its keys for all faces and for one, and its title.
struct MeshMeasure {
  const char *key, *face_key, *title;
  double MeshScore::*value;
};
constexpr MeshMeasure kMeshMeasures[] = {
    {"face_region", "vertex_error_mm", "face region", &MeshScore::face},
    {"aligned", "aligned_vertex_error_mm", "face region after similarity", &MeshScore::aligned},
    {"vertex_p90", "vertex_p90_mm", "90th percentile of the region's vertices", &MeshScore::p90},
    {"all_vertices", "all_vertices_error_mm", "all vertices", &MeshScore::all}};

std::vector<double> DistancesMm(const geometry::Points& predicted, const geometry::Points& truth, double mm_per_cm) {
  const Eigen::VectorXd distances = mm_per_cm * (predicted - truth).rowwise().norm();
  return {distances.begin(), distances.end()};
}

std::vector<double> NumbersOf(std::span<const MeshScore> scores, const MeshMeasure& measure) {
  std::vector<double> numbers;
  for (const MeshScore& score : scores) numbers.push_back(score.*measure.value);
  return numbers;
}

std::string DashedName(std::string name) {
  std::ranges::replace(name, '/', '-');
  return name;
}

std::string GridName(const faces::FaceDatabase& database, int face) {
  const faces::FaceId id = database.id(face);
  return fmt::format("person-{:05}-level-{}-{}", id.person, id.level + 1,
                     database.expression_names()[size_t(id.expression)]);
}

}  // namespace

MeshScore ScoreMesh(const std::string& name, const geometry::Points& predicted, const geometry::Points& truth,
                    const faces::FaceTemplate& face_template) {
  DAUMIER_CHECK(predicted.rows() == truth.rows() && truth.rows() == face_template.num_vertices(),
                "{}: {} predicted vertices, {} true ones, {} of the template", name, predicted.rows(), truth.rows(),
                face_template.num_vertices());
  const std::vector<int>& region = faces::RegionFor(face_template.annotation, "face", "the error of a mesh");
  const double mm_per_cm = faces::MillimetresPerCm(face_template);
  const geometry::Points predicted_face = predicted(region, Eigen::all), true_face = truth(region, Eigen::all);
  MeshScore score{.name = name};
  score.all = Mean(DistancesMm(predicted, truth, mm_per_cm));
  const std::vector<double> of_face = DistancesMm(predicted_face, true_face, mm_per_cm);
  score.face = Mean(of_face);
  score.p90 = Percentile(of_face, 90);
  const geometry::Similarity similarity = geometry::AlignSimilarity(predicted_face, true_face);
  score.aligned = Mean(DistancesMm(similarity.Apply(predicted_face), true_face, mm_per_cm));
  return score;
}

std::optional<int> FaceNamed(const faces::FaceDatabase& database, const std::string& name) {
  int face = -1, person = -1, level = -1;
  if (std::sscanf(name.c_str(), "face-%9d", &face) == 1 && face >= 0 && face < database.num_faces() &&
      name == fmt::format("face-{:05}", face))
    return face;
  if (std::sscanf(name.c_str(), "person-%9d-level-%9d-", &person, &level) == 2 && person >= 0 && level >= 1 &&
      person < database.num_persons() && level <= database.num_levels()) {
    for (int expression = 0; expression < database.num_expressions(); ++expression) {
      face = database.index({person, level - 1, expression});
      if (name == GridName(database, face)) return face;
    }
  }
  const auto persons = database.manifest().details.value("names", std::vector<std::string>{});
  for (int i = 0; i < std::min(int(persons.size()), database.num_persons()); ++i)
    if (name == DashedName(persons[size_t(i)])) return database.index({i, 0, 0});
  return std::nullopt;
}

std::vector<MeshScore> ScoreMeshes(const fs::path& predictions, const faces::FaceDatabase& truth) {
  const TemplateMeshReader reader(truth.face_template());
  std::vector<MeshScore> scores;
  for (const auto& [name, file] : MeshesIn(predictions)) {
    const std::optional<int> face = FaceNamed(truth, name);
    DAUMIER_CHECK(face.has_value(),
                  "{}: {} has no face '{}'. Rename the mesh: face-00000 to face-{:05} by index, or as {}",
                  file.string(), truth.directory().string(), name, truth.num_faces() - 1, GridName(truth, 0));
    scores.push_back(ScoreMesh(name, reader.Read(file), truth.points(*face), truth.face_template()));
  }
  return scores;
}

std::vector<MeshScore> ScoreMeshes(const fs::path& predictions, const fs::path& truth,
                                   const faces::FaceTemplate& face_template) {
  const TemplateMeshReader reader(face_template);
  const std::map<std::string, fs::path> true_meshes = MeshesIn(truth);
  std::set<std::string> names;
  for (const auto& [name, file] : true_meshes) names.insert(name);
  std::vector<MeshScore> scores;
  for (const auto& [name, file] : MeshesIn(predictions)) {
    const auto found = true_meshes.find(name);
    const std::string nearest = NearestWord(name, names);
    DAUMIER_CHECK(found != true_meshes.end(), "{}: {} has no mesh '{}'{}", file.string(), truth.string(), name,
                  nearest.empty() ? ". Rename one of them" : fmt::format(" (did you mean '{}'?)", nearest));
    scores.push_back(ScoreMesh(name, reader.Read(file), reader.Read(found->second), face_template));
  }
  return scores;
}

reports::ReportTable MeshScoreTable(std::span<const MeshScore> scores) {
  reports::ReportTable table{"Errors, mm", {"distance of vertices, mm", "mean", "median", "p90"}, {}};
  for (const MeshMeasure& measure : kMeshMeasures) {
    const std::vector<double> numbers = NumbersOf(scores, measure);
    table.rows.push_back({measure.title, fmt::format("{:.2f}", Mean(numbers)), fmt::format("{:.2f}", Median(numbers)),
                          fmt::format("{:.2f}", Percentile(numbers, 90))});
  }
  return table;
}

Json MeshScoresToJson(std::span<const MeshScore> scores) {
  const std::vector<double> errors = NumbersOf(scores, kMeshMeasures[0]);
  Json result = {{"unit", "mm"},
                 {"num_faces", scores.size()},
                 {"mean_vertex_error_mm", Mean(errors)},
                 {"median_vertex_error_mm", Median(errors)},
                 {"p90_vertex_error_mm", Percentile(errors, 90)}};
  for (const MeshMeasure& measure : kMeshMeasures) {
    const std::vector<double> numbers = NumbersOf(scores, measure);
    result[measure.key] = {{"mean", Mean(numbers)}, {"median", Median(numbers)}, {"p90", Percentile(numbers, 90)}};
  }
  Json faces = Json::array();
  for (const MeshScore& score : scores) {
    Json entry = {{"name", score.name}};
    for (const MeshMeasure& measure : kMeshMeasures) entry[measure.face_key] = score.*measure.value;
    faces.push_back(std::move(entry));
  }
  result["faces"] = std::move(faces);
  return result;
}

}  // namespace daumier::eval
