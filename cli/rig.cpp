#include "cli/head_arguments.h"
#include "cli/head_hair.h"
#include "cli/rig_face.h"
#include "cli/rig_foreign.h"
#include "cli/rig_from.h"
#include "cli/rig_map.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/options.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "render/draw.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"

#include <memory>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct RigArguments {
  fs::path face, texture, landmarks;
  bool keep_expression = false, cut = false;
  HairArguments hair;
  HeadArguments head;
  MapArguments map;
  FromArguments from;
  ConfigArguments config;
};

/// What key=value may set.
struct RigOptions {
  faces::SourceOptions source;

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "The face model of the topology.");
  }
};

std::optional<faces::SourceOptions> SourceOf(const RigArguments& arguments) {
  const Json config = arguments.config.Load();
  const auto options = ParseOptions<RigOptions>(config, arguments.config.Where());
  if (!config.contains("source")) return std::nullopt;
  return options.source;
}

std::shared_ptr<const render::Image> TextureOf(const fs::path& file) {
  if (file.empty()) return nullptr;
  return std::make_shared<const render::Image>(render::ToRgb(render::ReadImage(file)));
}

rig::RiggedHead HeadOf(const FaceToRig& face) {
  std::optional<rig::ExpressionTargets> expressions;
  std::optional<rig::HeadRig> head_rig;
  OnAllCores(2, [&](int64_t part) {
    if (part == 0) expressions.emplace(face.model);
    if (part == 1) head_rig.emplace(face.model.face_template);
  });
  for (const std::string& warning : expressions->warnings()) log::Warn("{}", warning);
  return head_rig->On(face.neutral, expressions->On(face.neutral));
}

void WarnOfKeptExpression(const std::string& face) {
  log::Warn(
      "--keep-expression: has no effect. {} is no face whose expression `daumier predict` states: its shape is taken "
      "as "
      "neutral, as it is",
      face);
}

void Rig(const RigArguments& arguments) {
  const Stopwatch watch;
  const std::optional<faces::SourceOptions> source = SourceOf(arguments);
  const RigFiles files = CheckedHeadFiles(arguments.head, {arguments.face, arguments.texture, arguments.landmarks});
  const std::optional<rig::WeightsClip> clip = ReadHeadClip(arguments.head);
  const std::optional<faces::Looks> hair = HairLooks(arguments.hair);
  RigContent content{.head = {}, .texture = TextureOf(arguments.texture), .clip = {}};
  const GivenFace given = ReadGivenFace(arguments.face);
  const auto shown = arguments.keep_expression ? ShownExpression::kKept : ShownExpression::kRemoved;
  Json facts = Json::object();
  if (const auto face = arguments.landmarks.empty() ? ReadFaceToRig(given, source, shown) : std::nullopt) {
    for (const std::string& remark : face->remarks) log::Info("{}: {}", face->name, remark);
    if (arguments.keep_expression && !face->states_expression) WarnOfKeptExpression(face->name);
    if (arguments.cut) log::Warn("--cut: the lips and lids of {} are not sealed: nothing was cut", face->name);
    content.head = HeadOf(*face);
    if (hair) AddHair(face->model.face_template, face->neutral, *hair, content.head);
  } else {
    if (content.texture && !given.mesh.has_uv())
      throw UsageError(
          fmt::format("--texture {}: {} has no UV, which a texture needs. Export the mesh with UV, or leave it out",
                      arguments.texture.string(), given.file.string()));
    if (arguments.keep_expression) WarnOfKeptExpression(given.file.string());
    const faces::FaceModel model = ModelForForeignHeads(source);
    RiggedForeignHead foreign =
        RigForeignHead(given, arguments.landmarks, model, content.texture ? TakenLook::kNone : TakenLook::kOwn,
                       arguments.cut ? SealedSlits::kCut : SealedSlits::kKept);
    content.head = std::move(foreign.head);
    if (hair) AddHair(model.face_template, foreign.registered, *hair, content.head);
    content.stages = std::move(foreign.stages);
    facts = std::move(foreign.facts);
  }
  Json result = WriteHeadFiles(arguments.head, files, clip, std::move(content));
  result.update(facts);
  result["seconds"] = watch.seconds();
  PrintResult(result, arguments.head.as_json);
}

/// A head from one that another program has edited.
void RigFrom(RigArguments& arguments) {
  const Stopwatch watch;
  const RigFiles files = CheckedHeadFiles(arguments.head, {arguments.face, arguments.from.head});
  const std::optional<rig::WeightsClip> clip = ReadHeadClip(arguments.head);
  EditedRig edited = RigEdited(ReadGivenFace(arguments.face), arguments.from, arguments.head);
  Json result = WriteHeadFiles(arguments.head, files, clip, std::move(edited.content));
  result.update(edited.facts);
  result["seconds"] = watch.seconds();
  PrintResult(result, arguments.head.as_json);
}

/// Makes a head, or weights for one.
void RigOrMap(RigArguments& arguments) {
  TakeOverrides(arguments.map, arguments.face, arguments.config);
  const MapOutput output{arguments.head.out, arguments.head.force, arguments.head.as_json};
  if (!arguments.map.model.empty()) {
    MapFaceModel(arguments.map, arguments.config, output);
  } else if (!arguments.map.meshes.empty()) {
    WeighMeshes(arguments.map, arguments.face, arguments.landmarks, SourceOf(arguments), output);
  } else if (!arguments.from.head.empty()) {
    RigFrom(arguments);
  } else {
    Rig(arguments);
  }
}

}  // namespace

Verb RigVerb() {
  return {
      "rig", "A face to a head with eyes, teeth and 52 expressions that games and web pages animate (.glb)",
      [](CLI::App& command) {
        auto arguments = std::make_shared<RigArguments>();
        command
            .add_option("face", arguments->face,
                        "Head mesh of any topology (.obj, .ply), in any unit and with any axes; a face that `daumier "
                        "predict` wrote from a drawing or a portrait (predicted/drawing.obj, or predicted/drawing); or "
                        "FOLDER/NAME of a face in a database (faces/face-00012, faces/person-00003-level-1-neutral)")
            ->required(false);  // Required except with --map (TakeOverrides).
        command.add_option(
            "overrides", arguments->config.overrides,
            "source.KEY=value: the face model of the mesh's topology, or whose expressions a mesh of another "
            "topology gets. Without it the shipped face model or MakeHuman's, by the number of vertices");
        AddHairArguments(command, HairFrom::kName, arguments->hair);
        AddHeadArguments(command, arguments->head);
        command
            .add_option("--texture", arguments->texture,
                        "Picture of the head's atlas (PNG, JPEG); without it materials have plain colours")
            ->check(CLI::ExistingFile);
        command
            .add_option("--landmarks", arguments->landmarks,
                        "68 landmarks of a mesh of another topology than a face model's, in iBUG order: a file of "
                        "vertices (0-based) or of points, in the forms that `daumier register` reads. Without it they "
                        "are found in pictures of the mesh")
            ->check(CLI::ExistingFile);
        command.add_flag("--keep-expression", arguments->keep_expression,
                         "Rig a predicted portrait with the expression that it shows; without it the expression is "
                         "removed");
        AddFromArguments(command, arguments->from);
        command.add_flag(
            "--cut", arguments->cut,
            "Open the sealed lips of a mesh of another topology (a scan, a sculpture) along their line, and "
            "the sealed lids of closed eyes. The mesh's vertices keep their numbers, new ones follow");
        AddMapArguments(command, arguments->map);
        command.footer("Options:\n" + HelpText<RigOptions>());
        return [arguments] { RigOrMap(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
