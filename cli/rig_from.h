#pragma once
#include "cli/head_arguments.h"
#include "cli/rig_face.h"
#include "cli/rig_files.h"
#include "core/json.h"

#include <CLI/App.hpp>

#include <filesystem>

/// `daumier rig EDITED --from HEAD`: a head whose mesh another program has edited.
namespace daumier::cli {

struct FromArguments {
  std::filesystem::path head;         ///< Empty: not given.
  const CLI::App* command = nullptr;  ///< That has the options.
};

/// Adds --from.
void AddFromArguments(CLI::App& command, FromArguments& arguments);

/// A head with the shape of an edited mesh.
struct EditedRig {
  RigContent content;  ///< Without a clip.
  Json facts;          ///< What the command prints: how the mesh was matched, and what the edit changed.
};

/// Reads the head, matches the mesh and recomputes the targets. Names of targets stay those of the head unless --names is
/// given: `of_head` gets them, and what else the head says of its file.
/// @throws UsageError if an option is given that --from excludes, or if FACE is no mesh; Error naming the file, the cause
/// and the repair: as gltf::ReadHead and rig::MatchEdited.
EditedRig RigEdited(const GivenFace& given, const FromArguments& arguments, HeadArguments& of_head);

}  // namespace daumier::cli
