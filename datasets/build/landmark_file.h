#pragma once
#include "faces/landmark_order.h"
#include "geometry/mesh.h"

#include <array>
#include <filesystem>
#include <map>
#include <optional>

namespace daumier::datasets {

/// The 68 landmarks of one mesh in iBUG order, in its own frame; absent where the mesh lacks the place (the inside of
/// lips on a cropped scan).
using MeshLandmarks = std::array<std::optional<geometry::Vector3>, faces::kNumLandmarks>;

/// Where the landmarks are if each vertex has another number; nothing where the file holds places.
struct ShiftedNumbers {
  std::optional<MeshLandmarks> one_less;  ///< Of numbers from 1, as in MATLAB and OBJ files; nothing with a number 0.
  std::optional<MeshLandmarks> one_more;  ///< Of numbers from 1 after 1 was subtracted twice.
};

/// Landmarks of meshes as a file has them: places on one mesh, or vertices (0-based; -1: absent) of all meshes of one
/// topology. Every form that faces::ReadMarkedPoints and faces::OrderLandmarks read.
class LandmarkFile {
 public:
  /// `vertex_map`, where given, names for each vertex of the mesh the number that the landmark file calls it by: for
  /// meshes that were cut out of a larger one. A landmark whose vertex was cut away is absent.
  /// @throws Error naming file and cause: as ReadMarkedPoints and OrderLandmarks, points of a picture, or no integers.
  explicit LandmarkFile(const std::filesystem::path& path, const std::filesystem::path& vertex_map = {},
                        faces::ZeroPoints zero = faces::ZeroPoints::kPlaces);

  /// Places that the file states in a patient's frame are taken as they are or with x and y turned (LPS and RAS differ
  /// by that), whichever lies closer to the vertices: Slicer writes meshes in either. @throws Error if a vertex is out
  /// of range.
  MeshLandmarks On(const geometry::Points& vertices) const;

  /// The landmarks if their numbers are one too high or one too low.
  ShiftedNumbers ShiftedOn(const geometry::Points& vertices) const;

 private:
  std::optional<int> VertexOf(int number) const;
  MeshLandmarks ShiftedBy(int step, const geometry::Points& vertices) const;

  faces::OrderedLandmarks landmarks_;
  std::optional<std::map<int, int>> vertex_of_name_;
};

}  // namespace daumier::datasets
