#include "benchmark/score.h"

#include "benchmark/predictions.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/statistics.h"
#include "eval/mesh_score.h"
#include "eval/surface_score.h"

#include <algorithm>
#include <map>
#include <set>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kBootstrapSeed = 1;

/// A number of ItemScore: key, title, digits.
struct KitMeasure {
  const char *key, *title;
  std::optional<double> ItemScore::*value;
  int digits;
  double factor = 1;
};
constexpr KitMeasure kKitMeasures[] = {{"vertex_error_mm", "vertices, mm", &ItemScore::vertex_mm, 2},
                                       {"surface_error_mm", "surface, mm", &ItemScore::surface_mm, 2},
                                       {"nme_percent", "NME, %", &ItemScore::nme, 2, 100}};

struct KitSummary {
  double mean, low, high, median, p90;
  int num_items;
};

/// Of the items of a group, or of all; absent if one has no such number.
std::optional<KitSummary> SummaryOf(const KitScores& scores, const KitMeasure& measure, const std::string& group = "") {
  std::vector<double> errors;
  std::vector<int> persons;
  for (const ItemScore& score : scores.items) {
    if (!group.empty() && score.item.group != group) continue;
    if (!(score.*measure.value)) return std::nullopt;
    errors.push_back(measure.factor * *(score.*measure.value));
    persons.push_back(score.item.person);
  }
  if (errors.empty()) return std::nullopt;
  const Interval interval = PersonBootstrap(errors, persons, kBootstrapSeed);
  return KitSummary{Mean(errors),   interval.low,           interval.high,
                    Median(errors), Percentile(errors, 90), int(errors.size())};
}

std::set<std::string> GroupsOf(const KitScores& scores) {
  std::set<std::string> groups;
  for (const ItemScore& score : scores.items) groups.insert(score.item.group);
  return groups;
}

Json SummaryToJson(const KitSummary& summary) {
  return {{"mean", summary.mean},     {"low", summary.low}, {"high", summary.high},
          {"median", summary.median}, {"p90", summary.p90}, {"num_items", summary.num_items}};
}

/// Scores of a face, of the kit's topology or another one.
struct FaceErrors {
  std::optional<double> vertex_mm;
  eval::SurfaceScore surface;
};
FaceErrors ErrorsOf(const std::string& name, const PredictedFace& face, const eval::LandmarkVertices& landmarks,
                    const geometry::Points& truth, const faces::FaceTemplate& face_template) {
  FaceErrors errors;
  if (!face.has_kit_topology) {
    errors.surface = eval::ScoreSurface(face.mesh, landmarks, truth, face_template);
    return errors;
  }
  const geometry::Points vertices = face.mesh.vertices.topRows(face_template.num_vertices());
  errors.surface = eval::ScoreSurface({vertices, face_template.triangles}, landmarks, truth, face_template);
  errors.vertex_mm = eval::ScoreMesh(name, vertices, truth, face_template).aligned;
  return errors;
}

void ScoreFaces(const fs::path& folder, const std::map<std::string, fs::path>& files, const Kit& kit,
                KitScores& scores) {
  const FaceReaderOfFolder reader(folder, kit);
  const PredictedFace mean{{MeanTrainingFace(kit, scores.task), kit.face_template().triangles}, true};
  std::map<std::string, int> mistakes;
  size_t next = 0;
  struct Scored {
    ItemScore score;
    bool has_kit_topology;
    std::optional<std::string> mistake;
  };
  ForEachInOrder(
      int(scores.items.size()),
      [&](int i) {
        Scored scored{scores.items[size_t(i)], true, {}};
        const KitItem& item = scored.score.item;
        const geometry::Points truth = kit.TrueFace(scores.task, scores.split, item);
        const auto file = files.find(item.name);
        scored.score.is_predicted = file != files.end();
        try {
          const PredictedFace face = scored.score.is_predicted ? reader.Read(file->second) : mean;
          const eval::LandmarkVertices& landmarks =
              scored.score.is_predicted ? reader.landmarks() : kit.face_template().annotation.landmarks;
          const FaceErrors errors = ErrorsOf(item.name, face, landmarks, truth, kit.face_template());
          scored.score.vertex_mm = errors.vertex_mm;
          scored.score.surface_mm = errors.surface.mean_mm;
          scored.has_kit_topology = face.has_kit_topology;
          if (scored.score.is_predicted) scored.mistake = eval::FrameMistake(errors.surface.alignment);
        } catch (const Error& error) {
          const std::string cause = error.what(), name = scored.score.is_predicted ? file->second.string() : "";
          throw Error(cause.starts_with(name) ? cause : name + ": " + cause);
        }
        return scored;
      },
      [&](Scored scored) {
        scores.items[next++] = std::move(scored.score);
        scores.has_kit_topology = scores.has_kit_topology && scored.has_kit_topology;
        if (scored.mistake) ++mistakes[*scored.mistake];
      });
  if (!scores.has_kit_topology)  // Means of both kinds would be compared.
    for (ItemScore& score : scores.items) score.vertex_mm.reset();
  int most = 0, all = 0;
  for (const auto& [text, count] : mistakes) {
    all += count;
    if (count > most) most = count, scores.frame_mistake = text;
  }
  if (2 * all <= int(files.size())) scores.frame_mistake.reset();
}

void ScoreLandmarks(const fs::path& folder, const std::map<std::string, fs::path>& files, const Kit& kit,
                    KitScores& scores) {
  const eval::LandmarkRow mean = MeanTrainingLandmarks(kit);
  std::vector<eval::LandmarkPair> pairs;
  for (ItemScore& score : scores.items) {
    const auto file = files.find(score.item.name);
    score.is_predicted = file != files.end();
    const eval::LandmarkRow truth = kit.TrueLandmarks(scores.split, score.item);
    const eval::LandmarkRow predicted = score.is_predicted ? ReadLandmarkRow(file->second) : mean;
    score.nme = eval::NormalisedMeanError(predicted, truth);
    if (score.is_predicted) pairs.push_back({predicted, truth, kit.portrait_size()});
  }
  if (const auto mistake = eval::UnitMistake(pairs))
    throw Error(fmt::format("{}: these are no landmarks of pictures of {} x {} pixels, x to the right, y down: {}",
                            folder.string(), kit.portrait_size(), kit.portrait_size(), *mistake));
}

}  // namespace

int KitScores::num_missing() const {
  return int(std::ranges::count(items, false, &ItemScore::is_predicted));
}

geometry::Points MeanTrainingFace(const Kit& kit, KitTask task) {
  geometry::Points sum = geometry::Points::Zero(kit.face_template().num_vertices(), 3);
  std::set<std::string> truths;
  for (const KitItem& item : kit.items(task, KitSplit::kTrain))
    if (truths.insert(item.truth).second) sum += kit.TrueFace(task, KitSplit::kTrain, item);
  DAUMIER_CHECK(!truths.empty(), "{} has no training item", kit.directory().string());
  return sum / double(truths.size());
}

eval::LandmarkRow MeanTrainingLandmarks(const Kit& kit) {
  eval::LandmarkRow mean = {};
  const std::vector<KitItem>& items = kit.items(KitTask::kLandmarks, KitSplit::kTrain);
  DAUMIER_CHECK(!items.empty(), "{} has no training item", kit.directory().string());
  for (const KitItem& item : items) {
    const eval::LandmarkRow row = kit.TrueLandmarks(KitSplit::kTrain, item);
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += row[i] / double(items.size());
  }
  return mean;
}

KitScores ScorePredictions(const fs::path& predictions, const Kit& kit, KitTask task, KitSplit split) {
  const std::map<std::string, fs::path> files = PredictionFiles(predictions, kit, task, split);
  KitScores scores;
  scores.kit = kit.name();
  scores.kit_hash = DataHash(kit.directory());
  scores.predictions_hash = PredictionsHash(files);
  scores.task = task;
  scores.split = split;
  if (fs::exists(predictions / "method.json")) scores.method = ReadJson(predictions / "method.json");
  for (const KitItem& item : kit.items(task, split)) {
    ItemScore score;
    score.item = item;
    scores.items.push_back(score);
  }
  if (task == KitTask::kLandmarks) {
    ScoreLandmarks(predictions, files, kit, scores);
  } else {
    ScoreFaces(predictions, files, kit, scores);
  }
  return scores;
}

reports::ReportTable KitScoreTable(const KitScores& scores) {
  reports::ReportTable table{"Errors", {"items", "number", "measure", "mean", "95 % interval", "median", "p90"}, {}};
  const auto add = [&](const std::string& title, const std::string& group) {
    for (const KitMeasure& measure : kKitMeasures) {
      const auto summary = SummaryOf(scores, measure, group);
      if (!summary) continue;
      table.rows.push_back(
          {title, fmt::format("{}", summary->num_items), measure.title,
           fmt::format("{:.{}f}", summary->mean, measure.digits),
           fmt::format("{:.{}f} to {:.{}f}", summary->low, measure.digits, summary->high, measure.digits),
           fmt::format("{:.{}f}", summary->median, measure.digits),
           fmt::format("{:.{}f}", summary->p90, measure.digits)});
    }
  };
  add("all", "");
  for (const std::string& group : GroupsOf(scores)) add(group, group);
  return table;
}

Json KitScoresToJson(const KitScores& scores) {
  Json missing = Json::array(), items = Json::array(), groups = Json::object();
  for (const ItemScore& score : scores.items) {
    if (!score.is_predicted) missing.push_back(score.item.name);
    Json item = {{"name", score.item.name}, {"person", score.item.person}, {"predicted", score.is_predicted}};
    for (const KitMeasure& measure : kKitMeasures)
      if (score.*measure.value) item[measure.key] = measure.factor * *(score.*measure.value);
    items.push_back(std::move(item));
  }
  Json result = {{"benchmark", scores.kit},
                 {"kit_hash", scores.kit_hash},
                 {"task", kKitTaskNames[size_t(scores.task)]},
                 {"split", kKitSplitNames[size_t(scores.split)]},
                 {"method", scores.method},
                 {"predictions_hash", scores.predictions_hash},
                 {"num_items", scores.items.size()},
                 {"num_missing", missing.size()},
                 {"missing", missing},
                 {"topology", scores.has_kit_topology ? "kit" : "own"},
                 {"frame_mistake", scores.frame_mistake ? Json(*scores.frame_mistake) : Json()}};
  for (const KitMeasure& measure : kKitMeasures) {
    const auto summary = SummaryOf(scores, measure);
    if (!summary) continue;
    result[measure.key] = SummaryToJson(*summary);
    for (const std::string& group : GroupsOf(scores))
      groups[group][measure.key] = SummaryToJson(*SummaryOf(scores, measure, group));
  }
  result["groups"] = groups;
  result["items"] = items;
  return result;
}

}  // namespace daumier::benchmark
