#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

namespace daumier::runtime {
namespace {

FloatArray CountedUp(Shape shape) {
  FloatArray x(std::move(shape));
  for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = float(i);
  return x;
}

TEST(RuntimePad, SurroundsByConstantsEdgesAndMirrorImages) {
  const auto pad = [](const std::string& mode, std::vector<int64_t> pads) {
    GraphExample example({1, 3});
    example.Integers("p", std::move(pads)).Weight("c", {}, {7}).Node("Pad", {"x", "p", "c"}, "y", {{"mode", mode}});
    return example.Run({{1, 3}, {1, 2, 3}}).values;
  };
  EXPECT_EQ(pad("constant", {0, 1, 1, 0}), (std::vector<float>{7, 1, 2, 3, 7, 7, 7, 7}));
  EXPECT_EQ(pad("edge", {0, 2, 0, 1}), (std::vector<float>{1, 1, 1, 2, 3, 3}));
  EXPECT_EQ(pad("reflect", {0, 2, 0, 1}), (std::vector<float>{3, 2, 1, 2, 3, 2}));
  testing::ExpectError([&] { pad("reflect", {0, 3, 0, 0}); }, "it pads 3 pixels by 3 and 0");
  testing::ExpectError([&] { pad("constant", {0, -1, 0, 0}); }, "it pads 3 pixels by -1");
  testing::ExpectError([&] { pad("constant", {1, 1, 1}); }, "it has 3 pads for 2 axes");
}

TEST(RuntimePad, TakesTheAxesThatItNames) {
  GraphExample example({2, 2});
  example.Integers("p", {1, 0}).Integers("a", {-1}).Weight("c", {}, {9});
  example.Node("Pad", {"x", "p", "c", "a"}, "y");
  EXPECT_EQ(example.Run({{2, 2}, {1, 2, 3, 4}}).values, (std::vector<float>{9, 1, 2, 9, 3, 4}));
}

TEST(RuntimePad, InBlocksEqualsThatOfPlainImages) {
  const FloatArray x = FixedArray({2, 12, 5, 4}), w = FixedArray({12, 12, 1, 1}, 3);
  for (const char* mode : {"constant", "reflect", "edge"}) {
    for (const float value : {0.0f, 7.0f}) {
      SCOPED_TRACE(mode);
      GraphExample blocked({-1, 12, 5, 4}, {"c", "y"}), plain({-1, 12, 5, 4});
      blocked.Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "c");
      for (auto& [example, input] : {std::pair(&blocked, "c"), std::pair(&plain, "x")})
        example->Integers("p", {0, 0, 1, 2, 0, 0, 3, 0})
            .Weight("v", {}, {value})
            .Node("Pad", {input, "p", "v"}, "y", {{"mode", std::string(mode)}});
      const NamedArrays outputs = GraphRunner(blocked.graph).Run({{"x", x}});
      EXPECT_EQ(outputs.at("y").values, plain.Run(outputs.at("c")).values);
    }
  }
}

TEST(RuntimePad, OfHugeSizesIsRefusedBeforeMemoryIsTaken) {
  GraphExample example({1, 1});
  example.Integers("p", {kMostNumbers, kMostNumbers, kMostNumbers, kMostNumbers}).Node("Pad", {"x", "p"}, "y");
  testing::ExpectError([&] { example.Run(FloatArray({1, 1})); }, "numbers are read");
}

TEST(RuntimeGather, TakesRowsByIndices) {
  GraphExample example({2, 3});
  example.Integers("i", {2, -3}).Node("Gather", {"x", "i"}, "y", {{"axis", int64_t{1}}});
  EXPECT_EQ(example.Run(CountedUp({2, 3})).values, (std::vector<float>{2, 0, 5, 3}));
  GraphExample outside({2, 3});
  outside.Integers("i", {3}).Node("Gather", {"x", "i"}, "y", {{"axis", int64_t{1}}});
  testing::ExpectError([&] { outside.Run(CountedUp({2, 3})); }, "there is no index 3 of 3");
}

TEST(RuntimeDepth, BecomesSpaceByEitherOrder) {
  const auto space = [](const std::string& mode) {
    GraphExample example({1, 8, 1, 1});
    example.Node("DepthToSpace", {"x"}, "y", {{"blocksize", int64_t{2}}, {"mode", mode}});
    const FloatArray y = example.Run(CountedUp({1, 8, 1, 1}));
    EXPECT_EQ(y.shape, (Shape{1, 2, 2, 2}));
    return y.values;
  };
  EXPECT_EQ(space("DCR"), (std::vector<float>{0, 2, 4, 6, 1, 3, 5, 7}));
  EXPECT_EQ(space("CRD"), (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(RuntimeDepth, OfSpaceAndBackIsTheImage) {
  const FloatArray x = FixedArray({2, 3, 4, 6});
  GraphExample example({-1, 3, 4, 6});
  example.Node("SpaceToDepth", {"x"}, "d", {{"blocksize", int64_t{2}}});
  example.Node("DepthToSpace", {"d"}, "y", {{"blocksize", int64_t{2}}});
  EXPECT_EQ(example.Run(x).values, x.values);
  GraphExample odd({1, 3, 3, 3});
  odd.Node("SpaceToDepth", {"x"}, "y", {{"blocksize", int64_t{2}}});
  testing::ExpectError([&] { odd.Run(FloatArray({1, 3, 3, 3})); }, "no blocks of 2 pixels");
}

}  // namespace
}  // namespace daumier::runtime
