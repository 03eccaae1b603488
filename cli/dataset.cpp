#include "cli/config_kind.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/files.h"
#include "core/options.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "datasets/build/coverage.h"
#include "datasets/build/faces.h"
#include "datasets/build/points.h"
#include "datasets/build/sharded_build.h"
#include "datasets/build/sketches.h"
#include "datasets/build/stats.h"
#include "datasets/gallery/face_gallery.h"

#include <memory>
#include <optional>

namespace daumier::cli {

namespace {

namespace fs = std::filesystem;

struct BuildArguments {
  ConfigArguments config;
  fs::path out;
};

std::vector<fs::path> InputsOf(const datasets::FacesOptions& options) {
  return {options.source.path, options.source.annotation, options.source.template_mesh};
}

/// Of sketches and points.
template <class Options>
std::vector<fs::path> InputsOf(const Options& options) {
  return {options.faces};
}

void RequireInputs(const std::string&, const datasets::FacesOptions&) {}

/// Of sketches and points. @throws UsageError without a folder of faces.
template <class Options>
void RequireInputs(const std::string& name, const Options& options) {
  if (options.faces.empty())
    throw UsageError(fmt::format(
        "dataset {}: it needs faces=FOLDER, a folder of faces that `daumier dataset faces` or `register` wrote", name));
}

/// A builder of datasets: a config of type Options becomes the folder --out, of the manifest kind `name`.
template <class Options>
std::function<void()> AddBuilder(CLI::App& parent, const std::string& name, const std::string& summary,
                                 void (*build)(const Options&, const fs::path&, const Task&)) {
  auto arguments = std::make_shared<BuildArguments>();
  CLI::App* command = parent.add_subcommand(name, summary);
  AddConfigArguments(*command, arguments->config);
  command->add_option("-o,--out", arguments->out, "Folder to write; resumes an interrupted build")->required();
  command->footer("Options:\n" + HelpText<Options>());
  return [arguments, build, name] {
    const auto options = ReadConfigOf("dataset " + name, arguments->config.file, [&] {
      return ParseOptions<Options>(arguments->config.Load(), arguments->config.Where());
    });
    RequireInputs(name, options);
    CheckOutputFolder(arguments->out, datasets::BuildOutput(name), InputsOf(options));
    build(options, arguments->out, TaskOfProcess());
  };
}

std::function<void()> AddStats(CLI::App& parent) {
  struct Arguments {
    fs::path directory, rebuild;
    bool as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = parent.add_subcommand("stats", "Counts, licences, principal components for 99 % of the variance");
  command->add_option("directory", arguments->directory, "A folder of faces")->required();
  command->add_option("--rebuild", arguments->rebuild,
                      "Another folder of faces of the same topology: how well these components rebuild it");
  command->add_flag("--json", arguments->as_json, "Machine-readable");
  return [arguments] {
    Json result = datasets::FaceStatistics(arguments->directory);
    if (!arguments->rebuild.empty()) {
      const faces::FaceDatabase basis(arguments->directory, Checksums::kSkip),
          rebuilt(arguments->rebuild);  // Verified above.
      const datasets::Coverage coverage = datasets::MeasureCoverage(basis, rebuilt);
      result["rebuilt"] = {{"num_basis_faces", coverage.num_basis_faces},
                           {"components", coverage.components},
                           {"mean_vertex_error_mm", coverage.errors_mm}};
    }
    PrintResult(result, arguments->as_json);
  };
}

std::function<void()> AddGallery(CLI::App& parent) {
  struct Arguments {
    fs::path faces, sketches, out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      parent.add_subcommand("gallery", "Pictures of a database: identities, expressions, levels, curves, sketches");
  command->add_option("faces", arguments->faces, "A folder of faces")->required();
  command->add_option("sketches", arguments->sketches, "Its folder of sketches");
  command->add_option("-o,--out", arguments->out, "Folder to write")->required();
  return [arguments] {
    const Task task = TaskOfProcess();
    datasets::CheckGalleryFolder(arguments->out, {arguments->faces, arguments->sketches});
    const faces::FaceDatabase database(arguments->faces);
    std::optional<datasets::SketchDatabase> sketches;
    if (!arguments->sketches.empty()) sketches.emplace(arguments->sketches);
    MakeDirectory(arguments->out);
    datasets::WriteGallery(database, sketches ? &*sketches : nullptr, arguments->out, task);
  };
}

}  // namespace

Verb DatasetVerb() {
  return {"dataset", "Build faces, sketches and surface points, look at them, count them", [](CLI::App& command) {
            command.require_subcommand(1);
            const std::vector<std::pair<std::string, std::function<void()>>> actions = {
                {"faces",
                 AddBuilder<datasets::FacesOptions>(command, "faces", "A database of faces", datasets::BuildFaces)},
                {"sketches", AddBuilder<datasets::SketchesOptions>(
                                 command, "sketches", "A sketch of every face of a database", datasets::BuildSketches)},
                {"points", AddBuilder<datasets::PointsOptions>(
                               command, "points", "Points on the surface of every face of a database, and attributes",
                               datasets::BuildPoints)},
                {"stats", AddStats(command)},
                {"gallery", AddGallery(command)}};
            return [&command, actions] {
              for (const auto& [name, run] : actions) {
                if (command.got_subcommand(name)) run();
              }
            };
          }};
}

}  // namespace daumier::cli
