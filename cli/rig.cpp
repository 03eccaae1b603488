#include "cli/rig_face.h"
#include "cli/rig_files.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/options.h"
#include "core/process_task.h"
#include "core/stopwatch.h"
#include "render/draw.h"
#include "rig/clip_files.h"
#include "rig/demo_clip.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "rig/visemes.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kFramesPerSecond = 60;

struct RigArguments {
  fs::path face, out, texture, clip, frames;
  std::string names = "arkit";
  bool compress = false, vrm = false, normals = false, visemes = false, keep_expression = false, force = false,
       as_json = false;
  int frame_size = 512;
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

rig::NamePreset PresetNamed(const std::string& name) {
  return std::ranges::find(rig::kNamePresets, name, &rig::NamedPreset::name)->preset;
}

rig::MorphTargets WithVisemes(const rig::MorphTargets& expressions) {
  const rig::MorphTargets visemes = rig::VisemeTargets(expressions);
  rig::MorphTargets all = expressions;
  all.names.insert(all.names.end(), visemes.names.begin(), visemes.names.end());
  all.offsets.conservativeResize(Eigen::NoChange, std::ssize(all.names));
  all.offsets.rightCols(visemes.num_targets()) = visemes.offsets;
  return all;
}

std::shared_ptr<const render::Image> TextureOf(const fs::path& file) {
  if (file.empty()) return nullptr;
  return std::make_shared<const render::Image>(render::ToRgb(render::ReadImage(file)));
}

/// The clip of the file; nothing without one.
std::optional<rig::WeightsClip> ClipOf(const fs::path& file) {
  if (file.empty()) return std::nullopt;
  const rig::Recording recording = rig::ReadClip(file);
  for (const std::string& warning : recording.warnings) log::Warn("{}: {}", file.string(), warning);
  return rig::Resample(recording, kFramesPerSecond);
}

Json SizesOf(const RigFiles& files) {
  Json sizes = Json::object();
  for (const auto& file : {std::optional(files.head), std::optional(files.sheet), files.compressed, files.vrm})
    if (file) sizes[file->string()] = fs::file_size(*file);
  return sizes;
}

void Rig(const RigArguments& arguments) {
  const Stopwatch watch;
  const std::optional<faces::SourceOptions> source = SourceOf(arguments);
  const RigFiles files = RigFilesOf(arguments.out, arguments.compress ? AlsoCompressed::kYes : AlsoCompressed::kNo,
                                    arguments.vrm ? AlsoVrm::kYes : AlsoVrm::kNo, arguments.frames);
  CheckRigFiles(files, {arguments.face, arguments.texture, arguments.clip}, arguments.force);
  RigContent content{.head = {}, .texture = TextureOf(arguments.texture), .clip = {}};
  const std::optional<rig::WeightsClip> clip = ClipOf(arguments.clip);
  const FaceToRig face = ReadFaceToRig(arguments.face, source,
                                       arguments.keep_expression ? ShownExpression::kKept : ShownExpression::kRemoved);
  for (const std::string& remark : face.remarks) log::Info("{}: {}", face.name, remark);
  const rig::ExpressionTargets expressions(face.model);
  for (const std::string& warning : expressions.warnings()) log::Warn("{}", warning);
  content.head = rig::HeadRig(face.model.face_template).On(face.neutral, expressions.On(face.neutral));
  if (arguments.visemes) content.head.targets = WithVisemes(content.head.targets);
  content.clip = clip ? *clip : rig::DemoClip(content.head.targets.names);  // Which shows what a head can do.
  WriteRigFiles(
      files, content,
      {.names = PresetNamed(arguments.names), .normals = arguments.normals, .frame_size = arguments.frame_size},
      TaskOfProcess());

  Json result = {{"head", files.head.string()}, {"sheet", files.sheet.string()}};
  if (files.compressed) result["compressed"] = files.compressed->string();
  if (files.vrm) result["vrm"] = files.vrm->string();
  if (files.frames) result["frames"] = files.frames->string();
  result["source"] = face.model.face_template.source;
  result["vertices"] = content.head.mesh.vertices.rows();
  result["triangles"] = content.head.mesh.triangles.rows();
  result["targets"] = content.head.targets.num_targets();
  result["clip_frames"] = content.clip.num_frames();
  result["bytes"] = SizesOf(files);
  result["seconds"] = watch.seconds();
  PrintResult(result, arguments.as_json);
}

}  // namespace

Verb RigVerb() {
  return {
      "rig", "A face to a head with eyes, teeth and 52 expressions that games and web pages animate (.glb)",
      [](CLI::App& command) {
        auto arguments = std::make_shared<RigArguments>();
        command
            .add_option("face", arguments->face,
                        "Mesh (.obj, .ply) of a topology of a face model, such as `daumier predict` writes from a "
                        "drawing or a portrait (predicted/drawing.obj, or predicted/drawing); or FOLDER/NAME of a face "
                        "in a database (faces/face-00012, faces/person-00003-level-1-neutral)")
            ->required();
        command.add_option("overrides", arguments->config.overrides,
                           "source.KEY=value: the face model of the mesh's topology. Without it the shipped face model "
                           "or MakeHuman's, by the number of vertices");
        command
            .add_option("-o,--out", arguments->out,
                        "NAME.glb. A picture NAME.png of some expressions is written next to it")
            ->required();
        command
            .add_option("--texture", arguments->texture,
                        "Picture of the head's atlas (PNG, JPEG); without it materials have plain colours")
            ->check(CLI::ExistingFile);
        command
            .add_option(
                "--animate", arguments->clip,
                "Recording that becomes the head's animation, at 60 frames a second: CSV of Live Link Face, JSON "
                "of MediaPipe's FaceLandmarker, or a CSV whose columns are named as targets. Without it the "
                "head shows what it can do, for five seconds")
            ->check(CLI::ExistingFile);
        command.add_option("--frames", arguments->frames, "Folder for a PNG of each frame of the animation");
        command.add_option("--frame-size", arguments->frame_size, "Pixels a side of a frame")
            ->check(CLI::Range(16, 4096))
            ->capture_default_str();
        command
            .add_option("--names", arguments->names,
                        "Names and order of the targets: arkit (eyeBlinkLeft), arkit_lr (eyeBlink_L), unreal "
                        "(EyeBlinkLeft) or mediapipe (`_neutral` first, then MediaPipe's order)")
            ->check(CLI::IsMember([] {
              std::vector<std::string> words;
              for (const rig::NamedPreset& preset : rig::kNamePresets) words.emplace_back(preset.name);
              return words;
            }()))
            ->capture_default_str();
        command.add_flag("--visemes", arguments->visemes, "Add 15 targets of speech: viseme_sil, viseme_PP, ...");
        command.add_flag("--normals", arguments->normals,
                         "Targets change normals as well: exact shading, twice the size");
        command.add_flag("--compress", arguments->compress,
                         "Write a small copy NAME_compressed.glb as well, for readers of EXT_meshopt_compression "
                         "(three.js, Babylon.js, model-viewer)");
        command.add_flag("--vrm", arguments->vrm, "Write an avatar NAME.vrm (VRM 1.0) as well");
        command.add_flag("--keep-expression", arguments->keep_expression,
                         "Rig a predicted portrait with the expression that it shows; without it the expression is "
                         "removed");
        command.add_flag("--force", arguments->force,
                         "Overwrite any existing file; heads that `rig` wrote are overwritten without this flag");
        command.add_flag("--json", arguments->as_json, "Print the result as JSON");
        command.footer("Options:\n" + HelpText<RigOptions>());
        return [arguments] { Rig(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
