#pragma once
#include "datasets/build/portraits.h"
#include "tests/support/synthetic_database.h"

#include <filesystem>

/// Portraits of the synthetic face, for tests of what reads them. The same bytes on every call.
namespace daumier::testing {

inline datasets::PortraitsOptions SyntheticPortraitsOptions(const std::filesystem::path& faces, int num_images) {
  datasets::PortraitsOptions options;
  options.faces = faces.string();
  options.num_images = num_images;
  options.seed = 11;
  return options;
}

/// Of a folder that BuildSyntheticFaces wrote.
inline void BuildSyntheticPortraits(const std::filesystem::path& faces, const std::filesystem::path& directory,
                                    int num_images = 12, const Task& task = {}) {
  datasets::BuildPortraits(SyntheticModel(), SyntheticPortraitsOptions(faces, num_images), directory, task);
}

}  // namespace daumier::testing
