#pragma once
#include "datasets/read/portrait_database.h"
#include "geometry/mesh.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace daumier::datasets {

/// One portrait and its truth, as PortraitDatabase returns it.
struct PortraitRecord {
  std::string picture, mask;  ///< Bytes of image files.
  std::array<float, 2 * PortraitSizes::kLandmarks> landmarks{};
  std::array<uint8_t, PortraitSizes::kLandmarks> visibility{};
  std::array<float, 3> states{};
  std::array<float, PortraitSizes::kExpression> expression{};
  std::array<float, PortraitSizes::kAlbedo> albedo{};
  std::array<float, PortraitSizes::kLight> light{};
  std::array<float, PortraitSizes::kPose> pose{};
  int face = 0, person = 0, style = 0, skin_tone = 0;
  bool is_bald = false;
  float eye_size = 0;
  geometry::Points vertices{};  ///< V x 3, cm; empty: not stored.
};

/// Writes the records as a shard of a PortraitDatabase, atomically; equal records give equal bytes. `metadata`: entries of
/// the file's metadata in addition to its kind. Returns its checksum. @throws Error if only some have vertices, or a
/// coordinate is beyond 32.767 cm.
std::string WritePortraitShard(const std::filesystem::path& file, const std::vector<PortraitRecord>& records,
                               const std::map<std::string, std::string>& metadata = {});

}  // namespace daumier::datasets
