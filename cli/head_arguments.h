#pragma once

#include "cli/head_extras.h"
#include "cli/rig_files.h"
#include "core/json.h"

#include <CLI/App.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What the verbs that write rigged heads have in common.
namespace daumier::cli {

struct HeadArguments {
  std::filesystem::path out, clip, frames;
  std::string names = "arkit";
  bool compress = false, vrm = false, normals = false, visemes = false, force = false, as_json = false;
  int frame_size = 512;
  HeadExtras extras;
  const CLI::App* command = nullptr;  ///< That has the options.
};

/// Adds --out, --animate, --frames, --names and the others to a command.
void AddHeadArguments(CLI::App& command, HeadArguments& arguments);

/// The files of a command that begins. @throws UsageError as RigFilesOf and CheckRigFiles, or if --frame-size is given
/// without --frames.
RigFiles CheckedHeadFiles(const HeadArguments& arguments, const std::vector<std::filesystem::path>& inputs);

/// The clip of --animate, if it is given. @throws Error as rig::ReadClip.
std::optional<rig::WeightsClip> ReadHeadClip(const HeadArguments& arguments);

/// Adds visemes and the clip, or one that shows what a head can do, and writes the files. Returns the result to print:
/// files with their sizes, and what the head has. @throws Error as WriteRigFiles.
Json WriteHeadFiles(const HeadArguments& arguments, const RigFiles& files, const std::optional<rig::WeightsClip>& clip,
                    RigContent content);

}  // namespace daumier::cli
