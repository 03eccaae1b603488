#pragma once
#include "datasets/build/faces.h"
#include "datasets/build/sharded_build.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

/// Which of a source's expressions are built: the index of each wanted name, in the order wanted; all if none is named.
/// @throws UsageError on a name that the source does not have (suggesting the nearest) or that comes twice, or if
/// neutral is not the first.
std::vector<int> ChooseExpressions(const std::vector<std::string>& available, const std::vector<std::string>& wanted,
                                   const std::string& source);

/// What every build of faces has in common: the manifest with counts, sources and details, the shards' names, and the
/// template next to them; write_shard is left empty. Keeps a reference to `face_template`.
/// @throws UsageError if strength 0 is not the first; Error if one is above 0 and the annotation lacks a region that
/// exaggeration needs, so that nothing is begun that cannot end.
ShardedBuild PlanFaces(const faces::FaceTemplate& face_template, const FacesOptions& options, int num_persons,
                       const std::vector<std::string>& expressions);

/// The arrays of a person's shard. Empty ones are left out.
struct PersonArrays {
  std::vector<float> vertices;              ///< (levels, expressions, V, 3), the counts of the manifest, cm.
  std::vector<float> identity_weights;      ///< (S)
  std::vector<float> expression_strengths;  ///< (expressions)
  std::vector<float> part_strengths;        ///< (levels, P, 4): gamma, then log_stretch of width, height, depth.
  std::vector<float> control_values;        ///< (levels, K): values of details.controls.
  std::vector<float> bumps;                 ///< (levels, N, 5): vertex, radius and offset in cm.
};

/// Writes the shard of a person and returns its checksum.
std::string WritePersonShard(const std::filesystem::path& file, const Manifest& manifest, const PersonArrays& arrays);

}  // namespace daumier::datasets
