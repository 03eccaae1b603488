#include "reports/chosen_faces.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(ChooseFaces, AreTheMedianTheWorstFivePercentTheWorstAndTheFirst) {
  const std::vector<ChosenFace> chosen = ChooseFaces({10, 11, 12, 13, 14}, {5, 1, 4, 2, 3});
  ASSERT_EQ(chosen.size(), 4u);
  EXPECT_EQ(chosen[0].face, 14);
  EXPECT_EQ(chosen[1].face, 10);
  EXPECT_EQ(chosen[2].face, 10);
  EXPECT_EQ(chosen[3].face, 10);
  EXPECT_EQ(chosen[2].title, "worst");
  std::vector<int> faces(101);
  std::vector<double> errors(101);
  for (int i = 0; i <= 100; ++i) faces[size_t(i)] = i, errors[size_t(i)] = i;
  EXPECT_EQ(ChooseFaces(faces, errors)[1].face, 95);
  EXPECT_EQ(ChooseFaces({7}, {1})[0].face, 7);
  testing::ExpectError([] { ChooseFaces({}, {}); }, "0 faces");
  testing::ExpectError([] { ChooseFaces({1, 2}, {1}); }, "2 faces have 1 errors");
}

}  // namespace
}  // namespace daumier::reports
