#pragma once
#include "cli/rig_face.h"
#include "cli/verb.h"

#include <CLI/App.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// `daumier rig` where it makes no head, but weights for one: of another face model's coefficients, or of meshes.
namespace daumier::cli {

struct MapArguments {
  std::filesystem::path model;         ///< --map: a face model, or a map of one.
  std::filesystem::path coefficients;  ///< --apply
  std::vector<std::filesystem::path> meshes;
  double frames_per_second = 60;
  bool keeps_strength = false;
  bool has_gaze = false;              ///< --gaze
  const CLI::App* command = nullptr;  ///< That has the options.
};

/// What such a command writes, and where.
struct MapOutput {
  std::filesystem::path out;
  bool force = false, as_json = false;
};

/// Adds --map, --apply, --meshes and what belongs to them.
void AddMapArguments(CLI::App& command, MapArguments& arguments);

/// Options key=value among the meshes, or in the place of FACE with --map, become overrides. @throws UsageError if FACE is
/// missing, or given with --map; if an option of heads is given with --map or --meshes, or one of theirs without them.
void TakeOverrides(MapArguments& arguments, std::filesystem::path& face, ConfigArguments& config);

/// --map: writes the map of a model, or with --apply the weights of coefficients.
/// @throws UsageError if the output is of the wrong kind or no file of this command, or the model is not recognised; Error
/// as faces::LoadSource, rig::MapExpressions and rig::ReadCoefficients.
void MapFaceModel(const MapArguments& arguments, const ConfigArguments& config, const MapOutput& output);

/// --meshes: writes the weights of meshes of a head whose neutral mesh is `face`. `landmarks`: of a head of another
/// topology than a face model's; may be empty. @throws UsageError as MapFaceModel; Error naming a mesh of another
/// topology, or as ReadFaceToRig and RigForeignHead.
void WeighMeshes(const MapArguments& arguments, const std::filesystem::path& face,
                 const std::filesystem::path& landmarks, const std::optional<faces::SourceOptions>& source,
                 const MapOutput& output);

}  // namespace daumier::cli
