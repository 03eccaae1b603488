#include "cli/rig_map.h"

#include "cli/rig_foreign.h"
#include "cli/weights_output.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/options.h"
#include "core/stopwatch.h"
#include "core/weights_folder.h"
#include "faces/source.h"
#include "rig/coefficient_file.h"
#include "rig/expression_map_file.h"
#include "rig/expression_targets.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct MapOptions {
  faces::SourceOptions source;

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "The face model that is mapped.");
  }
};

bool IsMapFile(const fs::path& file) {
  return file.extension() == ".json" && fs::is_regular_file(file);
}

/// Where the model is and what it is, by `model` and the options.
faces::SourceOptions SourceOfModel(const fs::path& model, const ConfigArguments& config) {
  const Json given = config.Load();
  faces::SourceOptions source = ParseOptions<MapOptions>(given, config.Where()).source;
  const bool is_named = given.contains("source") && given.at("source").contains("name");
  const std::vector<std::string> names = faces::SourceNames();
  if (!fs::exists(model) && std::ranges::find(names, model.string()) != names.end()) {
    source.name = model.string();
    return source;
  }
  if (!fs::exists(model))
    throw UsageError(
        fmt::format("--map: there is no {} (expected the file or folder of a face model, a map that this "
                    "command wrote, or makehuman)",
                    model.string()));
  source.path = model.string();
  if (is_named) return source;
  const auto recognised = faces::RecognisedSource(model);
  if (!recognised)
    throw UsageError(fmt::format("--map {}: the face model is not recognised. Name it with source.name={}",
                                 model.string(), fmt::join(names, "|")));
  source.name = *recognised;
  return source;
}

bool IsSameTopology(const faces::FaceTemplate& a, const faces::FaceTemplate& b) {
  return a.num_vertices() == b.num_vertices() && a.triangles == b.triangles;
}

/// The 52 targets on the mean face of a model, and how they came there.
struct TargetsOfModel {
  rig::MorphTargets targets;
  Json facts = Json::object();
};

TargetsOfModel TargetsOn(const faces::FaceTemplate& face, const faces::FaceModel& source) {
  if (IsSameTopology(face, source.face_template)) return {rig::ExpressionTargets(source).On(face.neutral)};
  CarriedTargets carried = CarryTargetsTo(face, source);
  return {std::move(carried.targets), {{"registration", std::move(carried.registration)}}};
}

rig::ExpressionMap MapOfModel(const rig::ModelExpressions& model, Json& facts) {
  const faces::FaceModel source = ModelForForeignHeads(std::nullopt);
  TargetsOfModel of_model = TargetsOn(model.face_template, source);
  facts = std::move(of_model.facts);
  rig::ExpressionMap map = rig::MapExpressions(model, of_model.targets);
  map.targets = source.face_template.provenance;
  return map;
}

/// Over all ends of expressions that move the face.
Json SummaryOf(const rig::ExpressionMap& map) {
  double error = 0, motion = 0, sum_rms = 0, sum_motion = 0, worst = -1;
  int count = 0;
  std::string worst_name;
  for (const rig::MappedExpression& mapped : map.mapped) {
    if (!mapped.explained()) continue;
    ++count;
    error += std::pow(mapped.error.rms_cm, 2);
    motion += std::pow(mapped.no_motion.rms_cm, 2);
    sum_rms += map.mm_per_cm * mapped.error.rms_cm;
    sum_motion += map.mm_per_cm * mapped.no_motion.rms_cm;
    if (mapped.error.rms_cm <= worst) continue;
    worst = mapped.error.rms_cm;
    worst_name = mapped.name + (mapped.is_negative ? " (negative)" : "");
  }
  if (count == 0) return {{"expressions", 0}};
  return {{"expressions", count},
          {"rms_mm", sum_rms / count},
          {"no_motion_rms_mm", sum_motion / count},
          {"explained", 1 - error / motion},
          {"worst", worst_name},
          {"worst_rms_mm", map.mm_per_cm * worst}};
}

std::string ProvenanceText(const Json& provenance) {
  return fmt::format("{}, {}; {}", provenance.value("name", "unknown"), provenance.value("version", "unknown version"),
                     provenance.value("licence", "unknown licence"));
}

rig::CoefficientFrames ReadFrames(const fs::path& file, const rig::ExpressionMap& map) {
  rig::CoefficientFrames frames = rig::ReadCoefficients(file, map);
  for (const std::string& warning : frames.warnings) log::Warn("{}: {}", file.string(), warning);
  return frames;
}

void WriteWeightsOf(const rig::ExpressionMap& map, const rig::CoefficientFrames& frames, double frames_per_second,
                    const fs::path& out) {
  const Eigen::Index num_frames = frames.coefficients.rows();
  WriteWeights(out, {.weights = rig::WeightsOf(map, frames.coefficients),
                     .seconds = frames.seconds.empty() ? EvenSeconds(num_frames, frames_per_second) : frames.seconds,
                     .remarks = {"model: " + ProvenanceText(map.model), "targets: " + ProvenanceText(map.targets)}});
}

void CheckOptions(const MapArguments& arguments) {
  const auto is_given = [&](const char* option) { return arguments.command->count(option) > 0; };
  const bool makes_weights = is_given("--map") || is_given("--meshes");
  if (!makes_weights && is_given("--fps")) throw UsageError("--fps is an option of --meshes and of --map with --apply");
  if (!makes_weights) return;
  if (is_given("--map") && !is_given("--apply") && is_given("--fps"))
    throw UsageError("--fps: a map has no frames. Add --apply FILE, or leave --fps out");
  for (const char* of_heads : {"--animate", "--frames", "--frame-size", "--names", "--visemes", "--normals",
                               "--compress", "--vrm", "--texture", "--hair", "--hair-colour", "--triangles", "--print",
                               "--print-pose", "--cut", "--keep-expression", "--from"})
    if (is_given(of_heads))
      throw UsageError(fmt::format("{}: {} makes weights and no head. Leave {} out", of_heads,
                                   is_given("--map") ? "--map" : "--meshes", of_heads));
  if (is_given("--map") && is_given("--landmarks"))
    throw UsageError("--landmarks: --map takes the landmarks of source.annotation. Leave --landmarks out");
}

}  // namespace

void AddMapArguments(CLI::App& command, MapArguments& arguments) {
  CLI::Option* const map = command.add_option(
      "--map", arguments.model,
      "Instead of a head, write the linear map from a face model's expression coefficients to the 52 weights (--out "
      "NAME.json). MODEL: the file or folder of FLAME, BFM, FaceWarehouse or another source (docs/importers.md; "
      "source.name=..., source.annotation=...), makehuman, or, for --apply, such a map");
  CLI::Option* const apply =
      command
          .add_option("--apply", arguments.coefficients,
                      "With --map: coefficients over time (CSV, JSON or .npy: a row a frame), which become weights for "
                      "--animate (--out NAME.csv)")
          ->check(CLI::ExistingFile)
          ->needs(map);
  command
      .add_flag(
          "--keep-strength", arguments.keeps_strength,
          "With --apply: each expression times the gain, 1 to 2.5, that the map states: least squares keep weights "
          "small where a target moves a wider region than the expression")
      ->needs(apply);
  CLI::Option* const meshes = command.add_option(
      "--meshes", arguments.meshes,
      "Instead of a head, write the weights that bring FACE, the neutral mesh of a person, nearest to these meshes of "
      "the same person and topology, in the order of the command line, for --animate (--out NAME.csv)");
  command
      .add_flag("--gaze", arguments.has_gaze,
                "With --meshes: lids also give eyeLook*, which turn the eyes; for meshes whose lids are exact")
      ->needs(meshes);
  command
      .add_option("--fps", arguments.frames_per_second,
                  "Frames a second of --meshes, and of --apply where the file states no times")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  meshes->excludes(map);
  arguments.command = &command;
}

void TakeOverrides(MapArguments& arguments, fs::path& face, ConfigArguments& config) {
  CheckOptions(arguments);
  const auto is_option = [](const fs::path& word) {
    return word.string().find('=') != std::string::npos && !fs::exists(word);
  };
  for (const fs::path& word : arguments.meshes)
    if (is_option(word)) config.overrides.push_back(word.string());
  if (std::erase_if(arguments.meshes, is_option) > 0 && arguments.meshes.empty())
    throw UsageError("--meshes names no mesh");
  if (arguments.model.empty()) {
    if (face.empty()) throw UsageError("FACE is required, except with --map (see `daumier rig --help`)");
    return;
  }
  if (is_option(face)) config.overrides.insert(config.overrides.begin(), face.string());
  if (!face.empty() && !is_option(face))
    throw UsageError(fmt::format("{}: --map takes no FACE. Leave it out", face.string()));
  face.clear();
}

void MapFaceModel(const MapArguments& arguments, const ConfigArguments& config, const MapOutput& output) {
  const Stopwatch watch;
  const bool applies = !arguments.coefficients.empty();
  const bool is_map = IsMapFile(arguments.model);
  if (is_map && !applies)
    throw UsageError(
        fmt::format("--map {}: is a map already. Name coefficients with --apply", arguments.model.string()));
  applies ? CheckWeightsFile(output, {arguments.model, arguments.coefficients})
          : CheckMapFile(output, {arguments.model});

  rig::ExpressionMap map;
  std::optional<rig::ModelExpressions> model;
  if (is_map && !config.overrides.empty())
    throw UsageError(fmt::format("{}: has no effect, {} is a map already and has its model in it. Leave it out",
                                 config.overrides.front(), arguments.model.string()));
  if (is_map) {
    map = rig::ParseExpressionMap(ReadJson(arguments.model), arguments.model.string());
  } else {
    model = rig::ExpressionsOf(faces::LoadSource(SourceOfModel(arguments.model, config)));
    map.expressions = model->names;
    map.constant = model->constant;
  }
  std::optional<rig::CoefficientFrames> frames;  // Before the model is registered, which takes long.
  if (applies) frames = ReadFrames(arguments.coefficients, map);
  if (frames && !frames->seconds.empty() && arguments.command->count("--fps") > 0)
    log::Warn("--fps: has no effect, {} states the times of its frames", arguments.coefficients.string());
  Json facts = Json::object();
  if (model) map = MapOfModel(*model, facts);

  Json result = {{"model", ProvenanceText(map.model)}};
  if (model) result["errors"] = SummaryOf(map);
  if (frames) {
    WriteWeightsOf(arguments.keeps_strength ? rig::WithKeptStrength(map) : map, *frames, arguments.frames_per_second,
                   output.out);
    result["weights"] = output.out.string();
    result["frames"] = frames->coefficients.rows();
  } else {
    Json file = rig::ExpressionMapJson(map);
    file.update(facts);
    WriteFileAtomically(output.out, file.dump(1) + "\n");
    result["map"] = output.out.string();
  }
  result.update(facts);
  result["seconds"] = watch.seconds();
  PrintResult(result, output.as_json);
}

}  // namespace daumier::cli
