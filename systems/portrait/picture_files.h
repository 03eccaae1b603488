#pragma once
#include "systems/predictor.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Folders of pictures with files of landmarks next to them.
namespace daumier::portrait {

/// Extensions of the files that render::ReadImage reads, in lower case: ".png", ".jpg", ...
const std::vector<std::string>& PictureExtensions();

/// By its name, in any case: not a hidden file.
bool IsPictureFile(const std::filesystem::path& file);

/// Pictures of a folder, not of its sub-folders; shorter names first, so that numbers are in their order.
/// @throws Error if it is no folder.
std::vector<std::filesystem::path> PicturesIn(const std::filesystem::path& folder);

/// Checks, before anything is measured, that each folder that is named exists; empty names are ignored.
/// @throws UsageError naming the first that does not.
void CheckFolders(const std::vector<std::string>& folders);

/// Of NAME.pts, NAME.txt and NAME.json in a folder the first that is there.
std::optional<std::filesystem::path> LandmarkFileIn(const std::filesystem::path& folder, const std::string& name);

/// A picture as the one input of a prediction. @throws Error as render::ReadImage.
std::vector<systems::Input> ReadPicture(const std::filesystem::path& file);

}  // namespace daumier::portrait
