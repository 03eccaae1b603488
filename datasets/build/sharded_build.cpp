#include "datasets/build/sharded_build.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/progress.h"

#include <algorithm>
#include <optional>

namespace daumier::datasets {
namespace fs = std::filesystem;
namespace {

constexpr int kJournalVersion = 1;

/// What a build is to make: the manifest without checksums.
Json Plan(const Manifest& manifest) {
  return {{"kind", manifest.kind},      {"verb", manifest.verb},       {"config", manifest.config},
          {"seed", manifest.seed},      {"sources", manifest.sources}, {"counts", manifest.counts},
          {"details", manifest.details}};
}

/// The first place where two plans differ: "config/num_persons is 24 there and 30 here".
std::string Difference(const Json& there, const Json& here) {
  const Json patch = Json::diff(there, here);
  const Json::json_pointer place(patch.at(0).at("path").get<std::string>());
  const auto value = [&](const Json& plan) { return plan.contains(place) ? plan.at(place).dump() : "absent"; };
  return fmt::format("{} is {} there and {} here", place.to_string().substr(1), value(there), value(here));
}

void CheckSame(const fs::path& directory, const Json& there, const Json& here) {
  // By value, not by order: the config that a user writes may name its keys in any order.
  const Json patch = Json::diff(there, here);
  DAUMIER_CHECK(patch.empty(), "{} holds another build: {}; choose another folder or delete it", directory.string(),
                Difference(there, here));
}

/// Checksums of finished shards, by file name.
struct Journal {
  Json plan;
  std::map<std::string, std::string> checksums;

  void Write(const fs::path& directory) const {
    const Json json = {{"format_version", kJournalVersion}, {"plan", plan}, {"checksums", Json(checksums)}};
    WriteFileAtomically(directory / kBuildJournal, json.dump(1) + "\n");
  }
};

Journal ReadJournal(const fs::path& directory) {
  const fs::path path = directory / kBuildJournal;
  try {
    const Json json = TryParseJson(ReadFile(path)).value_or(Json());
    DAUMIER_CHECK(json.at("format_version") == kJournalVersion, "{}: unknown format version {}", path.string(),
                  json.at("format_version").dump());
    return {json.at("plan"), json.at("checksums").get<std::map<std::string, std::string>>()};
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}; delete the folder and start again", path.string(), TextOf(error)));
  }
}

/// Creates the folder, or finds there a stopped build of the same plan.
Journal OpenJournal(const fs::path& directory, const Json& plan) {
  if (fs::exists(directory / kBuildJournal)) {
    Journal journal = ReadJournal(directory);
    CheckSame(directory, journal.plan, plan);
    log::Info("{}: resuming an interrupted build", directory.string());
    return journal;
  }
  MakeDirectory(directory);
  Journal journal{plan, {}};
  journal.Write(directory);
  return journal;
}

}  // namespace

OutputKind BuildOutput(const std::string& kind) {
  return {kind, {kBuildJournal}};
}

void BuildShards(const fs::path& directory, const ShardedBuild& build, const Task& task) {
  const Json plan = Plan(build.manifest);
  CheckOutputFolder(directory, BuildOutput(build.manifest.kind));
  if (fs::exists(directory / "manifest.json")) {
    const Manifest finished = ReadManifest(directory, build.manifest.kind);
    CheckSame(directory, Plan(finished), plan);
    VerifyChecksums(directory, finished);
    fs::remove(directory / kBuildJournal);
    log::Info("{}: finished already", directory.string());
    return;
  }
  Journal journal = OpenJournal(directory, plan);
  MakeDirectory(directory / "shards");
  Manifest manifest = build.manifest;
  if (build.write_rest) manifest.checksums = build.write_rest(directory);

  struct Shard {
    std::string name;
    std::optional<std::string> checksum;  ///< Absent if the task was cancelled.
    bool is_new = false;
  };
  const std::map<std::string, std::string> recorded = journal.checksums;
  const auto make = [&](int shard) -> Shard {
    const std::string name = build.shard_name(shard);
    const fs::path file = directory / name;
    const auto known = recorded.find(name);
    const bool is_there = known != recorded.end() && fs::exists(file) && Sha256OfFile(file) == known->second;
    if (is_there) return {name, known->second};
    if (task.cancelled()) return {name, std::nullopt};
    return {name, build.write_shard(shard, file), true};
  };
  int num_done = 0;
  {
    const int64_t num_units = build.num_units ? build.num_units : int64_t(build.num_shards) * build.units_per_shard;
    Progress progress(task.Stage(build.manifest.kind), num_units, build.unit);
    int64_t num_left = num_units;
    const auto make_range = [&](int begin, int end) {
      ForEachInOrder(
          end - begin, [&](int i) { return make(begin + i); },
          [&](const Shard& shard) {
            if (!shard.checksum) return;
            ++num_done;
            journal.checksums[shard.name] = *shard.checksum;
            if (shard.is_new) journal.Write(directory);
            const int64_t num_here = std::min<int64_t>(build.units_per_shard, num_left);
            progress.Step(num_here);
            num_left -= num_here;
          });
    };
    const int num_independent = build.num_independent < 0 ? build.num_shards : build.num_independent;
    make_range(0, num_independent);
    if (num_done == num_independent) make_range(num_independent, build.num_shards);
  }
  if (num_done != build.num_shards) {
    throw Cancelled(fmt::format("{}: stopped after {} of {} shards; the same command resumes the build",
                                directory.string(), num_done, build.num_shards));
  }
  manifest.checksums.insert(journal.checksums.begin(), journal.checksums.end());
  if (build.finish) build.finish(directory, manifest);
  WriteManifest(directory, manifest);
  fs::remove(directory / kBuildJournal);
}

}  // namespace daumier::datasets
