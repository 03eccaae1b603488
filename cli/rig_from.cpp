#include "cli/rig_from.h"

#include "core/error.h"
#include "core/log.h"
#include "gltf/head_reader.h"
#include "rig/edited_head.h"
#include "rig/edited_match.h"
#include "rig/target_names.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace daumier::cli {
namespace {

constexpr std::array<const char*, 10> kExcluded = {
    "--landmarks", "--texture", "--hair",   "--hair-colour",     "--cut",
    "--map",       "--apply",   "--meshes", "--keep-expression", "overrides"};
constexpr double kMostMissing = 0.01;
constexpr const char* kNothing = "_neutral";  // MediaPipe's first target.

/// Without the target that moves nothing.
rig::MorphTargets WithoutNothing(const rig::MorphTargets& targets) {
  rig::MorphTargets kept;
  std::vector<int> columns;
  for (int t = 0; t < targets.num_targets(); ++t) {
    if (targets.names[size_t(t)] == kNothing) continue;
    columns.push_back(t);
    kept.names.push_back(targets.names[size_t(t)]);
  }
  kept.offsets = targets.offsets(Eigen::all, columns);
  return kept;
}

/// The preset whose names and order these are, if any.
std::optional<rig::NamedPreset> PresetOf(const std::vector<std::string>& names) {
  rig::MorphTargets targets;
  targets.names = names;
  targets.offsets.resize(0, std::ssize(names));
  targets = WithoutNothing(targets);
  for (const rig::NamedPreset& named : rig::kNamePresets)
    if (rig::InPreset(targets, named.preset).names == names) return named;
  return std::nullopt;
}

/// What is not given stays as in the file.
void KeepOptions(const gltf::HeadInFile& file, const FromArguments& arguments, HeadArguments& of_head) {
  const std::vector<std::string>& names = file.head.targets.names;
  if (const auto preset = PresetOf(names); preset && arguments.command->count("--names") == 0)
    of_head.names = std::string(preset->name);
  if (std::ranges::any_of(names, [](const std::string& name) { return name.starts_with("viseme_"); }))
    of_head.visemes = false;  // They are among the targets already.
  of_head.normals = of_head.normals || file.has_normals;
}

/// Of vertices that were deleted: they are in the head again.
void WarnOfMissing(const rig::EditedHead& edited, const std::string& file) {
  if (edited.num_missing <= kMostMissing * edited.num_expected) return;
  log::Warn(
      "{}: {} of {} vertices ({:.1f} %) of the parts of the head that it has are missing in it. They are in the head "
      "again, and move as what is around them. To edit them as well, export the whole mesh; what is to be gone, make "
      "small or move inside instead of deleting it",
      file, edited.num_missing, edited.num_expected, 100.0 * edited.num_missing / edited.num_expected);
}

double ToMicrometres(double mm) {
  return std::round(1000 * mm) / 1000;
}

}  // namespace

void AddFromArguments(CLI::App& command, FromArguments& arguments) {
  arguments.command = &command;
  command
      .add_option(
          "--from", arguments.head,
          "NAME.glb that `rig` or `avatar` wrote, plain. FACE is its mesh after an edit in another program: its "
          "targets are recomputed for the new shape; texture, materials and names are kept")
      ->check(CLI::ExistingFile);
}

EditedRig RigEdited(const GivenFace& given, const FromArguments& arguments, HeadArguments& of_head) {
  for (const char* option : kExcluded)
    if (arguments.command->count(option) > 0)
      throw UsageError(fmt::format("--from {}: {} has no effect on a head that is made already. Leave it out",
                                   arguments.head.string(),
                                   option == std::string_view("overrides") ? "key=value (overrides)" : option));
  if (!given.is_mesh)
    throw UsageError(fmt::format("--from {}: {} is no mesh. Give the .obj or .ply of the edited head",
                                 arguments.head.string(), given.file.string()));
  gltf::HeadInFile file = gltf::ReadHead(arguments.head);
  const rig::HeadNumbering numbering{file.of_file_vertices, file.of_eye_vertices, file.pivot_height_cm};
  const rig::EditedMatch match = [&] {
    try {
      return rig::MatchEdited(file.head, numbering, given.mesh);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: does not fit {}: {}", given.file.string(), arguments.head.string(), error.what()));
    }
  }();
  rig::EditedHead edited = rig::ApplyEdit(file.head, match);
  if (edited.most_edit_mm == 0)
    log::Warn("{}: has the shape of {}: nothing was edited", given.file.string(), arguments.head.string());
  WarnOfMissing(edited, given.file.string());
  KeepOptions(file, arguments, of_head);
  EditedRig result;
  result.facts = {{"from", arguments.head.string()},
                  {"edited_vertices", match.num_vertices},
                  {"matched_vertices", edited.num_matched},
                  {"missing_vertices", edited.num_missing},
                  {"matched_by", match.by == rig::MatchedBy::kUv ? "uv" : "order"},
                  {"axes", match.axes},
                  {"unit", match.unit},
                  {"edit_mean_mm", ToMicrometres(edited.mean_edit_mm)},
                  {"edit_max_mm", ToMicrometres(edited.most_edit_mm)},
                  {"target_change_max_mm", ToMicrometres(edited.most_target_change_mm)}};
  if (!edited.most_changed_target.empty()) result.facts["most_changed_target"] = edited.most_changed_target;
  result.content.head = std::move(edited.head);
  result.content.head.targets = rig::InPreset(WithoutNothing(result.content.head.targets), rig::NamePreset::kArkit);
  result.content.texture = std::move(file.texture);
  return result;
}

}  // namespace daumier::cli
