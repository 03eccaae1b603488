#include "runtime/onnx_file.h"

#include "core/files.h"
#include "core/safetensors.h"
#include "runtime/graph_runner.h"
#include "tests/runtime/onnx_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::runtime {
namespace {

class OnnxFile : public ::testing::Test {
 protected:
  Graph Read(const std::string& bytes) const {
    WriteFileAtomically(folder_ / "model.onnx", bytes);
    return ReadOnnx(folder_ / "model.onnx");
  }
  void ExpectRefused(const std::string& bytes, const std::string& part) const {
    testing::ExpectError([&] { Read(bytes); }, "model.onnx: ");
    testing::ExpectError([&] { Read(bytes); }, part);
  }
  /// x to y by these nodes and tensors.
  static std::string Model(const std::string& nodes, const std::string& tensors = "") {
    return OnnxModel(nodes + tensors + BytesField(11, OnnxValue("x", {-1, 2})) +
                     BytesField(12, OnnxValue("y", {-1, 2})));
  }

  const testing::TempDir folder_;
};

TEST_F(OnnxFile, IsReadAsItIsWritten) {
  const Graph graph = Read(OnesModel());
  EXPECT_EQ(graph.name, "ones");
  ASSERT_EQ(graph.inputs.size(), 1u);
  EXPECT_EQ(graph.inputs[0].name, "x");
  EXPECT_EQ(graph.inputs[0].shape, (Shape{-1, 1, 3, 3}));
  EXPECT_EQ(graph.outputs, std::vector<std::string>{"y"});
  ASSERT_EQ(graph.nodes.size(), 1u);
  EXPECT_EQ(graph.nodes[0].op, "Conv");
  EXPECT_EQ(graph.nodes[0].Integers("pads", {}), (std::vector<int64_t>{1, 1, 1, 1}));
  EXPECT_EQ(graph.weights.at("w").numbers, std::vector<float>(9, 1));
  const NamedArrays outputs = GraphRunner(graph).Run({{"x", {{1, 1, 3, 3}, std::vector<float>(9, 1)}}});
  EXPECT_EQ(outputs.at("y").values, (std::vector<float>{4, 6, 4, 6, 9, 6, 4, 6, 4}));
}

TEST_F(OnnxFile, ReadsExternalTensorsByTheirNames) {
  const std::vector<Half> halves = {HalfFromFloat(1.5f), HalfFromFloat(-2)};
  const std::vector<float> floats = {3, 4};
  SafetensorsWriter writer;
  writer.Add<Half>("a", {2}, halves);
  writer.Add<float>("b", {2}, floats);
  writer.Write(folder_ / "network.safetensors");
  const auto model = [&](const std::string& location, const std::vector<int64_t>& shape) {
    return Model(
        BytesField(1, OnnxNode("Mul", {"x", "a"}, "m")) + BytesField(1, OnnxNode("Add", {"m", "b"}, "y")),
        BytesField(5, ExternalTensor("a", shape, location)) + BytesField(5, ExternalTensor("b", {2}, location)));
  };
  const Graph graph = Read(model("network.safetensors", {2}));
  EXPECT_EQ(graph.weights.at("a").numbers, (std::vector<float>{1.5f, -2}));
  EXPECT_EQ(graph.weights.at("b").numbers, floats);
  ExpectRefused(model("network.safetensors", {1, 2}), "the tensor 'a' is (2) in network.safetensors (expected (1, 2))");
  ExpectRefused(model("../network.safetensors", {2}), "expected a safetensors file of the same folder");
  ExpectRefused(model("/etc/passwd", {2}), "expected a safetensors file of the same folder");
  ExpectRefused(model("missing.safetensors", {2}), "missing.safetensors");
}

TEST_F(OnnxFile, HostileOnesAreRefused) {
  const std::string relu = BytesField(1, OnnxNode("Relu", {"x"}, "y"));
  EXPECT_NO_THROW(Read(Model(relu)));
  ExpectRefused("", "it holds no graph");
  ExpectRefused("no model at all", "");
  ExpectRefused(Model(relu).substr(0, 20), "the file ends within");
  ExpectRefused(OnnxModel("", 8), "it uses version 8 of ONNX's operators (9 to 21 are read)");
  ExpectRefused(OnnxModel("", 22), "it uses version 22");
  ExpectRefused(Model(relu) + BytesField(7, ""), "it has two graphs");
  ExpectRefused(Model(BytesField(1, OnnxNode("Relu", {"z"}, "y"))), "reads 'z', which no earlier node computes");
  ExpectRefused(
      Model(BytesField(1, OnnxNode("Add", {"x", "b"}, "a")) + BytesField(1, OnnxNode("Relu", {"a"}, "b")) + relu),
      "reads 'b', which no earlier node computes");
  ExpectRefused(Model(relu + relu), "the name 'y' is given to two tensors");
  ExpectRefused(Model(BytesField(1, OnnxNode("Relu", {"x"}, "q"))), "no node computes the output 'y'");
  ExpectRefused(Model(BytesField(1, OnnxNode("Relu", {"x"}, "y", BytesField(7, "mine")))), "is of the domain 'mine'");
  ExpectRefused(Model(BytesField(1, OnnxNode("Relu", {"x"}, "y", BytesField(2, "second")))), "has 2 outputs");
  ExpectRefused(
      Model(BytesField(1, OnnxNode("If", {"x"}, "y", BytesField(5, BytesField(1, "g") + IntegerField(20, 5))))),
      "the attribute 'g' has the type 5");
}

TEST_F(OnnxFile, TensorsThatAreNotWhatTheySayAreRefused) {
  const auto with = [](const std::string& tensor) {
    return Model(BytesField(1, OnnxNode("Mul", {"x", "w"}, "y")), BytesField(5, tensor));
  };
  EXPECT_NO_THROW(Read(with(OnnxTensor("w", {2}, {1, 2}))));
  ExpectRefused(with(OnnxTensor("w", {3}, {1, 2})), "the tensor 'w' has 8 bytes, expected 12 for (3)");
  ExpectRefused(with(OnnxTensor("w", {-1}, {1})), "the tensor 'w' has the shape (-1)");
  ExpectRefused(with(OnnxTensor("w", {int64_t{1} << 40, int64_t{1} << 40}, {1})), "at most 268435456 numbers are read");
  ExpectRefused(with(OnnxTensor("w", std::vector<int64_t>(9, 1), {1})), "more than 8 dimensions");
  ExpectRefused(with(OnnxTensor("w", {2}, {1, std::numeric_limits<float>::quiet_NaN()})), "not finite");
  ExpectRefused(with(OnnxTensor("w", {2}, {1, std::numeric_limits<float>::infinity()})), "not finite");
  ExpectRefused(with(OnnxTensor("w", {2}, {1, 2}) + IntegerField(2, 10)), "has 8 bytes, expected 4");
  ExpectRefused(with(OnnxTensor("w", {2}, {1, 2}) + IntegerField(2, 14)), "the element type 14");
  ExpectRefused(with(OnnxTensor("w", {2}, {1, 2}) + IntegerField(2, 8)), "the element type 8");
  ExpectRefused(with(IntegerField(1, 1) + IntegerField(2, 1) + BytesField(8, "w") + BytesField(4, "abc")),
                "3 bytes hold no numbers of 4 bytes");
  ExpectRefused(with(IntegerField(1, 3) + IntegerField(2, 1) + BytesField(8, "w") + BytesField(4, "abcd")),
                "has 1 numbers, expected 3");
  ExpectRefused(with(IntegerField(1, 1) + IntegerField(2, 8) + BytesField(8, "w") + BytesField(6, "abcd")),
                "has data in field 6");
  ExpectRefused(with(OnnxTensor("x", {2}, {1, 2})), "");
}

TEST_F(OnnxFile, WeightsAmongTheInputsAreNone) {
  const std::string mul = BytesField(1, OnnxNode("Mul", {"x", "w"}, "y")) + BytesField(11, OnnxValue("w", {2}));
  const Graph graph = Read(Model(mul, BytesField(5, OnnxTensor("w", {2}, {1, 2}))));
  ASSERT_EQ(graph.inputs.size(), 1u);
  EXPECT_EQ(graph.inputs[0].name, "x");
}

TEST_F(OnnxFile, InputsAreRealNumbersOrBytes) {
  const auto model = [](int64_t type) {
    return OnnxModel(BytesField(1, OnnxNode("Cast", {"x"}, "y", IntegerAttribute("to", 1))) +
                     BytesField(11, OnnxValue("x", {2}, type)) + BytesField(12, OnnxValue("y", {2})));
  };
  EXPECT_FALSE(Read(model(1)).inputs.at(0).is_bytes);
  EXPECT_FALSE(Read(model(10)).inputs.at(0).is_bytes);
  EXPECT_TRUE(Read(model(2)).inputs.at(0).is_bytes);
  ExpectRefused(model(7), "the input 'x' has the element type 7");
}

TEST_F(OnnxFile, NodesWithoutANameHaveThatOfTheirOutput) {
  const std::string node = BytesField(1, "x") + BytesField(2, "y") + BytesField(4, "Relu");
  EXPECT_EQ(Read(Model(BytesField(1, node))).nodes.at(0).name, "y");
}

TEST_F(OnnxFile, ExternalDataAreRefusedWithARepair) {
  ExpectRefused(Model(BytesField(1, OnnxNode("Mul", {"x", "w"}, "y")),
                      BytesField(5, ExternalTensor("w", {2}, "model.onnx.data"))),
                "save_as_external_data=False");
}

}  // namespace
}  // namespace daumier::runtime
