#pragma once
#include "core/options.h"
#include "faces/exaggeration.h"
#include "faces/face_model.h"
#include "faces/source.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

struct FacesOptions {
  faces::SourceOptions source;
  int num_persons = 150;
  uint64_t seed = 1;
  double identity_spread = 1.0;
  std::vector<std::string> expressions;
  faces::ExaggerationOptions exaggeration;

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "Where faces come from.");
    visit("num_persons", num_persons, Range{1, 100000},
          "Persons that are drawn from a model, each in every level and expression. Meshes are taken as many as there "
          "are.");
    visit("seed", seed, Range{0, 9e15}, "Of all that is drawn at random.");
    visit("identity_spread", identity_spread, Range{0.0, 3.0}, "Multiplies the deviation of every identity control.");
    visit("expressions", expressions, Text{}, "Names of expressions, neutral first; empty for all of the source.");
    visit("exaggeration", exaggeration, Table{}, "Levels of exaggeration; the first gamma has to be 0.");
  }
};

/// Writes a faces::FaceDatabase: person p is DrawIdentity from Stream(seed, "identity", p); its neutral face is
/// exaggerated once a gamma, and the expression's linear offset is added. A source that gives faces instead of a model
/// goes to BuildGivenFaces. Goes on where an earlier, stopped build of the same options ended.
/// @throws Error as BuildShards; UsageError on an unknown expression, or if neutral or gamma 0 is not first.
void BuildFaces(const FacesOptions& options, const std::filesystem::path& directory);
/// The same from a model at hand; `options.source` is only recorded.
void BuildFaces(const faces::FaceModel& model, const FacesOptions& options, const std::filesystem::path& directory);

}  // namespace daumier::datasets
