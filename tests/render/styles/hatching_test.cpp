#include "render/styles/hatching.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::MeanOfPlane;

TEST(Hatch, CoversMoreWhereItIsDarker) {
  double last = -1;
  for (const float dark : {0.0f, 0.2f, 0.45f, 0.7f, 1.0f}) {
    Rng rng(5);
    const double coverage = MeanOfPlane(Hatch(Plane(80, 80, dark), {}, rng));
    EXPECT_GT(coverage, last);
    last = coverage;
  }
  EXPECT_GT(last, 0.75);
  Rng rng(5);
  EXPECT_EQ(MeanOfPlane(Hatch(Plane(20, 20, 0.02f), {}, rng)), 0);
}

}  // namespace
}  // namespace daumier::render
