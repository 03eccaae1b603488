#include "runtime/image_network.h"
#include "runtime/onnx_file.h"
#include "tests/runtime/graph_example.h"
#include "tests/support/paths.h"

namespace daumier::runtime {
namespace {

/// A network in the form of another exporter (tests/fuzz/make_style_networks.py), and every sixth part of its output as
/// ONNX Runtime computes it from FixedArray: tools/npm/run_onnx.mjs, onnxruntime-node 1.30.0.
struct StyleNetwork {
  std::string name;
  Shape shape;
  std::vector<float> numbers;
};

const std::vector<StyleNetwork> kNetworks = {
    {"style_nearest", {1, 3, 16, 16}, {-0.83645f, -0.3819336f, -0.1676921f, 0.394347f, 0.8018147f, 0.6142516f}},
    {"style_groups", {1, 3, 16, 16}, {-0.9981963f, -0.9992849f, 0.6142708f, 0.6697354f, 0.9997933f, 0.9999384f}},
    {"style_last", {1, 16, 16, 3}, {0.6712943f, -1, -0.6232224f, 0.8959911f, -1, -1}},
    {"style_transposed", {1, 3, 16, 16}, {-0.9605949f, -0.8315638f, 0.2340614f, 0.1243221f, -0.682814f, 0.1838093f}},
    {"shapes", {1, 3, 7, 9}, {18.22884f, 18.22867f, 18.42232f, 18.27613f, 18.15536f, 18.18018f}}};

std::filesystem::path FileOf(const StyleNetwork& network) {
  return testing::SourceRoot() / "tests/fuzz/seeds/onnx" / (network.name + ".onnx");
}

TEST(StyleNetworks, HaveTheNumbersOfOnnxRuntime) {
  for (const StyleNetwork& network : kNetworks) {
    SCOPED_TRACE(network.name);
    const Graph graph = ReadOnnx(FileOf(network));
    const FloatArray y = GraphRunner(graph).Run({{"x", FixedArray(graph.inputs.at(0).shape)}}).at("y");
    ASSERT_EQ(y.shape, network.shape);
    for (size_t i = 0; i < network.numbers.size(); ++i)
      EXPECT_NEAR(y.values[i * (y.values.size() / network.numbers.size())], network.numbers[i], 3e-5);
  }
}

TEST(StyleNetworks, ReadPictures) {
  for (const StyleNetwork& network : kNetworks) {
    if (network.name == "shapes") continue;
    SCOPED_TRACE(network.name);
    const ImageNetwork reader(FileOf(network));
    EXPECT_EQ(reader.input().height, 16);
    EXPECT_EQ(reader.input().layout,
              network.name == "style_last" ? ImageLayout::kChannelsLast : ImageLayout::kChannelsFirst);
    EXPECT_EQ(reader.Run(FixedArray({16, 16, 3})).shape, (Shape{16, 16, 3}));
  }
}

}  // namespace
}  // namespace daumier::runtime
