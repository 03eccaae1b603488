#pragma once
#include "core/task.h"
#include "render/image.h"
#include "render/sheet.h"
#include "rig/rigged_head.h"
#include "rig/target_names.h"
#include "rig/weights_clip.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace daumier::cli {

/// The files that `daumier rig` writes.
struct RigFiles {
  std::filesystem::path head;                         ///< NAME.glb
  std::filesystem::path sheet;                        ///< NAME.png
  std::optional<std::filesystem::path> compressed{};  ///< NAME_compressed.glb
  std::optional<std::filesystem::path> vrm{};         ///< NAME.vrm
  std::optional<std::filesystem::path> frames{};      ///< A folder.
  std::optional<std::filesystem::path> print{};       ///< NAME.stl
};

enum class AlsoCompressed { kNo, kYes };
enum class AlsoVrm { kNo, kYes };

/// @throws UsageError unless `out` ends in .glb.
RigFiles RigFilesOf(const std::filesystem::path& out, AlsoCompressed compressed, AlsoVrm vrm,
                    const std::filesystem::path& frames);

/// For a command that begins: files that this verb has written may be replaced, which a .glb or .vrm states itself; the
/// sheet goes with its .glb. `replaces_all`: any file may be. @throws UsageError naming a file or folder that may not be
/// replaced, or as CheckOutputFile and CheckOutputFolder.
void CheckRigFiles(const RigFiles& files, const std::vector<std::filesystem::path>& inputs, bool replaces_all);

/// What is written.
struct RigContent {
  rig::RiggedHead head;                          ///< Targets by ARKit's names.
  std::shared_ptr<const render::Image> texture;  ///< Null: colours of materials.
  rig::WeightsClip clip;                         ///< Of these targets.
  std::vector<render::SheetCell> stages{};       ///< Pictures of how it was made: above the expressions in the sheet.
};

struct RigFileOptions {
  rig::NamePreset names = rig::NamePreset::kArkit;  ///< Of a .glb; a .vrm has ARKit's.
  bool normals = false;                             ///< gltf::HeadFileOptions
  int frame_size = 512;                             ///< Pixels a side.
};

/// Writes the files, each whole or not at all: frames, sheet, copies, and the .glb last. Frames are frame_00001.png and
/// so on with a manifest (kind "frames"). @throws Error as gltf::WriteHead and render::WriteImage; Cancelled if the task is.
void WriteRigFiles(const RigFiles& files, const RigContent& content, const RigFileOptions& options,
                   const Task& task = {});

}  // namespace daumier::cli
