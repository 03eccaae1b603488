#include "systems/predict_files.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/parallel.h"
#include "render/camera.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "render/svg.h"
#include "reports/face_surface.h"
#include "reports/head_file.h"
#include "systems/prediction_folder.h"

#include <fmt/ranges.h>

#include <array>
#include <future>
#include <memory>
#include <optional>
#include <span>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide = 360;

/// Empty where there is nothing to show. head: null where the result has no mesh.
render::Image SheetOf(const faces::FinishedHead* head, const FaceResult& face) {
  std::vector<render::SheetCell> cells = face.pictures;
  const auto add = [&](const char* caption, render::Image picture) { cells.push_back({std::move(picture), caption}); };
  if (!face.drawn.empty())
    add("sketch, and the face's curves", render::DrawnWithCurves(face.drawn, face.curves, kPictureSide));
  if (head == nullptr) return cells.empty() ? render::Image() : render::MakeSheet(cells, int(cells.size()));
  const render::RenderInput surface = reports::InputOf(*head, face.vertices);
  const auto frame = render::FrameOf(face.vertices);
  const std::array<render::Camera, 2> cameras = {render::FrontalCamera(frame.centre, frame.half_height, kPictureSide),
                                                 render::SideCamera(frame.centre, frame.half_height, kPictureSide)};
  std::array<render::Image, 2> views;
  OnAllCores(2, [&](int64_t view) { views[size_t(view)] = RenderMesh(surface, cameras[size_t(view)]); });
  add("front", std::move(views[0]));
  add("side", std::move(views[1]));
  return render::MakeSheet(cells, int(cells.size()));
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
  if (const render::Image sheet = SheetOf(head, face); !sheet.pixels.empty()) render::WriteImage(file(".png"), sheet);
  if (!face.drawn.empty()) render::WriteSvg(file(".svg"), face.drawn, {"line"});
  for (const ResultText& text : face.files) WriteFileAtomically(file(text.suffix), text.text);
  for (const ResultMask& mask : face.masks) render::WriteImage(file(mask.suffix), mask.image);
  return files;
}

/// The finished head of the template of the last face. A predictor has one template, whose head is made while the
/// first face is predicted.
class LastHead {
 public:
  explicit LastHead(std::shared_ptr<const faces::FaceTemplate> face_template)
      : face_template_(std::move(face_template)) {
    if (face_template_ == nullptr) return;
    ready_ = std::async(std::launch::async,
                        [face_template = face_template_] { return faces::FinishedHead(*face_template); });
  }

  /// Null for a result without a mesh.
  const faces::FinishedHead* Of(const FaceResult& face) {
    if (face.face_template == nullptr) return nullptr;
    if (face_template_ != face.face_template) {
      head_.emplace(*face.face_template);
      face_template_ = face.face_template;
    } else if (!head_.has_value()) {
      head_ = ready_.get();
    }
    return &*head_;
  }

 private:
  std::shared_ptr<const faces::FaceTemplate> face_template_;
  std::optional<faces::FinishedHead> head_;
  std::future<faces::FinishedHead> ready_;
};

}  // namespace

PredictionSummary PredictFiles(const System& system, const Predictor& predictor, const fs::path& run,
                               const PredictionInputs& inputs, const fs::path& out_directory, const Json& options,
                               const Task& task) {
  PredictionFolder folder(system, out_directory, run, options, inputs, task);
  PredictionSummary summary{0, inputs.failures};
  const auto num_inputs = int64_t(inputs.inputs.size());
  const auto stopped = [&](int64_t done) {
    return Cancelled(fmt::format("stopped after {} of {} inputs; {}", done, num_inputs,
                                 summary.num_results == 0 ? "nothing was written"
                                                          : fmt::format("{} holds the results of {}",
                                                                        out_directory.string(), summary.num_results)));
  };
  LastHead head(inputs.inputs.empty() ? nullptr : predictor.face_template());
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
    folder.Add(named, face.record, summary.failures,
               [&](const fs::path& staging) { return WriteResult(staging, named.name, head.Of(face), face); });
    ++summary.num_results;
  }
  task.Report(num_inputs, num_inputs, "inputs");
  folder.Finish(summary.failures);
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
