#include "systems/portrait/landmark_split.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace daumier::portrait {
namespace {

/// The samples of each person, or each sample alone.
std::vector<std::vector<int>> SplitUnits(const LandmarkSource& source, bool by_person) {
  std::map<int, std::vector<int>> units;
  for (int i = 0; i < source.size(); ++i) units[by_person ? source.person(i) : i].push_back(i);
  std::vector<std::vector<int>> list;
  for (auto& [key, samples] : units) list.push_back(std::move(samples));
  return list;
}

int CountOfShare(double share, size_t total) {
  return share > 0 ? std::max(1, int(std::lround(share * double(total)))) : 0;
}

Json SampleSideToJson(const LandmarkSource& source, const std::vector<int>& samples) {
  std::set<int> persons;
  for (const int sample : samples) persons.insert(source.person(sample));
  return {{"num_portraits", samples.size()},
          {"num_persons", persons.size()},
          {"portraits_checksum", datasets::FacesChecksum(samples)}};
}

}  // namespace

datasets::Split SplitSamples(const LandmarkSource& source, const datasets::SplitOptions& options, uint64_t seed) {
  const std::vector<std::vector<int>> units = SplitUnits(source, options.kind == "person");
  const int num_test = CountOfShare(options.test, units.size()),
            num_validation = CountOfShare(options.validation, units.size());
  DAUMIER_CHECK(num_test + num_validation < int(units.size()),
                "{} persons of portraits are too few for {} to test and {} to validate: none is left to train; build "
                "more or lower the shares",
                units.size(), num_test, num_validation);
  const std::vector<int> order = Stream(seed, "split").Permutation(int(units.size()));
  datasets::Split split;
  for (int place = 0; place < int(units.size()); ++place) {
    auto& side = place < num_test ? split.test : place < num_test + num_validation ? split.validation : split.train;
    const std::vector<int>& unit = units[size_t(order[size_t(place)])];
    side.insert(side.end(), unit.begin(), unit.end());
  }
  for (auto* side : {&split.train, &split.validation, &split.test}) std::ranges::sort(*side);
  return split;
}

Json SampleSplitToJson(const LandmarkSource& source, const datasets::Split& split) {
  return {{"train", SampleSideToJson(source, split.train)},
          {"validation", SampleSideToJson(source, split.validation)},
          {"test", SampleSideToJson(source, split.test)}};
}

}  // namespace daumier::portrait
