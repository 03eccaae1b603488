#pragma once
#include "core/manifest.h"
#include "core/safetensors.h"
#include "datasets/gestures/gesture_strokes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

/// A folder of strokes on disk with the gesture of each: manifest.json (kind "gestures", details.gestures and
/// details.other_strokes: the names of both lists), examples.png, and shards/hands-00000.safetensors with `points`
/// (P, 2) float32 (x right, y down, pixels), `offsets` (n + 1) int64, `gestures`, `other_strokes` (-1: none of these)
/// and `hands` (n) int32.
class GestureDatabase {
 public:
  /// Maps every shard. @throws Error naming file and cause: missing, truncated, of a newer version, shapes or numbers
  /// that differ from the manifest; a damaged file is found by its checksum unless Checksums::kSkip.
  explicit GestureDatabase(const std::filesystem::path& directory, Checksums checksums = Checksums::kVerify);

  int num_strokes() const { return first_.back(); }
  int num_hands() const { return num_hands_; }
  /// @throws Error if there is no such stroke.
  LabelledStroke stroke(int index) const;
  int hand(int index) const;
  const Manifest& manifest() const { return manifest_; }
  const std::filesystem::path& directory() const { return directory_; }

 private:
  struct Place {
    const SafetensorsFile& shard;
    size_t row;
  };
  Place PlaceOf(int index) const;

  std::filesystem::path directory_;
  Manifest manifest_;
  int num_hands_ = 0;
  std::vector<SafetensorsFile> shards_;
  std::vector<int> first_ = {0};  ///< The first stroke of each shard, then the number of all.
};

/// The file of a shard, relative to the folder.
std::string GestureShardName(int shard);

/// Writes a shard and returns its checksum.
std::string WriteGestureShard(const std::filesystem::path& file, const std::vector<LabelledStroke>& strokes);

/// Strokes of a database by subset, no hand in two of them; a function of the number of hands, shares and seed.
struct GestureSplit {
  std::vector<int> train, validation, test;
};

/// validation, test: shares of the hands, at least one each. @throws Error if no hand is left for training.
GestureSplit SplitByHand(const GestureDatabase& database, double validation, double test, uint64_t seed);

}  // namespace daumier::datasets
