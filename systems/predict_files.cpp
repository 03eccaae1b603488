#include "systems/predict_files.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "core/weights_folder.h"
#include "render/camera.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "render/svg.h"
#include "reports/face_surface.h"
#include "reports/head_file.h"

#include <fmt/ranges.h>

#include <memory>
#include <optional>
#include <set>
#include <span>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide = 360;
constexpr const char* kKind = "predictions";

/// head: null where the result has no mesh.
render::Image SheetOf(const faces::FinishedHead* head, const FaceResult& face) {
  std::vector<render::SheetCell> cells = face.pictures;
  const auto add = [&](const char* caption, render::Image picture) { cells.push_back({std::move(picture), caption}); };
  if (!face.drawn.empty())
    add("sketch, and the face's curves", render::DrawnWithCurves(face.drawn, face.curves, kPictureSide));
  if (head == nullptr) return render::MakeSheet(cells, int(cells.size()));
  const render::RenderInput surface = reports::InputOf(*head, face.vertices);
  const auto frame = render::FrameOf(face.vertices);
  add("front", RenderMesh(surface, render::FrontalCamera(frame.centre, frame.half_height, kPictureSide)));
  add("side", RenderMesh(surface, render::SideCamera(frame.centre, frame.half_height, kPictureSide)));
  return render::MakeSheet(cells, int(cells.size()));
}

/// The files that the result of an input may have.
std::vector<std::string> FilesOf(const System& system, const std::string& name) {
  std::vector<std::string> files;
  for (const std::string& suffix : system.result_files) files.push_back(name + suffix);
  return files;
}

/// Writes the files of one result and returns their names. head: null where it has no mesh.
std::vector<std::string> WriteResult(const fs::path& folder, const std::string& name, const faces::FinishedHead* head,
                                     const FaceResult& face) {
  std::vector<std::string> files;
  const auto file = [&](const std::string& suffix) { return folder / files.emplace_back(name + suffix); };
  if (head != nullptr) {
    reports::WriteHead(file(".obj"), *head, face.vertices);
    files.push_back(name + ".mtl");
  }
  render::WriteImage(file(".png"), SheetOf(head, face));
  if (!face.drawn.empty()) render::WriteSvg(file(".svg"), face.drawn, {"line"});
  for (const ResultText& text : face.files) WriteFileAtomically(file(text.suffix), text.text);
  for (const ResultMask& mask : face.masks) render::WriteImage(file(mask.suffix), mask.image);
  return files;
}

/// The finished head of the template of the last face: a predictor has one template.
class LastHead {
 public:
  /// Null for a result without a mesh.
  const faces::FinishedHead* Of(const FaceResult& face) {
    if (face.face_template == nullptr) return nullptr;
    if (face_template_ != face.face_template) {
      head_.emplace(*face.face_template);
      face_template_ = face.face_template;
    }
    return &*head_;
  }

 private:
  std::shared_ptr<const faces::FaceTemplate> face_template_;
  std::optional<faces::FinishedHead> head_;
};

/// The records of an earlier prediction. Those of another run or of other options than the manifest's name their own.
Json EarlierRecords(const Manifest& earlier, const Manifest& manifest) {
  const auto found = earlier.details.find("drawings");
  if (found == earlier.details.end() || !found->is_object()) return Json::object();
  Json records = *found;
  const Json run = earlier.details.value("run_data_hash", Json());
  for (auto& [name, record] : records.items()) {
    if (!record.is_object() || record.contains("options")) continue;
    if (earlier.config == manifest.config && run == manifest.details["run_data_hash"]) continue;
    record["options"] = earlier.config;
    record["run_data_hash"] = run;
  }
  return records;
}

/// A manifest without results of its own. Of an earlier prediction in the folder it keeps the records, the files that
/// are unchanged, and those that it had not finished.
Manifest BeginManifest(const System& system, const fs::path& run, const fs::path& folder, const Json& options) {
  const bool is_shipped = IsWeightsFolder(run);
  const Manifest of_run = ReadManifest(run, is_shipped ? kWeightsKind : "run");
  Manifest manifest{.kind = kKind, .verb = "predict"};
  manifest.config = options;
  manifest.seed = of_run.seed;
  manifest.sources = of_run.sources;
  manifest.details = {{"system", system.name}, {"run_data_hash", DataHash(run)}, {"drawings", Json::object()}};
  if (is_shipped) manifest.details["weights"] = WeightsName(run);
  if (!fs::exists(folder / "manifest.json")) return manifest;
  const Manifest earlier = ReadManifest(folder, kKind);
  for (const auto& [file, checksum] : earlier.checksums)
    if (fs::is_regular_file(folder / file) && Sha256OfFile(folder / file) == checksum)
      manifest.checksums[file] = checksum;
  manifest.details["drawings"] = EarlierRecords(earlier, manifest);
  return manifest;
}

/// The files that a killed prediction had not finished.
std::set<std::string> UnfinishedIn(const fs::path& folder) {
  std::set<std::string> files;
  if (!fs::exists(folder / "manifest.json")) return files;
  const Json details = ReadManifest(folder, kKind).details;
  const auto listed = details.find(kUnfinishedFiles);
  if (listed == details.end() || !listed->is_array()) return files;
  for (const Json& file : *listed)
    if (file.is_string() && fs::is_regular_file(folder / file.get<std::string>())) files.insert(file);
  return files;
}

/// @throws UsageError if the folder holds predictions of another task.
void CheckSameTask(const System& system, const fs::path& folder) {
  if (!fs::exists(folder / "manifest.json")) return;
  const std::string earlier = ReadManifest(folder, kKind).details.value("system", std::string(system.name));
  if (earlier != system.name)
    throw UsageError(fmt::format("{} holds predictions of the task '{}', and these are of '{}': name another folder",
                                 folder.string(), earlier, system.name));
}

/// Without paths: the file's name.
void AddFailures(const std::vector<PredictionFailure>& failures, Manifest& manifest) {
  Json& list = manifest.details["failures"] = Json::array();
  for (const PredictionFailure& failure : failures) {
    std::string cause = failure.cause;
    if (const size_t at = cause.find(failure.file.string()); at != std::string::npos)
      cause.replace(at, failure.file.string().size(), failure.file.filename().string());
    list.push_back({{"file", failure.file.filename().string()}, {"cause", cause}});
  }
}

}  // namespace

OutputKind PredictionOutput() {
  return {kKind};
}

void CheckPredictionFolder(const System& system, const fs::path& out_directory, const fs::path& run,
                           const PredictionInputs& inputs) {
  std::vector<fs::path> files{run};
  for (const PredictionInput& input : inputs.inputs) files.push_back(input.file);
  for (const PredictionFailure& failure : inputs.failures) files.push_back(failure.file);
  CheckOutputFolder(out_directory, PredictionOutput(), files);
  CheckSameTask(system, out_directory);
  std::vector<std::string> written;
  for (const PredictionInput& input : inputs.inputs)
    for (std::string& file : FilesOf(system, input.name)) written.push_back(std::move(file));
  CheckOwnFiles(out_directory, written);
}

PredictionSummary PredictFiles(const System& system, const Predictor& predictor, const fs::path& run,
                               const PredictionInputs& inputs, const fs::path& out_directory, const Json& options,
                               const Task& task) {
  CheckPredictionFolder(system, out_directory, run, inputs);
  PredictionSummary summary{0, inputs.failures};
  Manifest manifest = BeginManifest(system, run, out_directory, options);
  std::set<std::string> unfinished = UnfinishedIn(out_directory);
  const auto write_manifest = [&] {
    manifest.counts = {{"drawings", manifest.details["drawings"].size()}};
    manifest.details.erase(kUnfinishedFiles);
    if (!unfinished.empty()) manifest.details[kUnfinishedFiles] = unfinished;
    AddFailures(summary.failures, manifest);
    WriteManifest(out_directory, manifest);
  };
  const auto num_inputs = int64_t(inputs.inputs.size());
  const auto stopped = [&](int64_t done) {
    return Cancelled(fmt::format("stopped after {} of {} inputs; {}", done, num_inputs,
                                 summary.num_results == 0 ? "nothing was written"
                                                          : fmt::format("{} holds the results of {}",
                                                                        out_directory.string(), summary.num_results)));
  };
  LastHead head;
  const Task silent(task.stop);  // What a predictor reports of one input is no progress of them all.
  for (int64_t i = 0; i < num_inputs; ++i) {
    const PredictionInput& named = inputs.inputs[i];
    task.Report(i, num_inputs, "inputs");
    if (task.cancelled()) throw stopped(i);
    FaceResult face;
    try {
      face = std::move(predictor.Predict(std::span(&named.input, 1), silent).front());
    } catch (const Cancelled&) {
      throw stopped(i);
    } catch (const std::exception& error) {  // Of LibTorch or JSON, too: the other inputs count.
      summary.failures.push_back(FailureOf(named.file, error));
      continue;
    }
    for (const std::string& warning : face.warnings) log::Warn("{}: {}", named.name, warning);
    // The manifest comes first: whenever the program is killed, the same command recognises its files.
    const std::vector<std::string> begun = FilesOf(system, named.name);
    for (const std::string& file : begun) manifest.checksums.erase(file), unfinished.insert(file);
    manifest.details["drawings"].erase(named.name);
    MakeDirectory(out_directory);
    write_manifest();
    for (const std::string& file : WriteResult(out_directory, named.name, head.Of(face), face))
      manifest.checksums[file] = Sha256OfFile(out_directory / file);
    for (const std::string& file : begun) unfinished.erase(file);
    Json& record = manifest.details["drawings"][named.name] = {{"file", named.file.filename().string()}};
    record.update(face.record);
    ++summary.num_results;
    write_manifest();
  }
  task.Report(num_inputs, num_inputs, "inputs");
  if (summary.num_results > 0) write_manifest();  // With the failures that came last.
  return summary;
}

void ThrowIfFailed(const PredictionSummary& summary, const fs::path& out_directory) {
  const size_t num_failures = summary.failures.size(), num_inputs = num_failures + summary.num_results;
  if (num_failures == 0) return;
  std::vector<std::string> causes;
  for (const PredictionFailure& failure : summary.failures) causes.push_back(failure.cause);
  if (num_inputs == 1) throw Error(causes.front());
  const std::string others = summary.num_results > 0
                                 ? fmt::format("the results of the others are in {}", out_directory.string())
                                 : "nothing was written";
  throw Error(
      fmt::format("{} of {} inputs failed; {}:\n  {}", num_failures, num_inputs, others, fmt::join(causes, "\n  ")));
}

}  // namespace daumier::systems
