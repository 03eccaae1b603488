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

/// The faces of every group of persons, groups in order of their first person.
std::vector<std::vector<int>> FacesOfGroups(const faces::FaceDatabase& database) {
  const std::vector<int> groups = database.groups();
  std::vector<std::vector<int>> faces(*std::max_element(groups.begin(), groups.end()) + 1);
  for (int face = 0; face < database.num_faces(); ++face) faces[database.group(face)].push_back(face);
  return faces;
}

std::vector<std::vector<int>> SingleFaces(const faces::FaceDatabase& database) {
  std::vector<std::vector<int>> faces(database.num_faces());
  for (int face = 0; face < database.num_faces(); ++face) faces[face] = {face};
  return faces;
}

Json SideToJson(const faces::FaceDatabase& database, const std::vector<int>& faces) {
  std::set<int> persons;
  for (const int face : faces) {
    for (const int person : database.persons(face)) persons.insert(person);
  }
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
  const std::vector<std::vector<int>> units = by_person ? FacesOfGroups(database) : SingleFaces(database);
  const int num_units = static_cast<int>(units.size());
  const char* const unit = !by_person ? "faces" : num_units < database.num_persons() ? "groups of persons" : "persons";
  const int num_test = Count(options.test, num_units), num_validation = Count(options.validation, num_units);
  DAUMIER_CHECK(
      num_test + num_validation < num_units,
      "{} {} are too few for {} to test and {} to validate: none is left to train; build more or lower the shares",
      num_units, unit, num_test, num_validation);
  const std::vector<int> order = Stream(seed, "split").Permutation(num_units);
  Split split;
  for (int place = 0; place < num_units; ++place) {
    auto& side = place < num_test ? split.test : place < num_test + num_validation ? split.validation : split.train;
    side.insert(side.end(), units[order[place]].begin(), units[order[place]].end());
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
