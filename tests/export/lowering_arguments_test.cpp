#include "export/lowering_arguments.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/csrc/jit/ir/ir.h>
#include <torch/csrc/jit/ir/irparser.h>

namespace daumier::exporting {
namespace {

using Integers = std::vector<int64_t>;

/// The last node of a graph in text.
class ArgumentsTest : public ::testing::Test {
 protected:
  const torch::jit::Node& Parse(const std::string& text) {
    graph_ = std::make_shared<torch::jit::Graph>();
    torch::jit::parseIR(text, graph_.get());
    return **std::prev(graph_->nodes().end());
  }

  std::shared_ptr<torch::jit::Graph> graph_;
};

TEST_F(ArgumentsTest, AreFoundByNameAndCountedFromZero) {
  const Arguments in(Parse(R"IR(
graph(%x : Float(2, 5, 6, strides=[30, 6, 1])):
  %one : int = prim::Constant[value=1]()
  %last : int = prim::Constant[value=-1]()
  %axes : int[] = prim::ListConstruct(%last, %one)
  %keep : bool = prim::Constant[value=1]()
  %none : NoneType = prim::Constant()
  %y : Float(2, 1, 1, strides=[1, 1, 1]) = aten::sum(%x, %axes, %keep, %none)
  return (%y))IR"));
  EXPECT_EQ(in.Integers("dim"), (Integers{-1, 1}));
  EXPECT_EQ(in.Axes("dim", 3), (Integers{1, 2}));
  EXPECT_TRUE(in.Flag("keepdim"));
  EXPECT_TRUE(in.IsAbsent("dtype"));
  EXPECT_TRUE(in.IsAbsent("no_such_argument"));
  EXPECT_FALSE(in.Has("no_such_argument"));
  EXPECT_EQ(in.Shape(0), (Integers{2, 5, 6}));
  EXPECT_EQ(in.OutputShape(), (Integers{2, 1, 1}));
  testing::ExpectError([&] { in.Integer("no_such_argument"); }, "has no argument 'no_such_argument'");
}

TEST_F(ArgumentsTest, OneThatDependsOnTheInputIsAnError) {
  const Arguments in(Parse(R"IR(
graph(%x : Float(2, 5, strides=[5, 1]), %axis : int):
  %none : NoneType = prim::Constant()
  %y : Float(2, 5, strides=[5, 1]) = aten::softmax(%x, %axis, %none)
  return (%y))IR"));
  testing::ExpectError([&] { in.Axis("dim", 2); }, "'dim' depends on the input");
}

TEST_F(ArgumentsTest, ATensorWithoutAShapeIsAnError) {
  const Arguments in(Parse(R"IR(
graph(%x : Tensor):
  %y : Tensor = aten::relu(%x)
  return (%y))IR"));
  testing::ExpectError([&] { in.Shape(0); }, "has no shape of %x");
}

}  // namespace
}  // namespace daumier::exporting
