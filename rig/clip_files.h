#pragma once
#include "rig/recording.h"

#include <filesystem>

namespace daumier::rig {

/// A recording of a tracker, by its content: JSON (ParseClipJson) if it begins with a brace or a bracket, else a table
/// (ParseClipCsv), which Live Link Face CSV is. Every target is in the result: those that the file lacks are 0 and named
/// in a warning, as are names that are no target, and weights beyond 0 .. 1, which are clamped.
/// @throws Error as ReadFile, ParseClipJson and ParseClipCsv.
Recording ReadClip(const std::filesystem::path& path);

}  // namespace daumier::rig
