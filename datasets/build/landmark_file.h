#pragma once
#include "geometry/mesh.h"

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

namespace daumier::datasets {

/// The 68 landmarks of one mesh in iBUG order, in its own frame; absent where the mesh lacks the place (the inside of
/// lips on a cropped scan).
using MeshLandmarks = std::array<std::optional<geometry::Vector3>, 68>;

/// 68 landmarks as stored in a file: vertices (-1: absent) or places.
/// A file holds 68 vertex indices or 68 lines `x y z` (`nan nan nan`: absent), separated by white space, or the same as
/// a JSON list; 0-based; lines that begin with # are skipped.
class LandmarkFile {
 public:
  /// `vertex_map`, where given, names for each vertex of the mesh the number that the landmark file calls it by: for
  /// meshes that were cut out of a larger one. A landmark whose vertex was cut away is absent.
  /// @throws Error naming file and cause: unreadable, another count of numbers, or no integers.
  explicit LandmarkFile(const std::filesystem::path& path, const std::filesystem::path& vertex_map = {});

  /// @throws Error if a vertex is out of range.
  MeshLandmarks On(const geometry::Points& vertices) const;

 private:
  std::filesystem::path path_;
  std::vector<int> vertices_;  ///< 68, or empty where the file holds places.
  MeshLandmarks places_;
};

}  // namespace daumier::datasets
