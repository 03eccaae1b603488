#pragma once
#include "core/manifest.h"
#include "datasets/build/portrait_shard.h"
#include "faces/face_database.h"
#include "render/image.h"
#include "tests/support/drawn_portraits.h"
#include "tests/support/synthetic_face.h"

#include <algorithm>
#include <filesystem>

namespace daumier::testing {

/// A portrait database of `count` DrawnPortraits, two of a person, in one shard. The same bytes on every call.
inline void WriteDrawnPortraits(const std::filesystem::path& folder, int count) {
  const DrawnPortraits portraits(count);
  std::filesystem::create_directories(folder / "shards");
  std::vector<datasets::PortraitRecord> records;
  for (int i = 0; i < count; ++i) {
    const portrait::LandmarkSample sample = portraits.Get(i);
    datasets::PortraitRecord record;
    for (const auto& [image, bytes] : {std::pair(&sample.picture, &record.picture), {&sample.mask, &record.mask}}) {
      render::WriteImage(folder / "image.png", *image);
      *bytes = ReadFile(folder / "image.png");
    }
    std::ranges::copy(sample.landmarks, record.landmarks.begin());
    std::ranges::copy(sample.visibility, record.visibility.begin());
    record.states = sample.gaps_mm;
    record.face = record.person = portraits.person(i);
    record.skin_tone = sample.skin_tone;
    records.push_back(std::move(record));
  }
  std::filesystem::remove(folder / "image.png");
  Manifest manifest{.kind = "portraits", .verb = "dataset portraits", .seed = 7};
  manifest.sources = {{{"name", "drawn"}, {"version", "1"}, {"checksum", ""}, {"licence", "own work"}}};
  manifest.counts = {{"images", count}, {"shards", 1}};
  manifest.details = {{"size", 224},        {"focal", 1015.0},     {"distance", 100.0},
                      {"vertices", false},  {"centre", {0, 0, 0}}, {"expressions", Json::array()},
                      {"styles", {"drawn"}}};
  manifest.checksums = faces::WriteFaceTemplate(folder, SyntheticFace());
  manifest.checksums[datasets::PortraitShardName(0)] =
      datasets::WritePortraitShard(folder / datasets::PortraitShardName(0), records);
  WriteManifest(folder, manifest);
}

}  // namespace daumier::testing
