#include "cli/avatar_stages.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/staged_directory.h"

namespace daumier::cli {

void WriteAvatarStages(const std::filesystem::path& folder, const std::vector<AvatarStage>& stages,
                       const Json& milliseconds) {
  StagedDirectory staged(folder, kStagesKind);
  Manifest manifest{.kind = kStagesKind, .verb = "avatar"};
  manifest.counts = {{"pictures", stages.size()}};
  const auto write = [&](const std::string& name, const std::string& bytes) {
    WriteFileAtomically(staged.path() / name, bytes);
    manifest.checksums[name] = Sha256(bytes);
  };
  for (size_t i = 0; i < stages.size(); ++i)
    write(fmt::format("{:02}_{}.png", i + 1, stages[i].name),
          render::EncodeImage(stages[i].picture, render::ImageFormat::kPng));
  write("times.json", Json{{"milliseconds", milliseconds}}.dump(1) + "\n");
  WriteManifest(staged.path(), manifest);
  staged.Commit();
}

}  // namespace daumier::cli
