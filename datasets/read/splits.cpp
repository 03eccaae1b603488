#include "datasets/read/splits.h"

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::datasets {
namespace {

/// A share of a number of persons or faces; at least one unless the share is zero.
int Count(double share, int total) {
  return share > 0 ? std::max(1, static_cast<int>(std::lround(share * total))) : 0;
}

Json SideToJson(const faces::FaceDatabase& database, const std::vector<int>& faces) {
  std::set<int> persons;
  for (const int face : faces) persons.insert(database.id(face).person);
  return {{"num_faces", faces.size()},
          {"num_persons", persons.size()},
          {"persons", std::vector<int>(persons.begin(), persons.end())},
          {"faces_checksum", FacesChecksum(faces)}};
}

}  // namespace

std::string FacesChecksum(const std::vector<int>& faces) {
  std::string lines;
  for (const int face : faces) lines += fmt::format("{}\n", face);
  return Sha256(lines);
}

Split MakeSplit(const faces::FaceDatabase& database, const SplitOptions& options, uint64_t seed) {
  const bool by_person = options.kind == "person";
  const char* const unit = by_person ? "persons" : "faces";
  const int num_units = by_person ? database.num_persons() : database.num_faces();
  const int num_test = Count(options.test, num_units), num_validation = Count(options.validation, num_units);
  DAUMIER_CHECK(
      num_test + num_validation < num_units,
      "{} {} are too few for {} to test and {} to validate: none is left to train; build more or lower the shares",
      num_units, unit, num_test, num_validation);
  const std::vector<int> order = Stream(seed, "split").Permutation(num_units);
  Split split;
  const int faces_per_unit = database.num_faces() / num_units;
  for (int place = 0; place < num_units; ++place) {
    auto& side = place < num_test ? split.test : place < num_test + num_validation ? split.validation : split.train;
    for (int k = 0; k < faces_per_unit; ++k) side.push_back(order[place] * faces_per_unit + k);
  }
  for (auto* side : {&split.train, &split.validation, &split.test}) std::sort(side->begin(), side->end());
  return split;
}

Json SplitToJson(const faces::FaceDatabase& database, const Split& split) {
  return {{"train", SideToJson(database, split.train)},
          {"validation", SideToJson(database, split.validation)},
          {"test", SideToJson(database, split.test)}};
}

}  // namespace daumier::datasets
