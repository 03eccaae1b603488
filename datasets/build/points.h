#pragma once
#include "core/options.h"
#include "core/task.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace daumier::datasets {

struct PointsOptions {
  std::string faces;
  int num_samples = 11581;
  double head_height = 2.1;
  double mouth_gap = 0.06;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces whose surfaces are sampled.");
    visit("num_samples", num_samples, Range{0, 1e7},
          "Number of points sampled on each face, in addition to its vertices.");
    visit("head_height", head_height, Range{0.01, 1000},
          "Height of the template's head from chin to top, in model units. The frequencies of a SIREN and the weights "
          "of the losses assume 2.1.");
    visit("mouth_gap", mouth_gap, Range{0, 10}, "Gap between the template's lips in the middle, in model units.");
    visit("seed", seed, Range{0, 9e15}, "Seed of all random numbers.");
  }
};

/// Writes a PointDatabase of every face of a database:
/// - the template with its mouth open (faces::OpenMouth) in the model frame (faces::HeadFrame);
/// - of each face num_samples points, uniform by area on that face's own open surface, from Stream(seed, "surface
///   samples", face); its vertices stay where they are, in the faces' folder;
/// - the attributes of all faces (FaceAttributes).
/// Resumes an interrupted build of the same options. @throws Error as these, FaceDatabase and
/// BuildShards.
void BuildPoints(const PointsOptions& options, const std::filesystem::path& directory, const Task& task = {});

}  // namespace daumier::datasets
