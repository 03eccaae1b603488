#pragma once
#include "core/json.h"
#include "rig/printed_head.h"

#include <CLI/App.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Fewer triangles and prints of rigged heads, for the verbs that write these.
namespace daumier::cli {

/// The fewest triangles that --triangles accepts.
inline constexpr int kLeastTriangles = 500;

struct HeadExtras {
  std::optional<int> triangles;
  bool print = false;
  std::vector<std::string> print_pose;
};

/// Adds --triangles, --print and --print-pose to a command.
void AddHeadExtras(CLI::App& command, HeadExtras& extras);

/// NAME.stl next to NAME.glb with --print or --print-pose.
std::optional<std::filesystem::path> PrintFileOf(const HeadExtras& extras, const std::filesystem::path& head);
/// Whether this program wrote the file: a binary STL whose header says so.
bool IsOwnPrint(const std::filesystem::path& file);

/// The pose of --print-pose. @throws UsageError on a word that is not TARGET=WEIGHT of ARKit's names and 0 .. 1.
rig::PrintPose PrintPoseOf(const HeadExtras& extras);

/// Writes the print, atomic, and logs its warnings. Returns what the result says of it.
/// @throws Error as rig::MakePrintedHead, or naming the file and the cause.
Json WritePrint(const std::filesystem::path& file, const rig::RiggedHead& head, const rig::PrintPose& pose);

/// The head with --triangles, if that is given and fewer; logs what was not reached. Returns what the result says of it.
Json ReduceTriangles(const HeadExtras& extras, rig::RiggedHead& head);

}  // namespace daumier::cli
