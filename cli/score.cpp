#include "benchmark/score.h"
#include "cli/score_template.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "eval/drawing_labels.h"
#include "eval/drawing_score.h"
#include "eval/drawing_table.h"
#include "eval/mesh_score.h"
#include "eval/plausibility.h"
#include "eval/predicted_meshes.h"
#include "faces/face_database.h"
#include "reports/report_table.h"
#include "studio/votes.h"

#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <vector>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct ScoreArguments {
  fs::path predictions, labels, truth, plausible, kit;
  std::string face_template, task, split = "test";
  bool as_json = false;
};

void ScoreLabelledDrawings(const ScoreArguments& arguments) {
  const std::vector<eval::LabelledDrawing> drawings = eval::ReadDrawingLabels(arguments.labels);
  const ScoreTemplate of = ReadScoreTemplate(arguments.face_template, arguments.predictions);
  const eval::DrawnPredictions predictions =
      eval::ReadDrawnPredictions(arguments.predictions, drawings, of.face_template);
  const std::vector<eval::DrawingScore> scores =
      eval::ScoreDrawings({of.face_template, of.camera}, drawings, predictions.of_labelled);
  std::vector<std::string> missing;
  for (const eval::DrawingScore& score : scores)
    if (!score.is_predicted) missing.push_back(score.name);
  if (!missing.empty()) log::Info("Without a prediction, and counted as the mean face: {}", fmt::join(missing, ", "));
  if (!predictions.unlabelled.empty())
    log::Info("Without labels, and not scored: {}", fmt::join(predictions.unlabelled, ", "));
  if (arguments.as_json) {
    PrintResult(eval::DrawingScoresToJson(scores), true);
    return;
  }
  fmt::print(
      "NME: mean distance of points and labels, in per cent of the distance of the outer corners of the eyes.\n"
      "Placed best: after the similarity that brings a face nearest to the labels.\n\n{}\n{}",
      reports::TableText(eval::DrawingTable(scores)),
      reports::TableText(eval::DrawingGroupTable(eval::GroupScores(scores))));
}

void ScorePredictedMeshes(const ScoreArguments& arguments) {
  const bool is_database = fs::exists(arguments.truth / "template.json");
  std::vector<eval::MeshScore> scores;
  if (is_database) {
    scores = eval::ScoreMeshes(arguments.predictions, faces::FaceDatabase(arguments.truth));
  } else {
    const ScoreTemplate of = ReadScoreTemplate(arguments.face_template, arguments.predictions);
    scores = eval::ScoreMeshes(arguments.predictions, arguments.truth, of.face_template);
  }
  if (arguments.as_json) {
    PrintResult(eval::MeshScoresToJson(scores), true);
    return;
  }
  fmt::print("{}faces: {}\n", reports::TableText(eval::MeshScoreTable(scores)), scores.size());
}

void ScorePlausibleFaces(const ScoreArguments& arguments) {
  const eval::PlausibilityScores scores =
      eval::ScorePlausibility(arguments.predictions, faces::FaceDatabase(arguments.plausible));
  if (arguments.as_json) {
    PrintResult(eval::PlausibilityToJson(scores), true);
    return;
  }
  fmt::print(
      "Mean distance of vertices to the nearest face, mm, face region after similarity.\n"
      "{} of {} predictions are within {:.2f} mm: so near are 99 % of {} faces to one of another person (median "
      "{:.2f}).\n\n{}",
      scores.num_within(), scores.of_predictions.size(), scores.limit_mm, scores.num_faces, scores.median_mm,
      reports::TableText(eval::PlausibilityTable(scores)));
}

void ScoreOnBenchmark(const ScoreArguments& arguments) {
  if (arguments.task.empty())
    throw UsageError(fmt::format("--benchmark needs --task, one of {}", fmt::join(benchmark::kKitTaskNames, ", ")));
  const benchmark::KitScores scores =
      benchmark::ScorePredictions(arguments.predictions, benchmark::Kit(arguments.kit),
                                  benchmark::KitTaskNamed(arguments.task), benchmark::KitSplitNamed(arguments.split));
  if (scores.num_missing() > 0)
    log::Warn("{} of {} items have no prediction: each counts as the mean of the training persons",
              scores.num_missing(), scores.items.size());
  if (scores.frame_mistake)
    log::Warn("{}: {}. The scores do not depend on it", arguments.predictions.string(), *scores.frame_mistake);
  if (arguments.as_json) {
    PrintResult(benchmark::KitScoresToJson(scores), true);
    return;
  }
  fmt::print("{}{}, split {}: {} items, {} without a prediction\n",
             reports::TableText(benchmark::KitScoreTable(scores)), scores.kit,
             benchmark::kKitSplitNames[size_t(scores.split)], scores.items.size(), scores.num_missing());
}

void ScoreVotes(const fs::path& file, bool as_json) {
  const std::vector<studio::Vote> votes = studio::ReadVotes(file);
  const std::vector<studio::VoteSummary> summaries = studio::SummariseVotes(votes);
  const Json json = studio::VotesToJson(votes, summaries);
  if (as_json) {
    PrintResult(json, true);
    return;
  }
  fmt::print("{}participants: {}, items: {}\n", reports::TableText(studio::VoteTable(summaries)),
             json.at("participants").get<int>(), json.at("items").get<int>());
}

void Score(const ScoreArguments& arguments) {
  const int num_given = int(!arguments.labels.empty()) + int(!arguments.truth.empty()) +
                        int(!arguments.plausible.empty()) + int(!arguments.kit.empty());
  if (fs::is_regular_file(arguments.predictions)) {
    if (num_given > 0)
      throw UsageError("a file of votes is scored alone, without --labels, --truth, --plausible and --benchmark");
    return ScoreVotes(arguments.predictions, arguments.as_json);
  }
  if (num_given != 1)
    throw UsageError(
        "score needs one of --labels FILE (of drawings), --truth FOLDER (of true faces), --plausible FOLDER (of any "
        "faces) and --benchmark KIT");
  if (!arguments.kit.empty()) return ScoreOnBenchmark(arguments);
  if (!arguments.labels.empty()) {
    ScoreLabelledDrawings(arguments);
  } else if (!arguments.truth.empty()) {
    ScorePredictedMeshes(arguments);
  } else {
    ScorePlausibleFaces(arguments);
  }
}

}  // namespace

Verb ScoreVerb() {
  return {
      "score",
      "Errors of predictions: on a benchmark, on drawings with labelled points, against true faces, or as faces among "
      "others; votes of a study",
      [](CLI::App& command) {
        auto arguments = std::make_shared<ScoreArguments>();
        command
            .add_option("predictions", arguments->predictions,
                        "Folder of meshes NAME.obj (or .ply). With --labels also manifest.json, as `daumier "
                        "predict --out` writes it: details.drawings.NAME.frame = {scale, shift, turn_degrees}. Or "
                        "the file of votes of `daumier studio --study`: votes, mean and deviation by method and "
                        "question")
            ->required()
            ->check(CLI::ExistingPath);
        command
            .add_option("--labels", arguments->labels,
                        "JSON file of points that people set on drawings: {\"drawings\": {NAME: {file, "
                        "interocular, points: {POINT: [x, y]}, mouth, eyes, usable, line}}}. A usable drawing "
                        "without a prediction counts as the mean face in the frame of its extents")
            ->check(CLI::ExistingFile);
        command
            .add_option("--truth", arguments->truth,
                        "Folder of faces that `daumier dataset faces` wrote (NAME is face-00012, "
                        "person-00003-level-1-smile, or a person of an imported folder), or folder of meshes of "
                        "the same names and vertex order")
            ->check(CLI::ExistingDirectory);
        command
            .add_option("--plausible", arguments->plausible,
                        "Folder of faces that `daumier dataset faces` wrote: the distance of each prediction to the "
                        "nearest of 2,000 of them, against the distances among themselves")
            ->check(CLI::ExistingDirectory);
        CLI::Option* kit = command
                               .add_option("--benchmark", arguments->kit,
                                           "Folder that `daumier benchmark make` wrote: errors of predictions of "
                                           "its inputs, by their names (docs/benchmark.md). Faces of the kit's "
                                           "topology, or of another one with its 68 landmarks as vertices in "
                                           "landmarks.txt next to them. An item without a prediction counts as "
                                           "the mean of the training persons")
                               ->check(CLI::ExistingDirectory);
        command
            .add_option("--task", arguments->task,
                        "Of --benchmark: drawings, caricatures, portraits (faces) or landmarks (NAME.pts of portraits)")
            ->needs(kit);
        command.add_option("--split", arguments->split, "Of --benchmark: train, validation or test")
            ->capture_default_str()
            ->needs(kit);
        command.add_option(
            "--template", arguments->face_template,
            "Run, weights or folder of faces with the template of the meshes; without it the "
            "weights that the predictions name. Not read with a folder of faces as truth or --plausible");
        command.add_flag("--json", arguments->as_json, "Print the result as JSON");
        return [arguments] { Score(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
