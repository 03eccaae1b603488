#include "cli/head_arguments.h"

#include "core/error.h"
#include "core/log.h"
#include "core/process_task.h"
#include "rig/clip_files.h"
#include "rig/decimated_head.h"
#include "rig/demo_clip.h"
#include "rig/visemes.h"
#include "rig/weight_limits.h"

#include <algorithm>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kFramesPerSecond = 60;

rig::NamePreset PresetNamed(const std::string& name) {
  return std::ranges::find(rig::kNamePresets, name, &rig::NamedPreset::name)->preset;
}

void AddMixedTargets(std::span<const rig::Viseme> mixed, rig::MorphTargets& targets) {
  const rig::MorphTargets added = rig::MixedTargets(targets, mixed);
  targets.names.insert(targets.names.end(), added.names.begin(), added.names.end());
  targets.offsets.conservativeResize(Eigen::NoChange, std::ssize(targets.names));
  targets.offsets.rightCols(added.num_targets()) = added.offsets;
}

/// Of the file: head, eyes, hair.
Eigen::Index AllTriangles(const rig::RiggedHead& head) {
  Eigen::Index count = rig::NumTriangles(head);
  for (const rig::HeadAttachment& attachment : head.attachments) count += attachment.mesh.triangles.rows();
  return count;
}

Json SizesOf(const RigFiles& files) {
  Json sizes = Json::object();
  for (const auto& file :
       {std::optional(files.head), std::optional(files.sheet), files.compressed, files.vrm, files.print})
    if (file) sizes[file->string()] = fs::file_size(*file);
  return sizes;
}

}  // namespace

void AddHeadArguments(CLI::App& command, HeadArguments& arguments) {
  arguments.command = &command;
  command
      .add_option("-o,--out", arguments.out, "NAME.glb. A picture NAME.png of some expressions is written next to it")
      ->required();
  command
      .add_option("--animate", arguments.clip,
                  "Recording that becomes the head's animation, at 60 frames a second: CSV of Live Link Face, JSON "
                  "of MediaPipe's FaceLandmarker, or a CSV whose columns are named as targets. Without it the "
                  "head shows what it can do, for five seconds")
      ->check(CLI::ExistingFile);
  command.add_option("--frames", arguments.frames, "Folder for a PNG of each frame of the animation");
  command.add_option("--frame-size", arguments.frame_size, "Pixels a side of a frame")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command
      .add_option("--names", arguments.names,
                  "Names and order of the targets: arkit (eyeBlinkLeft), arkit_lr (eyeBlink_L), unreal "
                  "(EyeBlinkLeft), mediapipe (`_neutral` first, then MediaPipe's order), rpm (visemes and the other "
                  "targets, nodes and materials of Ready Player Me) or vrm (as arkit, with an avatar NAME.vrm)")
      ->check(CLI::IsMember([] {
        std::vector<std::string> words;
        for (const rig::NamedPreset& preset : rig::kNamePresets) words.emplace_back(preset.name);
        return words;
      }()))
      ->capture_default_str();
  command.add_flag("--visemes", arguments.visemes, "Add 15 targets of speech: viseme_sil, viseme_PP, ...");
  command.add_flag("--normals", arguments.normals, "Targets change normals as well: exact shading, twice the size");
  command.add_flag("--compress", arguments.compress,
                   "Write a small copy NAME_compressed.glb as well, for readers of EXT_meshopt_compression "
                   "(three.js, Babylon.js, model-viewer)");
  command.add_flag("--vrm", arguments.vrm, "Write an avatar NAME.vrm (VRM 1.0) as well");
  AddHeadExtras(command, arguments.extras);
  command.add_flag("--force", arguments.force,
                   "Overwrite any existing file; heads that `rig` wrote are overwritten without this flag");
  command.add_flag("--json", arguments.as_json, "Print the result as JSON");
}

RigFiles CheckedHeadFiles(const HeadArguments& arguments, const std::vector<fs::path>& inputs) {
  if (arguments.frames.empty() && arguments.command != nullptr && arguments.command->count("--frame-size") > 0)
    throw UsageError("--frame-size: no frames are written. Add --frames FOLDER, or leave --frame-size out");
  RigFiles files =
      RigFilesOf(arguments.out, arguments.compress ? AlsoCompressed::kYes : AlsoCompressed::kNo,
                 arguments.vrm || PresetNamed(arguments.names) == rig::NamePreset::kVrm ? AlsoVrm::kYes : AlsoVrm::kNo,
                 arguments.frames);
  files.print = PrintFileOf(arguments.extras, files.head);
  PrintPoseOf(arguments.extras);  // Its errors come before work begins.
  std::vector<fs::path> all = inputs;
  all.push_back(arguments.clip);
  CheckRigFiles(files, all, arguments.force);
  return files;
}

std::optional<rig::WeightsClip> ReadHeadClip(const HeadArguments& arguments) {
  if (arguments.clip.empty()) return std::nullopt;
  const rig::Recording recording = rig::ReadClip(arguments.clip);
  for (const std::string& warning : recording.warnings) log::Warn("{}: {}", arguments.clip.string(), warning);
  rig::WeightsClip clip = rig::Resample(recording, kFramesPerSecond);
  rig::LimitWeights(clip);
  return clip;
}

Json WriteHeadFiles(const HeadArguments& arguments, const RigFiles& files, const std::optional<rig::WeightsClip>& clip,
                    RigContent content) {
  Json extras = Json::object();
  if (files.print) extras["print"] = WritePrint(*files.print, content.head, PrintPoseOf(arguments.extras));
  if (arguments.extras.triangles) extras["decimated"] = ReduceTriangles(arguments.extras, content.head);
  const bool is_rpm = PresetNamed(arguments.names) == rig::NamePreset::kReadyPlayerMe;
  if (arguments.visemes || is_rpm) AddMixedTargets(rig::Visemes(), content.head.targets);
  if (is_rpm) AddMixedTargets(rig::ReadyPlayerMeExtras(), content.head.targets);
  content.clip = clip ? *clip : rig::DemoClip(content.head.targets.names);  // Which shows what a head can do.
  WriteRigFiles(
      files, content,
      {.names = PresetNamed(arguments.names), .normals = arguments.normals, .frame_size = arguments.frame_size},
      TaskOfProcess());
  Json result = {{"head", files.head.string()}, {"sheet", files.sheet.string()}};
  if (files.compressed) result["compressed"] = files.compressed->string();
  if (files.vrm) result["vrm"] = files.vrm->string();
  if (files.frames) result["frames"] = files.frames->string();
  result["source"] = content.head.source;
  result["vertices"] = content.head.mesh.vertices.rows();
  result["triangles"] = AllTriangles(content.head);
  result["targets"] = content.head.targets.num_targets();
  result["clip_frames"] = content.clip.num_frames();
  result.update(extras);
  result["bytes"] = SizesOf(files);
  return result;
}

}  // namespace daumier::cli
