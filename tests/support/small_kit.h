#pragma once
#include "benchmark/kit.h"
#include "benchmark/make.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <filesystem>
#include <string>

/// A kit of the synthetic face: 5 training persons, 2 of validation, 3 of the test. The same bytes on every call.
namespace daumier::testing {

inline benchmark::BenchmarkOptions SmallKitOptions() {
  benchmark::BenchmarkOptions options;
  options.name = "small";
  options.persons = {.train = 5, .validation = 2, .test = 3};
  options.faces = SyntheticFacesOptions(1);
  options.drawings.size = 128;
  options.drawings.clean.exact = 1;
  for (datasets::StyleOptions* style : {&options.drawings.clean, &options.drawings.drawn, &options.drawings.rough})
    style->doodles = style->cartoons = style->page.prefix = 0;
  options.portraits.per_person = 1;
  options.portraits.pictures.format = "png";
  options.portraits.pictures.supersampling = 1;
  return options;
}

/// Made at the first call of the process, removed at its end.
inline const std::filesystem::path& SmallKit() {
  static const TempDir folder;
  static const std::filesystem::path kit = [] {
    benchmark::MakeBenchmark(SyntheticModel(), SmallKitOptions(), folder / "kit");
    return folder / "kit";
  }();
  return kit;
}

}  // namespace daumier::testing
