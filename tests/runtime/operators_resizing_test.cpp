#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

namespace daumier::runtime {
namespace {

FloatArray Ramp(int64_t height, int64_t width) {
  FloatArray x({1, 1, height, width});
  for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = float(i);
  return x;
}

std::map<std::string, GraphAttribute> Mode(const std::string& mode, const std::string& places) {
  return {{"mode", mode}, {"coordinate_transformation_mode", places}, {"nearest_mode", std::string("floor")}};
}

TEST(RuntimeResize, NearestRepeatsPixels) {
  GraphExample example({1, 1, 2, 2});
  example.Weight("s", {4}, {1, 1, 2, 2}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  EXPECT_EQ(example.Run(Ramp(2, 2)).values, (std::vector<float>{0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3}));
  GraphExample smaller({1, 1, 4, 4});
  smaller.Weight("s", {4}, {1, 1, 0.5f, 0.5f}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  EXPECT_EQ(smaller.Run(Ramp(4, 4)).values, (std::vector<float>{0, 2, 8, 10}));
}

TEST(RuntimeResize, NearestInBlocksKeepsThePaddingZero) {
  GraphExample example({1, 1, 3, 3});  // 12 channels in two blocks of 8; a convolution reads all 16.
  example.Weight("w", {12, 1, 1, 1}, std::vector<float>(12, 1)).Node("Conv", {"x", "w"}, "c");
  example.Weight("s", {4}, {1, 1, 2, 2}).Node("Resize", {"c", "", "s"}, "r", Mode("nearest", "asymmetric"));
  example.Weight("v", {1, 12, 1, 1}, std::vector<float>(12, 1)).Node("Conv", {"r", "v"}, "y");
  const FloatArray y = example.Run(Ramp(3, 3));
  for (size_t row = 0; row < 6; ++row)
    for (size_t column = 0; column < 6; ++column)
      EXPECT_EQ(y.values[6 * row + column], 12 * float(row / 2 * 3 + column / 2));
}

TEST(RuntimeResize, LinearIsExactOnALine) {
  GraphExample half({1, 1, 1, 2});
  half.Weight("s", {4}, {1, 1, 1, 2}).Node("Resize", {"x", "", "s"}, "y", Mode("linear", "half_pixel"));
  EXPECT_EQ(half.Run({{1, 1, 1, 2}, {0, 4}}).values, (std::vector<float>{0, 1, 3, 4}));
  GraphExample aligned({1, 1, 1, 2});
  aligned.Weight("s", {4}, {1, 1, 1, 2.5f}).Node("Resize", {"x", "", "s"}, "y", Mode("linear", "align_corners"));
  EXPECT_EQ(aligned.Run({{1, 1, 1, 2}, {0, 4}}).values, (std::vector<float>{0, 1, 2, 3, 4}));
}

TEST(RuntimeResize, RefusesOtherModes) {
  const auto refused = [](const std::map<std::string, GraphAttribute>& mode, const std::string& part) {
    GraphExample example({1, 1, 2, 2});
    example.Weight("s", {4}, {1, 1, 0.5f, 2}).Node("Resize", {"x", "", "s"}, "y", mode);
    testing::ExpectError([&] { example.Run(Ramp(2, 2)); }, part);
  };
  refused(Mode("quintic", "half_pixel"), "there is no resizing of mode quintic");
  refused(Mode("linear", "tf_crop_and_resize"), "there is no resizing at tf_crop_and_resize places");
  refused({{"antialias", int64_t{1}}}, "antialias is not read");
  GraphExample huge({1, 1, 2, 2});
  huge.Weight("s", {4}, {1, 1, 1e9f, 1e9f}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  testing::ExpectError([&] { huge.Run(Ramp(2, 2)); }, "are no image");
  GraphExample negative({1, 1, 2, 2});
  negative.Weight("s", {4}, {1, 1, -1, 1}).Node("Resize", {"x", "", "s"}, "y", Mode("nearest", "asymmetric"));
  testing::ExpectError([&] { negative.Run(Ramp(2, 2)); }, "are no image");
}

TEST(RuntimeResize, TakesSizesOfAllAxesOrOfSome) {
  GraphExample all({1, 1, 1, 2});
  all.Integers("s", {1, 1, 1, 3}).Node("Resize", {"x", "", "", "s"}, "y", Mode("linear", "align_corners"));
  EXPECT_EQ(all.Run({{1, 1, 1, 2}, {0, 4}}).values, (std::vector<float>{0, 2, 4}));
  GraphExample some({1, 1, 1, 2});
  std::map<std::string, GraphAttribute> mode = Mode("linear", "align_corners");
  mode["axes"] = std::vector<int64_t>{3};
  some.Integers("s", {3}).Node("Resize", {"x", "", "", "s"}, "y", mode);
  EXPECT_EQ(some.Run({{1, 1, 1, 2}, {0, 4}}).values, (std::vector<float>{0, 2, 4}));
  GraphExample batch({1, 1, 1, 2});
  batch.Integers("s", {2, 1, 1, 3}).Node("Resize", {"x", "", "", "s"}, "y", Mode("linear", "align_corners"));
  testing::ExpectError([&] { batch.Run({{1, 1, 1, 2}, {0, 4}}); }, "the first two are those of (1, 1, 1, 2)");
}

TEST(RuntimeResize, CubicKeepsConstantsAndLines) {
  GraphExample example({1, 1, 5, 5});
  example.Weight("s", {4}, {1, 1, 2, 2}).Node("Resize", {"x", "", "s"}, "y", Mode("cubic", "half_pixel"));
  ExpectNear(example.Run({{1, 1, 5, 5}, std::vector<float>(25, 3)}), {{1, 1, 10, 10}, std::vector<float>(100, 3)},
             1e-6);
  // Of the coefficient -0.5 alone, away from borders, the cubic is exact on a line.
  GraphExample line({1, 1, 1, 6});
  std::map<std::string, GraphAttribute> keys = Mode("cubic", "half_pixel");
  keys["cubic_coeff_a"] = -0.5f;
  line.Weight("s", {4}, {1, 1, 1, 2}).Node("Resize", {"x", "", "s"}, "y", keys);
  const FloatArray y = line.Run(Ramp(1, 6));
  for (size_t i = 4; i < 8; ++i) EXPECT_NEAR(y.values[i], (double(i) + 0.5) / 2 - 0.5, 1e-5);
}

TEST(RuntimeResize, InBlocksEqualsThatOfPlainImages) {
  const FloatArray x = FixedArray({2, 12, 7, 6}), w = FixedArray({12, 12, 1, 1}, 3);
  for (const char* places : {"half_pixel", "asymmetric", "align_corners"}) {
    for (const char* mode : {"nearest", "linear", "cubic"}) {
      SCOPED_TRACE(std::string(mode) + " " + places);
      GraphExample blocked({-1, 12, 7, 6}, {"c", "y"}), plain({-1, 12, 7, 6});
      blocked.Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "c");
      for (auto& [example, input] : {std::pair(&blocked, "c"), std::pair(&plain, "x")})
        example->Integers("s", {2, 12, 9, 11}).Node("Resize", {input, "", "", "s"}, "y", Mode(mode, places));
      const NamedArrays outputs = GraphRunner(blocked.graph).Run({{"x", x}});
      ExpectNear(outputs.at("y"), plain.Run(outputs.at("c")), 1e-6);
    }
  }
}

}  // namespace
}  // namespace daumier::runtime
