#include "runtime/strided_view.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::runtime {
namespace {

using Row = std::vector<int64_t>;

TEST(StridedView, PlacesFollowItsStrides) {
  EXPECT_EQ(PlacesOf({{2, 2}, {1, -3}, 4}), (Row{4, 1, 5, 2}));
  EXPECT_TRUE(LiesClose({{2, 1, 3}, {3, 99, 1}}));
  EXPECT_FALSE(LiesClose({{2, 3}, {1, 2}}));
}

/// The view of a node whose inputs from 1 on are `integers`.
StridedView Seen(const std::string& op, const Shape& from, const std::vector<Row>& integers,
                 std::map<std::string, GraphAttribute> attributes = {}) {
  GraphNode node{.op = op, .inputs = {"x"}, .attributes = std::move(attributes)};
  for (size_t i = 0; i < integers.size(); ++i) node.inputs.push_back("i");
  return ViewOf(node, from, [&](size_t input) -> const Row& { return integers.at(input - 1); });
}

TEST(StridedView, OfEachOperatorReadsTheElementsThatItTakes) {
  const Shape from = {2, 3};
  EXPECT_EQ(PlacesOf(Seen("Transpose", from, {})), (Row{0, 3, 1, 4, 2, 5}));
  EXPECT_EQ(PlacesOf(Seen("Slice", from, {{2}, {0}, {1}, {-1}})), (Row{2, 1, 5, 4}));
  EXPECT_EQ(
      PlacesOf(Seen("Split", from, {{1, 2}}, {{"axis", int64_t{1}}, {"part", int64_t{1}}, {"parts", int64_t{2}}})),
      (Row{1, 2, 4, 5}));
  EXPECT_EQ(PlacesOf(Seen("Expand", {1, 3}, {{2, 1}})), (Row{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(Seen("Reshape", from, {{-1, 2}}).shape, (Shape{3, 2}));
  EXPECT_EQ(Seen("Flatten", {2, 3, 4}, {}).shape, (Shape{2, 12}));
  EXPECT_EQ(Seen("Squeeze", {1, 3, 1}, {}).shape, Shape{3});
  EXPECT_EQ(Seen("Squeeze", {1, 3, 1}, {{0}}).shape, (Shape{3, 1}));
  EXPECT_EQ(Seen("Unsqueeze", from, {{0, -1}}).shape, (Shape{1, 2, 3, 1}));
  EXPECT_EQ(Seen("Identity", from, {}).shape, from);
  EXPECT_TRUE(IsViewOperator("Split"));
  EXPECT_FALSE(IsViewOperator("Gather"));
  testing::ExpectError([&] { Seen("Reshape", from, {{4, -1}}); }, "(2, 3) cannot be seen as (4, 1)");
  testing::ExpectError([&] { Seen("Squeeze", from, {{0}}); }, "axis 0 of (2, 3) is not 1");
}

TEST(StridedView, ShapesRepeatAlongAxesOfSizeOne) {
  EXPECT_EQ(BroadcastShape({2, 1, 4}, {3, 1}), (Shape{2, 3, 4}));
  EXPECT_EQ(BroadcastShape({1}, {0}), Shape{0});
  EXPECT_THROW(BroadcastShape({2, 3}, {4, 3}), Error);
}

TEST(StridedView, AxesCountFromTheEndWhereNegative) {
  EXPECT_EQ(AxisOf(-1, 4), 3u);
  EXPECT_EQ(AxisOf(2, 4), 2u);
  EXPECT_THROW(AxisOf(4, 4), Error);
  EXPECT_THROW(AxisOf(-5, 4), Error);
}

}  // namespace
}  // namespace daumier::runtime
