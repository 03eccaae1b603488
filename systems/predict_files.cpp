#include "systems/predict_files.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "geometry/obj.h"
#include "render/camera.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "render/svg.h"
#include "reports/face_surface.h"

#include <set>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide = 360;
constexpr const char* kKind = "predictions";

struct NamedInput {
  std::string name;
  fs::path file;
  Input input;
};

std::vector<NamedInput> ReadAll(const System& system, const Predictor& predictor, const std::vector<fs::path>& files) {
  std::set<std::string> taken;
  std::vector<NamedInput> all;
  for (const fs::path& file : files) {
    for (Input& input : system.read_inputs(file)) {
      std::vector<Input> faces = predictor.Separate(std::move(input));
      for (size_t i = 0; i < faces.size(); ++i) {
        const std::string stem = file.stem().string() + (faces.size() > 1 ? fmt::format("_{}", i + 1) : "");
        std::string name = stem;
        for (int copy = 2; !taken.insert(name).second; ++copy) name = fmt::format("{}-{}", stem, copy);
        all.push_back({name, file, std::move(faces[i])});
      }
    }
  }
  return all;
}

render::Image SheetOf(const FaceResult& face) {
  const render::RenderInput surface = reports::SurfaceOf(*face.face_template, face.vertices);
  const auto frame = render::FrameOf(face.vertices);
  std::vector<render::SheetCell> cells;
  const auto add = [&](const char* caption, render::Image picture) { cells.push_back({std::move(picture), caption}); };
  if (!face.drawn.empty())
    add("sketch, and the face's curves", render::DrawnWithCurves(face.drawn, face.curves, kPictureSide));
  add("front", RenderMesh(surface, render::FrontalCamera(frame.centre, frame.half_height, kPictureSide)));
  add("side", RenderMesh(surface, render::SideCamera(frame.centre, frame.half_height, kPictureSide)));
  return render::MakeSheet(cells, int(cells.size()));
}

/// Writes the files of one result and returns their names.
std::vector<std::string> WriteResult(const fs::path& folder, const std::string& name, const FaceResult& face) {
  std::vector<std::string> written{name + ".obj", name + ".png"};
  geometry::WriteObj(folder / written[0], faces::SurfaceMesh(*face.face_template, face.vertices));
  render::WriteImage(folder / written[1], SheetOf(face));
  if (!face.drawn.empty()) {
    written.push_back(name + ".svg");
    render::WriteSvg(folder / written.back(), face.drawn, {"line"});
  }
  return written;
}

/// @throws Error if results there would overwrite what is no prediction.
void CheckOutDirectory(const fs::path& directory) {
  if (!fs::exists(directory)) return;
  DAUMIER_CHECK(fs::is_directory(directory), "{} is a file (expected a folder). Name another one", directory.string());
  if (!fs::exists(directory / "manifest.json")) return;
  const std::string kind = ReadManifest(directory, "").kind;
  DAUMIER_CHECK(kind == kKind, "{} is a folder of {} (expected a new one, or one of {}). Name another folder",
                directory.string(), kind, kKind);
}

}  // namespace

void PredictFiles(const System& system, const Predictor& predictor, const fs::path& run,
                  const std::vector<fs::path>& files, const fs::path& out_directory, const Json& options,
                  const Task& task) {
  CheckOutDirectory(out_directory);
  const std::vector<NamedInput> inputs = ReadAll(system, predictor, files);
  std::vector<FaceResult> results;
  Json records = Json::object();
  for (const NamedInput& named : inputs) {
    task.ThrowIfCancelled("stopped after {} of {} inputs; nothing was written", results.size(), inputs.size());
    try {
      results.push_back(std::move(predictor.Predict(std::span(&named.input, 1), task).front()));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", named.file.string(), error.what()));
    }
    for (const std::string& warning : results.back().warnings) log::Warn("{}: {}", named.name, warning);
    records[named.name] = results.back().record;
    task.Report(int64_t(results.size()), int64_t(inputs.size()), "inputs");
  }

  const Manifest of_run = ReadManifest(run, "run");
  Manifest manifest;
  manifest.kind = kKind;
  manifest.verb = "predict";
  manifest.config = options;
  manifest.seed = of_run.seed;
  manifest.sources = of_run.sources;
  manifest.counts = {{"drawings", results.size()}};
  manifest.details = {{"system", system.name}, {"run_data_hash", DataHash(run)}, {"drawings", records}};
  MakeDirectory(out_directory);
  for (size_t i = 0; i < results.size(); ++i)
    for (const std::string& file : WriteResult(out_directory, inputs[i].name, results[i]))
      manifest.checksums[file] = Sha256OfFile(out_directory / file);
  WriteManifest(out_directory, manifest);
}

}  // namespace daumier::systems
