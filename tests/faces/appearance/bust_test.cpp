#include "faces/appearance/bust.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Bust, ContinuesTheNeckWithClosedSurfaces) {
  std::vector<geometry::Vector3> border;
  for (int k = 0; k < 40; ++k) border.emplace_back(5 * std::sin(k * 0.157), -10, 6 * std::cos(k * 0.157));
  for (const CollarStyle collar : {CollarStyle::kRound, CollarStyle::kHigh, CollarStyle::kOpen}) {
    Looks looks;
    looks.collar = collar;
    HeadSoup soup = testing::EmptySoup();
    AddBust(border, {0.8f, 0.6f, 0.5f}, 1, looks, soup);
    const PortraitHead bust = soup.Take();
    testing::ExpectClosedSoup(bust);
    EXPECT_GT(testing::VolumeOf(bust), 1000);
    EXPECT_LT(bust.vertices.col(1).maxCoeff(), -8) << "under the head";
    EXPECT_GT(bust.vertices.col(0).maxCoeff(), 18) << "shoulders";
  }
  HeadSoup none = testing::EmptySoup();
  AddBust({}, {1, 1, 1}, 1, Looks{}, none);
  EXPECT_EQ(none.size(), 0);
}

}  // namespace
}  // namespace daumier::faces
