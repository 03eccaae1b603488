#include "runtime/image_network.h"

#include "core/files.h"
#include "tests/runtime/graph_example.h"
#include "tests/runtime/onnx_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

namespace daumier::runtime {
namespace {

const std::string kSwap = OnnxTensor("w", {3, 3, 1, 1}, {0, 0, 1, 0, 1, 0, 1, 0, 0});  // Red and blue.

class ImageNetworkFile : public ::testing::Test {
 protected:
  ImageNetwork Open(const std::string& bytes) const {
    WriteFileAtomically(folder_ / "style.onnx", bytes);
    return ImageNetwork(folder_ / "style.onnx");
  }
  void ExpectRefused(const std::string& bytes, const std::string& part) const {
    testing::ExpectError([&] { Open(bytes); }, "style.onnx: ");
    testing::ExpectError([&] { Open(bytes); }, part);
  }
  static std::string Model(const std::string& fields, const std::vector<int64_t>& input,
                           const std::string& inputs = "") {
    return OnnxModel(fields + BytesField(11, OnnxValue("x", input)) + inputs + BytesField(12, OnnxValue("y", {})));
  }
  static std::string Node(const std::string& op, const std::vector<std::string>& inputs, const std::string& output,
                          const std::string& attributes = "") {
    return BytesField(1, OnnxNode(op, inputs, output, attributes));
  }
  const testing::TempDir folder_;
  const FloatArray picture_{{1, 2, 3}, {1, 2, 3, 4, 5, 6}};  // Two pixels.
};

TEST_F(ImageNetworkFile, ReadsChannelsFirst) {
  const ImageNetwork network = Open(Model(Node("Conv", {"x", "w"}, "y") + BytesField(5, kSwap), {1, 3, -1, -1}));
  EXPECT_EQ(network.input().layout, ImageLayout::kChannelsFirst);
  EXPECT_EQ(network.input().height, std::nullopt);
  const FloatArray styled = network.Run(picture_);
  EXPECT_EQ(styled.shape, (Shape{1, 2, 3}));
  EXPECT_EQ(styled.values, (std::vector<float>{3, 2, 1, 6, 5, 4}));
}

TEST_F(ImageNetworkFile, ReadsChannelsLast) {
  const std::string nodes = Node("Transpose", {"x"}, "f", IntegersAttribute("perm", {0, 3, 1, 2})) +
                            Node("Conv", {"f", "w"}, "c") +
                            Node("Transpose", {"c"}, "y", IntegersAttribute("perm", {0, 2, 3, 1}));
  for (const int64_t channels : {3, -1}) {  // Without the 3, the transposition says it.
    const ImageNetwork network = Open(Model(nodes + BytesField(5, kSwap), {-1, -1, -1, channels}));
    EXPECT_EQ(network.input().layout, ImageLayout::kChannelsLast);
    EXPECT_EQ(network.Run(picture_).values, (std::vector<float>{3, 2, 1, 6, 5, 4}));
  }
}

TEST_F(ImageNetworkFile, RepeatsASingleChannel) {
  const std::string sum = OnnxTensor("w", {1, 3, 1, 1}, {1, 1, 1});
  const ImageNetwork network = Open(Model(Node("Conv", {"x", "w"}, "y") + BytesField(5, sum), {1, 3, -1, -1}));
  EXPECT_EQ(network.Run(picture_).values, (std::vector<float>{6, 6, 6, 15, 15, 15}));
}

TEST_F(ImageNetworkFile, FixedSizesAreDemanded) {
  const ImageNetwork network = Open(Model(Node("Relu", {"x"}, "y"), {1, 3, 4, -1}));
  EXPECT_EQ(network.input().height, 4);
  EXPECT_EQ(network.input().width, std::nullopt);
  testing::ExpectError([&] { network.Run(picture_); }, "style.onnx: it reads pictures of 4 x 0 pixels");
  testing::ExpectError([&] { network.Run(FloatArray({4, 4, 4})); }, "expected (H, W, 3)");
}

TEST_F(ImageNetworkFile, OthersAreRefused) {
  ExpectRefused(Model(Node("Relu", {"x"}, "y"), {1, 4, 8, 8}), "its input 'x' is (1, 4, 8, 8), expected 3 channels");
  ExpectRefused(Model(Node("Relu", {"x"}, "y"), {2, 3, 8, 8}), "expected one image");
  ExpectRefused(Model(Node("Relu", {"x"}, "y"), {3, 8}), "expected one image");
  ExpectRefused(Model(Node("Relu", {"x"}, "y"), {-1, -1, -1, -1}), "expected 3 channels");
  ExpectRefused(Model(Node("Add", {"x", "z"}, "y"), {1, 3, 8, 8}, BytesField(11, OnnxValue("z", {1, 3, 8, 8}))),
                "it has 2 inputs, expected one image");
  ExpectRefused(Model(Node("NonMaxSuppression", {"x"}, "a") + Node("Loop", {"a"}, "y"), {1, 3, 8, 8}),
                "node 'NonMaxSuppression_0' (NonMaxSuppression): operators that are not run here: Loop, "
                "NonMaxSuppression");
  ExpectRefused(Model(Node("Relu", {"x"}, "y", BytesField(7, "com.microsoft")), {1, 3, 8, 8}),
                "is of the domain 'com.microsoft'");
}

TEST_F(ImageNetworkFile, AnOutputThatIsNoImageIsRefused) {
  const ImageNetwork mean = Open(Model(Node("Flatten", {"x"}, "y"), {1, 3, -1, -1}));
  testing::ExpectError([&] { mean.Run(picture_); }, "style.onnx: its output is (1, 6), no image");
  const ImageNetwork zero = Open(Model(Node("Log", {"x"}, "y"), {1, 3, -1, -1}));
  testing::ExpectError([&] { zero.Run(FloatArray({1, 2, 3})); }, "not finite");
}

}  // namespace
}  // namespace daumier::runtime
