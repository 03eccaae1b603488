#include "systems/portrait/style_network.h"

#include "core/files.h"
#include "tests/runtime/onnx_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

using namespace daumier::runtime;  // For onnx_bytes.h

/// y = scale x + shift a channel, by a convolution of 1 x 1, then Clip or not.
std::string AffineModel(float scale, float shift, const std::vector<int64_t>& input = {1, 3, -1, -1}) {
  std::vector<float> weights(9, 0);
  for (size_t c = 0; c < 3; ++c) weights[4 * c] = scale;
  const std::string fields = BytesField(1, OnnxNode("Conv", {"x", "w", "b"}, "y", "")) +
                             BytesField(5, OnnxTensor("w", {3, 3, 1, 1}, weights)) +
                             BytesField(5, OnnxTensor("b", {3}, {shift, shift, shift}));
  return OnnxModel(fields + BytesField(11, OnnxValue("x", input)) + BytesField(12, OnnxValue("y", {})));
}

/// A ramp from dark to light with some red.
render::Image Ramp(int height, int width) {
  render::Image picture(height, width, 3);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      picture.at(row, column, 0) = uint8_t(40 + 180 * column / width);
      picture.at(row, column, 1) = picture.at(row, column, 2) = uint8_t(20 + 180 * column / width);
    }
  }
  return picture;
}

class StyleNetworkTest : public ::testing::Test {
 protected:
  StyleNetwork Open(const std::string& bytes, const StyleNetworkOptions& options = {}) const {
    WriteFileAtomically(folder_.path() / "style.onnx", bytes);
    return StyleNetwork(folder_.path() / "style.onnx", options);
  }
  const daumier::testing::TempDir folder_;
};

TEST_F(StyleNetworkTest, ScalesValuesAndSizesForthAndBack) {
  const render::Image picture = Ramp(48, 70);  // No multiples of 32.
  for (const char* range : {"signed", "zero_one", "bytes"}) {
    const render::Image styled = Open(AffineModel(1, 0), {.range = range, .side = 70}).Apply(picture);
    ASSERT_EQ(styled.height, 48);
    ASSERT_EQ(styled.width, 70);
    for (size_t i = 0; i < picture.pixels.size(); ++i)
      ASSERT_NEAR(styled.pixels[i], picture.pixels[i], 1) << range << " " << i;
  }
  // A brighter picture in units of the range: + 0.2 of signed values is + 0.1 of colours.
  const render::Image brighter = Open(AffineModel(1, 0.2F), {.range = "signed", .side = 70}).Apply(picture);
  EXPECT_NEAR(brighter.at(20, 30, 1), picture.at(20, 30, 1) + 25.5, 1);
}

TEST_F(StyleNetworkTest, FitsAPictureIntoAFixedSize) {
  const render::Image picture = Ramp(30, 60);
  const render::Image styled = Open(AffineModel(1, 0, {1, 3, 64, 64}), {.range = "zero_one"}).Apply(picture);
  ASSERT_EQ(styled.width, 60);
  for (const int column : {5, 30, 55}) EXPECT_NEAR(styled.at(15, column, 1), picture.at(15, column, 1), 3);
}

TEST_F(StyleNetworkTest, FindsTheRangeThatItsValuesFit) {
  const render::Image picture = Ramp(64, 64);
  // Of an identity every range is right, and signed the first.
  EXPECT_EQ(Open(AffineModel(1, 0)).RangeFor(picture), "signed");
  // 0.5 x + 40 returns colours of bytes alone.
  EXPECT_EQ(Open(AffineModel(0.5F, 40)).RangeFor(picture), "bytes");
  // 0.8 x + 0.3 returns colours of both other ranges: of equal ones the first.
  EXPECT_EQ(Open(AffineModel(0.8F, 0.3F)).RangeFor(picture), "signed");
  EXPECT_EQ(Open(AffineModel(0.5F, 40), {.range = "zero_one"}).RangeFor(picture), "zero_one") << "as given";
}

TEST_F(StyleNetworkTest, RefusesAnEmptyPictureAndATornFile) {
  const StyleNetwork network = Open(AffineModel(1, 0));
  daumier::testing::ExpectError([&] { network.Apply(render::Image()); }, "it is empty");
  daumier::testing::ExpectError([&] { Open(AffineModel(1, 0).substr(0, 40)); }, "style.onnx");
}

}  // namespace
}  // namespace daumier::portrait
