#include "faces/annotation.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::faces {
namespace {

using testing::ExpectError;

TEST(Region, MissingOneIsNamedWithWhatNeedsIt) {
  Annotation annotation;
  annotation.regions["nose"] = {1, 2};
  EXPECT_EQ(RegionFor(annotation, "nose", "exaggeration").size(), 2u);
  ExpectError([&] { RegionFor(annotation, "ears", "exaggeration"); }, "exaggeration needs the region 'ears'");
}

TEST(CurveKinds, AreUniqueAndBeginWithTheSilhouette) {
  EXPECT_EQ(CurveKinds().size(), 10u);
  EXPECT_EQ(CurveKinds().front(), "silhouette");
  EXPECT_EQ(std::set<std::string>(CurveKinds().begin(), CurveKinds().end()).size(), CurveKinds().size());
}

}  // namespace
}  // namespace daumier::faces
