#include "cli/config_kind.h"
#include "cli/template_choice.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/files.h"
#include "core/options.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/weights_folder.h"
#include "datasets/build/coverage.h"
#include "datasets/build/faces.h"
#include "datasets/build/gestures.h"
#include "datasets/build/level_measures.h"
#include "datasets/build/points.h"
#include "datasets/build/portraits.h"
#include "datasets/build/sharded_build.h"
#include "datasets/build/sketches.h"
#include "datasets/build/stats.h"
#include "datasets/build/two_sample.h"
#include "datasets/gallery/control_sheets.h"
#include "datasets/gallery/face_gallery.h"
#include "datasets/gallery/portrait_gallery.h"
#include "faces/controls/given_controls.h"
#include "faces/face_model_weights.h"
#include "systems/portrait/given_portraits.h"

#include <fmt/core.h>

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

std::vector<fs::path> InputsOf(const datasets::PortraitsOptions& options) {
  return {options.faces, options.source.path, options.source.annotation, options.source.template_mesh};
}

std::vector<fs::path> InputsOf(const datasets::GesturesOptions&) {
  return {};
}

/// Of sketches and points.
template <class Options>
std::vector<fs::path> InputsOf(const Options& options) {
  return {options.faces};
}

void RequireInputs(const std::string&, const datasets::FacesOptions&) {}

void RequireInputs(const std::string&, const datasets::GesturesOptions&) {}

/// Of sketches, points and portraits. @throws UsageError without a folder of faces.
template <class Options>
void RequireInputs(const std::string& name, const Options& options) {
  if (options.faces.empty())
    throw UsageError(fmt::format(
        "dataset {}: it needs faces=FOLDER, a folder of faces that `daumier dataset faces` or `register` wrote", name));
}

/// A config of type Options becomes the folder --out, of the manifest kind `name`.
template <class Options>
void Build(const BuildArguments& arguments, const std::string& name,
           void (*build)(const Options&, const fs::path&, const Task&)) {
  const auto options = ReadConfigOf("dataset " + name, arguments.config.file, [&] {
    return ParseOptions<Options>(arguments.config.Load(), arguments.config.Where());
  });
  RequireInputs(name, options);
  CheckOutputFolder(arguments.out, datasets::BuildOutput(name), InputsOf(options));
  build(options, arguments.out, TaskOfProcess());
}

template <class Options>
std::function<void()> AddBuilder(CLI::App& parent, const std::string& name, const std::string& summary,
                                 void (*build)(const Options&, const fs::path&, const Task&)) {
  auto arguments = std::make_shared<BuildArguments>();
  CLI::App* command = parent.add_subcommand(name, summary);
  AddConfigArguments(*command, arguments->config);
  command->add_option("-o,--out", arguments->out, "Folder to write; resumes an interrupted build")->required();
  command->footer("Options:\n" + HelpText<Options>());
  return [arguments, build, name] { Build(*arguments, name, build); };
}

/// Portraits of the faces of a database, or with --images of given pictures: each has options of its own.
std::function<void()> AddPortraits(CLI::App& parent) {
  struct Arguments {
    BuildArguments build;
    fs::path images;
  };
  auto arguments = std::make_shared<Arguments>();
  const std::string name = "portraits";
  CLI::App* command =
      parent.add_subcommand(name, "Cartoon portraits of the faces of a database, with their truth; or given pictures");
  AddConfigArguments(*command, arguments->build.config);
  command->add_option("--images", arguments->images,
                      "Folder of pictures, with sub-folders: portraits of the faces that a run finds in them, without "
                      "faces=");
  command->add_option("-o,--out", arguments->build.out, "Folder to write; resumes an interrupted build")->required();
  command->footer("Options:\n" + HelpText<datasets::PortraitsOptions>() + "\nOptions with --images:\n" +
                  HelpText<portrait::GivenPortraitsOptions>());
  return [arguments, name] {
    const BuildArguments& build = arguments->build;
    if (arguments->images.empty()) return Build<datasets::PortraitsOptions>(build, name, datasets::BuildPortraits);
    const auto options =
        ParseOptions<portrait::GivenPortraitsOptions>(build.config.Load(), build.config.Where() + ", with --images");
    CheckOutputFolder(build.out, datasets::BuildOutput(name), {arguments->images, options.landmark_run});
    const portrait::GivenPortraits made =
        portrait::BuildGivenPortraits(arguments->images, options, build.out, TaskOfProcess());
    fmt::print("{}: {} portraits of {} pictures, {} dropped (pictures.json)\n", build.out.string(), made.num_portraits,
               made.num_pictures, made.dropped.size());
    for (const portrait::DroppedPicture& picture : made.dropped) fmt::print("  {}: {}\n", picture.file, picture.cause);
  };
}

Json CoverageResult(const datasets::Coverage& coverage) {
  return {{"num_basis_faces", coverage.num_basis_faces},
          {"components", coverage.components},
          {"mean_vertex_error_mm", coverage.errors_mm}};
}

Json TwoSampleResult(const datasets::TwoSampleTest& test) {
  return {{"accuracy", test.accuracy},
          {"accuracy_spread", test.accuracy_spread},
          {"accuracy_of_compared", test.first_accuracy},
          {"accuracy_of_these", test.second_accuracy}};
}

Json ComparisonResult(const datasets::LandmarkComparison& comparison) {
  Json result = {{"sample_size", comparison.neutral.sample_size},
                 {"draws", comparison.neutral.num_draws},
                 {"neutral", TwoSampleResult(comparison.neutral)},
                 {"all_expressions", TwoSampleResult(comparison.all_expressions)}};
  if (comparison.neutral_matched && comparison.all_expressions_matched) {
    result["matched_landmarks"] = comparison.matched.size();
    result["neutral_matched"] = TwoSampleResult(*comparison.neutral_matched);
    result["all_expressions_matched"] = TwoSampleResult(*comparison.all_expressions_matched);
  }
  return result;
}

Json LevelsResult(const std::vector<datasets::LevelMeasures>& levels) {
  Json result;
  for (const datasets::LevelMeasures& row : levels) {
    result[fmt::format("level_{}", row.level + 1)] = {{"gamma", row.gamma},
                                                      {"persons", row.num_persons},
                                                      {"displacement_mm", row.displacement_mm},
                                                      {"own_person_by_angle", row.own_by_angle},
                                                      {"own_person_by_distance", row.own_by_distance},
                                                      {"faces", row.num_faces},
                                                      {"faces_flipped", row.num_faces_flipped},
                                                      {"most_flipped_triangles", row.most_flipped},
                                                      {"faces_lips_crossed", row.num_lips_crossed},
                                                      {"lips_crossed_mm", row.lips_crossed_mm},
                                                      {"faces_lids_crossed", row.num_lids_crossed},
                                                      {"lids_crossed_mm", row.lids_crossed_mm}};
  }
  return result;
}

std::function<void()> AddStats(CLI::App& parent) {
  struct Arguments {
    fs::path directory, rebuild, compare;
    std::vector<int> compared_levels;
    bool by_level = false, as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = parent.add_subcommand("stats", "Counts, licences, principal components for 99 % of the variance");
  command->add_option("directory", arguments->directory, "A folder of faces")->required();
  command->add_option(
      "--rebuild", arguments->rebuild,
      "Another folder of faces of the same topology; measures how well the components of the first rebuild it");
  CLI::Option* compare =
      command->add_option("--compare", arguments->compare,
                          "Another folder of faces; measures how often the nearest face by landmarks is of the same "
                          "folder (two-sample test; 0.5: the folders agree)");
  command
      ->add_option("--compare-levels", arguments->compared_levels,
                   "Levels that --compare uses; level 1 has the regular faces (default: all but level 1)")
      ->needs(compare);
  command->add_flag("--by-level", arguments->by_level,
                    "What each level does: displacement, persons recognised, flipped triangles, crossed lips and lids");
  command->add_flag("--json", arguments->as_json, "Print the result as JSON");
  return [arguments] {
    Json result = datasets::FaceStatistics(arguments->directory);
    const faces::FaceDatabase database(arguments->directory, Checksums::kSkip);  // Verified above.
    if (!arguments->rebuild.empty()) {
      const faces::FaceDatabase rebuilt(arguments->rebuild);
      result["rebuilt"] = CoverageResult(datasets::MeasureCoverage(database, rebuilt));
    }
    if (!arguments->compare.empty()) {
      std::vector<int> levels;
      for (const int level : arguments->compared_levels) levels.push_back(level - 1);
      const faces::FaceDatabase compared(arguments->compare);
      result["compared"] = ComparisonResult(datasets::CompareLandmarks(compared, database, levels));
    }
    if (arguments->by_level) result["levels_compared"] = LevelsResult(datasets::MeasureLevels(database));
    PrintResult(result, arguments->as_json);
  };
}

std::function<void()> AddGallery(CLI::App& parent) {
  struct Arguments {
    fs::path faces, sketches, out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = parent.add_subcommand(
      "gallery", "Pictures of a database: identities, expressions, levels, curves, sketches; or of portraits");
  command->add_option("faces", arguments->faces, "A folder of faces, or of portraits")->required();
  command->add_option("sketches", arguments->sketches, "Its folder of sketches");
  command->add_option("-o,--out", arguments->out, "Folder to write")->required();
  return [arguments] {
    const Task task = TaskOfProcess();
    if (ReadManifest(arguments->faces, "").kind == "portraits") {
      if (!arguments->sketches.empty()) throw UsageError("dataset gallery: a folder of portraits has no sketches");
      datasets::CheckPortraitGalleryFolder(arguments->out, {arguments->faces});
      const datasets::PortraitDatabase portraits(arguments->faces);
      MakeDirectory(arguments->out);
      return datasets::WritePortraitGallery(portraits, arguments->out, task);
    }
    datasets::CheckGalleryFolder(arguments->out, {arguments->faces, arguments->sketches});
    const faces::FaceDatabase database(arguments->faces);
    std::optional<datasets::SketchDatabase> sketches;
    if (!arguments->sketches.empty()) sketches.emplace(arguments->sketches);
    MakeDirectory(arguments->out);
    datasets::WriteGallery(database, sketches ? &*sketches : nullptr, arguments->out, task);
  };
}

struct ControlsOptions {
  faces::SourceOptions source;
  std::vector<std::string> own_controls;

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "The face source, used if --template is not a folder.");
    visit("own_controls", own_controls, Text{},
          "Further controls. NAME=FILE.target: a target in the source's vertex numbers. NAME=FROM.obj,TO.obj: two "
          "meshes; value 1 moves FROM to TO.");
  }
};

std::function<void()> AddControls(CLI::App& parent) {
  struct Arguments {
    ConfigArguments config;
    std::string template_name = "makehuman";
    fs::path out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = parent.add_subcommand("controls", "Sheets of the controls of a face, each at five values");
  command->add_option("--template", arguments->template_name,
                      "makehuman, ict (with source.path=...), or a folder of faces, whose template is used");
  command->add_option("-o,--out", arguments->out, "Folder to write")->required();
  AddConfigArguments(*command, arguments->config);
  command->footer("Options:\n" + HelpText<ControlsOptions>());
  return [arguments] {
    const TemplateChoice choice = ChooseTemplate(arguments->template_name);
    Json config = arguments->config.Load();
    if (choice.folder.empty()) config["source"]["name"] = choice.source;
    const auto options = ParseOptions<ControlsOptions>(config, arguments->config.Where());
    CheckOutputFolder(arguments->out, {datasets::kControlSheetsKind}, {choice.folder, options.source.path});
    faces::FaceModel model;
    if (choice.folder.empty())
      model = faces::LoadFaceModel(options.source);
    else
      model.face_template = faces::ReadFaceTemplate(choice.folder);
    const faces::FaceControls controls(
        model.face_template, faces::ReadGivenControls(options.own_controls, model.face_template, model.numbering));
    MakeDirectory(arguments->out);
    std::vector<std::string> files = datasets::ControlSheetNames(controls);
    files.emplace_back("controls.json");
    CheckOwnFiles(arguments->out, files);
    datasets::WriteControlSheets(controls, model.face_template, arguments->out, TaskOfProcess());
  };
}

struct ModelOptions {
  faces::SourceOptions source{.name = "ict"};

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "The face source; it has to give a model, not faces.");
  }
};

std::function<void()> AddModel(CLI::App& parent) {
  auto arguments = std::make_shared<BuildArguments>();
  CLI::App* command = parent.add_subcommand("model", "The face model of a source as weights, of a few megabytes");
  AddConfigArguments(*command, arguments->config);
  command->add_option("-o,--out", arguments->out, "Folder to write, such as weights/face-ict")->required();
  command->footer("Options:\n" + HelpText<ModelOptions>());
  return [arguments] {
    const faces::SourceOptions source =
        ParseOptions<ModelOptions>(arguments->config.Load(), arguments->config.Where()).source;
    CheckReplacedFolder(arguments->out, kWeightsKind, {source.path, source.annotation, source.template_mesh});
    const Json details = faces::WriteFaceModelWeights(arguments->out, faces::LoadFaceModel(source));
    const Json& error_mm = details.at("largest_error_mm");
    fmt::print("weights: {} (largest error: identity {:.4f} mm, expression {:.4f} mm)\n", arguments->out.string(),
               error_mm.at("identity").get<double>(), error_mm.at("expression").get<double>());
  };
}

}  // namespace

Verb DatasetVerb() {
  return {"dataset", "Build faces, sketches, surface points, portraits and pen gestures, look at them, count them",
          [](CLI::App& command) {
            command.require_subcommand(1);
            const std::vector<std::pair<std::string, std::function<void()>>> actions = {
                {"faces",
                 AddBuilder<datasets::FacesOptions>(command, "faces", "A database of faces", datasets::BuildFaces)},
                {"sketches", AddBuilder<datasets::SketchesOptions>(
                                 command, "sketches", "A sketch of every face of a database", datasets::BuildSketches)},
                {"points", AddBuilder<datasets::PointsOptions>(
                               command, "points", "Points on the surface of every face of a database, and attributes",
                               datasets::BuildPoints)},
                {"portraits", AddPortraits(command)},
                {"gestures", AddBuilder<datasets::GesturesOptions>(
                                 command, "gestures", "Pen gestures of one stroke, and strokes that are none",
                                 datasets::BuildGestures)},
                {"model", AddModel(command)},
                {"stats", AddStats(command)},
                {"gallery", AddGallery(command)},
                {"controls", AddControls(command)}};
            return [&command, actions] {
              for (const auto& [name, run] : actions) {
                if (command.got_subcommand(name)) run();
              }
            };
          }};
}

}  // namespace daumier::cli
