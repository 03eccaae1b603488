#pragma once
#include "core/manifest.h"
#include "core/output_place.h"
#include "core/task.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace daumier::datasets {

/// A folder that is written shard by shard.
struct ShardedBuild {
  Manifest manifest;  ///< All but the checksums.
  int num_shards = 0;
  std::string unit;         ///< What progress counts, the plural: "faces".
  int units_per_shard = 1;  ///< Of every shard but perhaps the last.
  int64_t num_units = 0;    ///< Of all shards; 0: num_shards * units_per_shard.
  /// The shards from this one on read earlier ones, and are begun when all of those are written; -1: none does.
  int num_independent = -1;
  std::function<std::string(int shard)> shard_name;  ///< Relative to the folder.
  /// Writes a shard atomically and returns its checksum. Called from several threads; gives the same bytes every time.
  std::function<std::string(int shard, const std::filesystem::path& file)> write_shard;
  /// Writes the files next to the shards and returns the checksums by file name; may be empty.
  std::function<std::map<std::string, std::string>(const std::filesystem::path& directory)> write_rest;
  /// Called once all shards are written, before the manifest, which it may change, as it may remove and rename shards;
  /// may be empty. A build that is stopped in it writes the shards again that are not as they were recorded.
  std::function<void(const std::filesystem::path& directory, Manifest& manifest)> finish;
};

/// The folder of a build of that manifest kind, finished or stopped.
OutputKind BuildOutput(const std::string& kind);

/// Writes the shards that are not there yet, and the manifest last. Shards of an earlier, stopped build are kept if
/// their content is what was recorded in building.json; the bytes of the finished folder are those of a build that was
/// never stopped, by any number of threads. A folder that is finished is only verified.
/// @throws UsageError as CheckOutputFolder; Error if the folder holds another build (saying what differs); Cancelled if the task is
/// cancelled, saying how to resume; whatever the writers throw. What is finished stays. Reports units of all shards,
/// those of an earlier build included.
void BuildShards(const std::filesystem::path& directory, const ShardedBuild& build, const Task& task = {});

}  // namespace daumier::datasets
