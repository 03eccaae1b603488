#pragma once
#include "core/json.h"
#include "core/options.h"
#include "faces/face_database.h"

#include <string>
#include <vector>

namespace daumier::datasets {

struct SplitOptions {
  std::string kind = "person";
  double validation = 0.1;
  double test = 0.15;

  template <class V>
  void Visit(V&& visit) {
    visit("kind", kind, Choices{{"person", "random"}},
          "person: all faces of a person are in one subset; random: faces are assigned one by one, as in the paper.");
    visit("validation", validation, Range{0.0, 0.5},
          "Share of persons (or faces) for validation, by which weights and options are chosen.");
    visit("test", test, Range{0.01, 0.5}, "Share of persons (or faces) for the test; only `daumier eval` reads them.");
  }
};

/// Face indices of a database, each sorted, disjoint, together all faces.
struct Split {
  std::vector<int> train, validation, test;
};

/// Deterministic in seed. Every non-zero share gets at least one person (or face). Persons of one group, which show the
/// same real person (faces::FaceDatabase::groups), count as one and stay on one side.
/// @throws Error if there are too few persons for the shares.
Split MakeSplit(const faces::FaceDatabase& database, const SplitOptions& options, uint64_t seed);

/// SHA-256 of the indices in decimal, one a line: names a set of faces in manifests.
std::string FacesChecksum(const std::vector<int>& faces);

/// For manifests: of each of train, validation and test {num_faces, num_persons, persons, faces_checksum}.
Json SplitToJson(const faces::FaceDatabase& database, const Split& split);

}  // namespace daumier::datasets
