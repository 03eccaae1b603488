#pragma once
#include "core/json.h"
#include "render/image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::cli {

/// A step of an avatar of which there is a picture.
struct AvatarStage {
  std::string name;  ///< Of its file, NN_name.png.
  render::Image picture;
};

inline constexpr const char* kStagesKind = "avatar stages";

/// Writes the pictures of stages in their order, times.json (milliseconds by stage) and a manifest, whole or not at all.
/// @throws UsageError as CheckReplacedFolder; Error as WriteFileAtomically.
void WriteAvatarStages(const std::filesystem::path& folder, const std::vector<AvatarStage>& stages,
                       const Json& milliseconds);

}  // namespace daumier::cli
