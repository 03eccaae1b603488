#include "cli/rig_files.h"

#include "cli/head_extras.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "core/output_place.h"
#include "core/parallel.h"
#include "core/staged_directory.h"
#include "gltf/head_file.h"
#include "reports/rigged_head.h"

#include <cstring>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFramesKind = "frames";

/// Whether this program wrote the file: the generator that a .glb or .vrm states.
bool IsOwnHead(const fs::path& file) {
  constexpr size_t kChunkAt = 20;  // Behind the file's header and the chunk's.
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  const MappedFile mapped(file);
  const std::string_view bytes = mapped.bytes();
  if (bytes.size() < kChunkAt || !bytes.starts_with("glTF")) return false;
  uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  if (length > bytes.size() - kChunkAt) return false;
  const auto document = TryParseJson(bytes.substr(kChunkAt, length));
  const Json::json_pointer generator("/asset/generator");
  return document && document->is_object() && document->contains(generator) && document->at(generator).is_string() &&
         document->at(generator).get_ref<const std::string&>().starts_with("Daumier ");
}

ExistingFile MayReplace(bool may) {
  return may ? ExistingFile::kReplaced : ExistingFile::kKept;
}

/// Names the reason for which an input cannot be the sheet, which has no option of its own.
void CheckSheet(const RigFiles& files, const std::vector<fs::path>& inputs) {
  std::error_code ignored;
  for (const fs::path& input : inputs)
    if (fs::equivalent(input, files.sheet, ignored))
      throw UsageError(
          fmt::format("--out {}: the picture of expressions next to it is {}, which is an input and would be "
                      "overwritten. Name another .glb, or another folder",
                      files.head.string(), files.sheet.string()));
}

std::string FrameName(int frame) {
  return fmt::format("frame_{:05}.png", frame + 1);
}

/// A picture of every frame of the clip, and a manifest.
void WriteFrames(const fs::path& folder, const RigContent& content, int size, const Task& task) {
  const reports::RiggedHeadPictures pictures(content.head, content.texture);
  const std::vector<rig::HeadPose> poses = rig::PosesOf(content.clip, content.head.targets.names);
  const int num_frames = static_cast<int>(poses.size());
  StagedDirectory staged(folder, kFramesKind);
  Manifest manifest{.kind = kFramesKind, .verb = "rig"};
  manifest.counts = {{"frames", num_frames}};
  manifest.details = {{"frames_per_second", content.clip.frames_per_second}};
  const Task frames = task.Stage("frames");
  int num_done = 0;
  frames.Report(0, num_frames, "frames");
  ForEachInOrder(
      num_frames,
      [&](int frame) {
        frames.ThrowIfCancelled("stopped; no frame was written to {}", folder.string());
        return render::EncodeImage(pictures.Draw(poses[size_t(frame)], size, 0, {.supersampling = 2}),
                                   render::ImageFormat::kPng);
      },
      [&](const std::string& bytes) {
        const std::string name = FrameName(num_done);
        WriteFileAtomically(staged.path() / name, bytes);
        manifest.checksums[name] = Sha256(bytes);
        frames.Report(++num_done, num_frames, "frames");
      });
  WriteManifest(staged.path(), manifest);
  staged.Commit();
}

/// Stages, if there are any, over expressions.
render::Image SheetOf(const RigContent& content) {
  render::Image expressions = reports::RiggedHeadSheet(content.head, content.texture);
  if (content.stages.empty()) return expressions;
  render::Image stages = render::MakeSheet(content.stages, int(content.stages.size()));
  return render::MakeSheet({{std::move(stages)}, {std::move(expressions)}}, 1, {.gap = 0});
}

}  // namespace

RigFiles RigFilesOf(const fs::path& out, AlsoCompressed compressed, AlsoVrm vrm, const fs::path& frames) {
  if (out.extension() != ".glb")
    throw UsageError(fmt::format("--out {}: expected a name that ends in .glb", out.string()));
  const auto next_to = [&](const char* ending) { return out.parent_path() / (out.stem().string() + ending); };
  RigFiles files{.head = out, .sheet = next_to(".png")};
  if (compressed == AlsoCompressed::kYes) files.compressed = next_to("_compressed.glb");
  if (vrm == AlsoVrm::kYes) files.vrm = next_to(".vrm");
  if (!frames.empty()) files.frames = frames;
  return files;
}

void CheckRigFiles(const RigFiles& files, const std::vector<fs::path>& inputs, bool replaces_all) {
  const bool is_own = IsOwnHead(files.head);
  CheckOutputFile(files.head, MayReplace(replaces_all || is_own), inputs);
  CheckSheet(files, inputs);
  CheckOutputFile(files.sheet, MayReplace(replaces_all || is_own), inputs);
  for (const auto& copy : {files.compressed, files.vrm})
    if (copy) CheckOutputFile(*copy, MayReplace(replaces_all || IsOwnHead(*copy)), inputs);
  if (files.print) CheckOutputFile(*files.print, MayReplace(replaces_all || IsOwnPrint(*files.print)), inputs);
  if (files.frames) CheckReplacedFolder(*files.frames, kFramesKind, inputs);
}

void WriteRigFiles(const RigFiles& files, const RigContent& content, const RigFileOptions& options, const Task& task) {
  if (files.frames) WriteFrames(*files.frames, content, options.frame_size, task);
  const render::Image* const texture = content.texture.get();
  gltf::HeadFileOptions of_file{.normals = options.normals};
  of_file.title = files.head.stem().string();
  const auto nodes = options.names == rig::NamePreset::kReadyPlayerMe ? gltf::HeadNodeNames::kReadyPlayerMe
                                                                      : gltf::HeadNodeNames::kDaumier;
  std::string head;  // Written last.
  const auto write_copies = [&] {
    if (files.vrm) gltf::WriteHead(*files.vrm, content.head, texture, std::nullopt, of_file);
    rig::RiggedHead named = content.head;
    named.targets = InPreset(content.head.targets, options.names);
    const rig::WeightsClip clip = InPreset(content.clip, options.names);
    of_file.nodes = nodes;
    if (files.compressed) {
      gltf::HeadFileOptions compressed = of_file;
      compressed.compressed = true;
      gltf::WriteHead(*files.compressed, named, texture, clip, compressed);
    }
    head = gltf::HeadToGlb(named, texture, clip, of_file);
  };
  std::string sheet;
  OnAllCores(2, [&](int64_t part) {
    if (part == 0) {
      sheet = render::EncodeImage(SheetOf(content), render::ImageFormat::kPng);
    } else {
      write_copies();
    }
  });
  WriteFileAtomically(files.sheet, sheet);
  WriteFileAtomically(files.head, head);
}

}  // namespace daumier::cli
