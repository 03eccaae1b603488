#pragma once
#include "datasets/build/points.h"
#include "tests/support/synthetic_database.h"

#include <filesystem>

namespace daumier::testing {

/// Points of a database of synthetic faces: the given number of samples, a gap as the synthetic mouth allows.
inline void BuildSyntheticPoints(const std::filesystem::path& faces, const std::filesystem::path& directory,
                                 int num_samples = 40) {
  datasets::PointsOptions options;
  options.faces = faces.string();
  options.num_samples = num_samples;
  datasets::BuildPoints(options, directory);
}

}  // namespace daumier::testing
