#pragma once
#include "datasets/build/faces.h"
#include "datasets/build/sketches.h"
#include "tests/support/synthetic_model.h"

#include <filesystem>

/// Databases of the synthetic face, for tests of what reads them. The same bytes on every call.
namespace daumier::testing {

/// `num_persons` persons, two levels, four expressions.
inline datasets::FacesOptions SyntheticFacesOptions(int num_persons) {
  datasets::FacesOptions options;
  options.num_persons = num_persons;
  options.seed = 7;
  options.expressions = {"neutral", "jaw_open", "smile", "laugh"};
  options.exaggeration.gammas = {0.0, 0.2};
  return options;
}

inline void BuildSyntheticFaces(const std::filesystem::path& directory, int num_persons = 6) {
  datasets::BuildFaces(SyntheticModel(), SyntheticFacesOptions(num_persons), directory);
}

inline void BuildSyntheticSketches(const std::filesystem::path& faces, const std::filesystem::path& directory,
                                   const Task& task = {}) {
  datasets::SketchesOptions options;
  options.faces = faces.string();
  datasets::BuildSketches(options, directory, task);
}

}  // namespace daumier::testing
