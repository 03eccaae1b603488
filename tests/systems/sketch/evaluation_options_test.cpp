#include "systems/sketch/evaluation_options.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(SketchEvalOptions, OtherFacesNeedTheirSketches) {
  EXPECT_NO_THROW(CheckEvalOptions({.faces = "a", .sketches = "b"}));
  testing::ExpectError([] { CheckEvalOptions({.faces = "a"}); }, "give both 'faces' and 'sketches'");
  testing::ExpectError([] { CheckEvalOptions({.sketches = "b"}); }, "give both 'faces' and 'sketches'");
}

TEST(SketchEvalOptions, OtherFacesExcludeSubsetsOfTheSplit) {
  const SketchEvalOptions others{.faces = "a", .sketches = "b"};
  const auto expect = [&](const char* key, auto&& change) {
    SketchEvalOptions options = others;
    change(options);
    testing::ExpectError([&] { CheckEvalOptions(options); }, std::string("faces excludes ") + key);
    options.faces = options.sketches = "";
    EXPECT_NO_THROW(CheckEvalOptions(options)) << key;
  };
  expect("split", [](SketchEvalOptions& options) { options.split = "validation"; });
  expect("recover_with", [](SketchEvalOptions& options) { options.recover_with = "run"; });
  expect("refine", [](SketchEvalOptions& options) { options.refine = true; });
  expect("deform", [](SketchEvalOptions& options) { options.deform = true; });
  expect("fit", [](SketchEvalOptions& options) { options.fit = true; });
  expect("styled", [](SketchEvalOptions& options) { options.styled = true; });
  expect("strokes", [](SketchEvalOptions& options) { options.strokes = 200; });
}

}  // namespace
}  // namespace daumier::sketch
