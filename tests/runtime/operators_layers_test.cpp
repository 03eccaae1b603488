#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <cmath>

namespace daumier::runtime {
namespace {

/// A convolution by its definition; weights (O, I/G, k, k) or, transposed, (I, O/G, k, k).
struct Reference {
  int64_t stride = 1, pad = 0, dilation = 1, groups = 1;

  FloatArray Convolve(const FloatArray& x, const FloatArray& w) const {
    const int64_t side = (x.shape[2] + 2 * pad - dilation * (w.shape[2] - 1) - 1) / stride + 1;
    FloatArray y({x.shape[0], w.shape[0], side, side});
    Each(x.shape[0], w, [&](int64_t n, int64_t o, int64_t i, int64_t from, int64_t ky, int64_t kx, float weight) {
      for (int64_t r = 0; r < side; ++r)
        for (int64_t c = 0; c < side; ++c) {
          const int64_t sr = r * stride - pad + ky * dilation, sc = c * stride - pad + kx * dilation;
          if (sr >= 0 && sr < x.shape[2] && sc >= 0 && sc < x.shape[3])
            At(y, n, o, r, c) += weight * Get(x, n, from + i, sr, sc);
        }
    });
    return y;
  }
  FloatArray Transposed(const FloatArray& x, const FloatArray& w) const {
    const int64_t outputs = w.shape[1] * groups, inputs = w.shape[0] / groups;
    const int64_t side = (x.shape[2] - 1) * stride + dilation * (w.shape[2] - 1) + 1 - 2 * pad;
    FloatArray y({x.shape[0], outputs, side, side});
    for (int64_t n = 0; n < x.shape[0]; ++n)
      for (int64_t i = 0; i < w.shape[0]; ++i)
        for (int64_t o = 0; o < w.shape[1]; ++o)
          for (int64_t ky = 0; ky < w.shape[2]; ++ky)
            for (int64_t kx = 0; kx < w.shape[3]; ++kx)
              for (int64_t r = 0; r < x.shape[2]; ++r)
                for (int64_t c = 0; c < x.shape[3]; ++c) {
                  const int64_t tr = r * stride - pad + ky * dilation, tc = c * stride - pad + kx * dilation;
                  if (tr >= 0 && tr < side && tc >= 0 && tc < side)
                    At(y, n, i / inputs * w.shape[1] + o, tr, tc) += Get(w, i, o, ky, kx) * Get(x, n, i, r, c);
                }
    return y;
  }

 private:
  static float& At(FloatArray& a, int64_t n, int64_t c, int64_t y, int64_t x) {
    return a.values[size_t(((n * a.shape[1] + c) * a.shape[2] + y) * a.shape[3] + x)];
  }
  static float Get(const FloatArray& a, int64_t n, int64_t c, int64_t y, int64_t x) {
    return a.values[size_t(((n * a.shape[1] + c) * a.shape[2] + y) * a.shape[3] + x)];
  }
  template <class Visit>
  void Each(int64_t batch, const FloatArray& w, const Visit& visit) const {
    for (int64_t n = 0; n < batch; ++n)
      for (int64_t o = 0; o < w.shape[0]; ++o)
        for (int64_t i = 0; i < w.shape[1]; ++i)
          for (int64_t ky = 0; ky < w.shape[2]; ++ky)
            for (int64_t kx = 0; kx < w.shape[3]; ++kx)
              visit(n, o, i, o / (w.shape[0] / groups) * w.shape[1], ky, kx, Get(w, o, i, ky, kx));
  }
};

std::map<std::string, GraphAttribute> Attributes(const Reference& reference) {
  return {{"strides", std::vector<int64_t>(2, reference.stride)},
          {"pads", std::vector<int64_t>(4, reference.pad)},
          {"dilations", std::vector<int64_t>(2, reference.dilation)},
          {"group", reference.groups}};
}

TEST(RuntimeConv, OnesCountTheNeighbours) {
  const GraphExample example = GraphExample({-1, 1, 3, 3})
                                   .Weight("w", {1, 1, 3, 3}, std::vector<float>(9, 1))
                                   .Node("Conv", {"x", "w"}, "y", {{"pads", std::vector<int64_t>{1, 1, 1, 1}}});
  const FloatArray y = example.Run(FloatArray({1, 1, 3, 3}, std::vector<float>(9, 1)));
  EXPECT_EQ(y.values, (std::vector<float>{4, 6, 4, 6, 9, 6, 4, 6, 4}));
}

TEST(RuntimeConv, EqualsItsDefinition) {
  struct Case {
    int64_t batch, inputs, outputs, side, kernel;
    Reference reference;
  };
  const Case cases[] = {{1, 1, 16, 9, 3, {1, 1}},   {2, 3, 5, 11, 3, {2, 1}},         {1, 16, 24, 8, 1, {1, 0}},
                        {7, 8, 8, 7, 3, {1, 2, 2}}, {1, 16, 32, 10, 3, {2, 1, 1, 2}}, {1, 12, 12, 6, 3, {1, 1, 1, 12}},
                        {1, 48, 26, 8, 1, {1, 0}},  {1, 1, 32, 32, 7, {4, 3}},        {2, 40, 40, 5, 5, {1, 2}}};
  for (const auto& [batch, inputs, outputs, side, kernel, reference] : cases) {
    const FloatArray w = FixedArray({outputs, inputs / reference.groups, kernel, kernel}, 3);
    const GraphExample example = GraphExample({-1, inputs, side, side})
                                     .Weight("w", w.shape, w.values)
                                     .Node("Conv", {"x", "w"}, "y", Attributes(reference));
    const FloatArray x = FixedArray({batch, inputs, side, side}, 5);
    SCOPED_TRACE(::testing::Message() << inputs << " to " << outputs << ", kernel " << kernel);
    ExpectNear(example.Run(x), reference.Convolve(x, w));
  }
}

TEST(RuntimeConv, OfOneAxisEqualsThatOfTwo) {
  const FloatArray w = FixedArray({6, 4, 3}, 3), x = FixedArray({2, 4, 10}, 4);
  const std::map<std::string, GraphAttribute> row = {{"pads", std::vector<int64_t>{1, 1}}};
  FloatArray y = GraphExample({-1, 4, 10}).Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "y", row).Run(x);
  const std::map<std::string, GraphAttribute> image = {{"pads", std::vector<int64_t>{0, 1, 0, 1}}};
  const FloatArray expected = GraphExample({-1, 4, 1, 10})
                                  .Weight("w", {6, 4, 1, 3}, w.values)
                                  .Node("Conv", {"x", "w"}, "y", image)
                                  .Run({{2, 4, 1, 10}, x.values});
  y.shape = expected.shape;
  ExpectNear(y, expected);
}

TEST(RuntimeConvTranspose, EqualsItsDefinition) {
  struct Case {
    int64_t inputs, outputs, kernel;
    Reference reference;
  };
  const Case cases[] = {{8, 16, 4, {2, 1}}, {3, 5, 2, {2, 0}}, {16, 8, 3, {1, 1}}, {16, 16, 4, {2, 1, 1, 2}}};
  for (const auto& [inputs, outputs, kernel, reference] : cases) {
    const FloatArray w = FixedArray({inputs, outputs / reference.groups, kernel, kernel}, 3);
    const FloatArray x = FixedArray({2, inputs, 6, 6}, 5);
    const GraphExample example = GraphExample({-1, inputs, 6, 6})
                                     .Weight("w", w.shape, w.values)
                                     .Node("ConvTranspose", {"x", "w"}, "y", Attributes(reference));
    SCOPED_TRACE(::testing::Message() << inputs << " to " << outputs << ", kernel " << kernel);
    ExpectNear(example.Run(x), reference.Transposed(x, w));
  }
}

TEST(RuntimeBatchNorm, ScalesAndShiftsEachChannel) {
  GraphExample example({-1, 2, 1, 2});
  example.Weight("scale", {2}, {2, 3}).Weight("shift", {2}, {10, 20}).Weight("mean", {2}, {1, 0});
  example.Weight("variance", {2}, {4, 9})
      .Node("BatchNormalization", {"x", "scale", "shift", "mean", "variance"}, "y", {{"epsilon", 0.0f}});
  EXPECT_EQ(example.Run({{1, 2, 1, 2}, {1, 3, 3, 6}}).values, (std::vector<float>{10, 12, 23, 26}));
}

TEST(RuntimeGemm, AddsItsBiasToEachRow) {
  GraphExample example({-1, 2});
  example.Weight("w", {3, 2}, {1, 0, 0, 1, 1, 1}).Weight("b", {3}, {10, 20, 30});
  example.Node("Gemm", {"x", "w", "b"}, "y", {{"transB", int64_t{1}}});
  EXPECT_EQ(example.Run({{2, 2}, {1, 2, 3, 4}}).values, (std::vector<float>{11, 22, 33, 13, 24, 37}));
}

TEST(RuntimeMatMul, RepeatsAxesBeforeTheMatrices) {
  GraphExample example({-1, 2, 2});
  example.Weight("w", {2, 1}, {1, 10}).Node("MatMul", {"x", "w"}, "y");
  const FloatArray y = example.Run({{2, 2, 2}, {1, 2, 3, 4, 5, 6, 7, 8}});
  EXPECT_EQ(y.shape, (Shape{2, 2, 1}));
  EXPECT_EQ(y.values, (std::vector<float>{21, 43, 65, 87}));
  GraphExample batches({2, 1, 2});
  batches.graph.inputs.push_back({"z", {2, 2, 1}});
  batches.Node("MatMul", {"x", "z"}, "y");
  EXPECT_EQ(batches.Run({{2, 1, 2}, {1, 2, 3, 4}}, {{2, 2, 1}, {1, 1, 1, 10}}).values, (std::vector<float>{3, 43}));
}

TEST(RuntimeConv, RefusesWhatDoesNotFit) {
  const auto error_of = [](Shape weights, std::map<std::string, GraphAttribute> attributes, const std::string& part) {
    int64_t size = 1;
    for (const int64_t n : weights) size *= n;
    const GraphExample example = GraphExample({1, 4, 5, 5})
                                     .Weight("w", weights, std::vector<float>(size_t(size), 1))
                                     .Node("Conv", {"x", "w"}, "y", attributes);
    testing::ExpectError([&] { example.Run(FloatArray({1, 4, 5, 5})); }, part);
  };
  error_of({8, 3, 3, 3}, {}, "the image has 4 channels, the weights are (8, 3, 3, 3)");
  error_of({8, 4, 7, 7}, {}, "its window of 7 is larger than the padded image of 5");
  error_of({8, 4, 3, 3}, {{"strides", std::vector<int64_t>{0, 1}}}, "out of range");
  error_of({8, 4, 3, 3}, {{"pads", std::vector<int64_t>{1}}}, "not of 2 axes");
  error_of({8, 4, 3, 3}, {{"group", int64_t{3}}}, "3 groups do not divide");
  error_of({8, 4, 3, 3}, {{"pads", std::vector<int64_t>(4, 60000)}}, "at most");
  error_of({8, 4, 3}, {}, "expected (N, C, W) or (N, C, H, W)");
}

}  // namespace
}  // namespace daumier::runtime
