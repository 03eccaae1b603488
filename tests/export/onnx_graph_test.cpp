#include "export/onnx_graph.h"

#include "tests/support/expect_error.h"

#include <torch/types.h>

namespace daumier::exporting {
namespace {

TEST(OnnxGraph, HoldsVersionsAndFreesTheBatchDimension) {
  OnnxGraph graph("doubler");
  graph.AddInput("x", torch::zeros({2, 5}));
  const auto doubled = graph.AddNode("Add", {"x", "x"});
  graph.AddOutput("y", doubled, torch::zeros({2, 5}));
  const auto& model = graph.model();
  EXPECT_EQ(model.opset_import(0).version(), 13);
  EXPECT_EQ(model.ir_version(), 7);
  for (const auto& info : {model.graph().input(0), model.graph().output(0)}) {
    const auto& shape = info.type().tensor_type().shape();
    ASSERT_EQ(shape.dim_size(), 2);
    EXPECT_EQ(shape.dim(0).dim_param(), "N");
    EXPECT_EQ(shape.dim(1).dim_value(), 5);
  }
  EXPECT_EQ(model.graph().node(1).op_type(), "Identity");
  EXPECT_EQ(model.graph().node(1).input(0), doubled);
  EXPECT_EQ(model.graph().node(1).output(0), "y");
}

TEST(OnnxGraph, AFreeDimensionCanBeUnnamed) {
  OnnxGraph graph("test");
  graph.AddInput("x", torch::zeros({2, 5}));
  graph.UnnameBatch("x");
  const auto& shape = graph.model().graph().input(0).type().tensor_type().shape();
  EXPECT_FALSE(shape.dim(0).has_dim_param());
  EXPECT_FALSE(shape.dim(0).has_dim_value());
  EXPECT_EQ(shape.dim(1).dim_value(), 5);
}

TEST(OnnxGraph, NamesOfNodesAreNew) {
  OnnxGraph graph("test");
  EXPECT_NE(graph.AddNode("Relu", {"x"}), graph.AddNode("Relu", {"x"}));
}

TEST(OnnxGraph, KeepsAttributesOfEveryKind) {
  OnnxGraph graph("test");
  graph.AddNode("Op", {"x"}, {{"axis", int64_t{3}}, {"epsilon", 0.5f}, {"pads", std::vector<int64_t>{1, 2}}});
  const auto& node = graph.model().graph().node(0);
  EXPECT_EQ(node.attribute(0).i(), 3);
  EXPECT_EQ(node.attribute(1).f(), 0.5f);
  EXPECT_EQ(node.attribute(2).ints(1), 2);
}

TEST(OnnxGraph, StoresAnInitializerOnceRowMajor) {
  OnnxGraph graph("test");
  const auto weight = torch::arange(6, torch::kFloat32).view({2, 3}).t();
  EXPECT_EQ(graph.AddInitializer("w", weight), "w");
  EXPECT_EQ(graph.AddInitializer("w", weight), "w");
  ASSERT_EQ(graph.model().graph().initializer_size(), 1);
  const auto& stored = graph.model().graph().initializer(0);
  EXPECT_EQ(stored.dims(0), 3);
  EXPECT_EQ(stored.dims(1), 2);
  const auto* values = reinterpret_cast<const float*>(stored.raw_data().data());
  EXPECT_EQ(std::vector<float>(values, values + 6), (std::vector<float>{0, 3, 1, 4, 2, 5}));
}

TEST(OnnxGraph, ConstantsHaveNamesOfTheirOwn) {
  OnnxGraph graph("test");
  const auto first = graph.AddConstant(torch::ones({2})), second = graph.AddConstant(torch::zeros({2}));
  EXPECT_NE(first, second);
  EXPECT_EQ(graph.model().graph().initializer_size(), 2);
}

TEST(OnnxGraph, RefusesOtherElementTypes) {
  OnnxGraph graph("test");
  testing::ExpectError([&] { graph.AddInitializer("w", torch::zeros({2}, torch::kFloat64)); },
                       "'w' has element type Double");
}

}  // namespace
}  // namespace daumier::exporting
