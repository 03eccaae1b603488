#include "faces/source.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Source, IctNeedsAPath) {
  EXPECT_THROW(LoadFaceModel({.name = "ict", .path = ""}), UsageError);
}

TEST(Source, MissingPathsAreNamed) {
  testing::ExpectError([] { LoadFaceModel({.name = "ict", .path = "/no/such/ict"}); }, "/no/such/ict");
  testing::ExpectError([] { LoadFaceModel({.name = "makehuman", .path = "/no/such/makehuman"}); },
                       "/no/such/makehuman");
}

TEST(Source, OptionsKnowTheSources) {
  EXPECT_THROW(ParseOptions<SourceOptions>(Json{{"name", "wax"}}), UsageError);
  EXPECT_EQ(ParseOptions<SourceOptions>(Json{{"name", "ict"}, {"path", "a.tar.xz"}}).path, "a.tar.xz");
}

}  // namespace
}  // namespace daumier::faces
