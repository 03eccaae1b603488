#include "render/exr.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::render {
namespace {

using testing::ExpectError;

FloatImage RandomFloats(int height, int width) {
  Rng rng(5);
  FloatImage image{height, width, {}};
  for (const char* name : {"N.X", "N.Y", "Z"}) {
    auto& values = image.channels[name];
    for (int i = 0; i < height * width; ++i) values.push_back(static_cast<float>(rng.Normal()));
  }
  return image;
}

TEST(Exr, ReadingUndoesWriting) {
  for (const auto& [height, width] : {std::pair(1, 1), std::pair(16, 3), std::pair(37, 20)}) {
    FloatImage image = RandomFloats(height, width);
    image.channels["Z"].back() = std::numeric_limits<float>::infinity();
    const FloatImage read = DecodeExr(EncodeExr(image), "picture");
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.channels, image.channels);
  }
}

TEST(Exr, EvenPlanesBecomeSmall) {
  FloatImage image{64, 64, {{"Z", std::vector<float>(64 * 64, 3.5f)}}};
  const std::string bytes = EncodeExr(image);
  EXPECT_LT(bytes.size(), 1000u);
  EXPECT_EQ(DecodeExr(bytes, "picture").channels, image.channels);
}

TEST(Exr, HeaderIsThatOfTheFormat) {
  const std::string bytes = EncodeExr(RandomFloats(2, 3));
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x76\x2f\x31\x01\x02\0\0\0", 8));
  EXPECT_EQ(bytes.substr(8, 16), std::string("channels\0chlist\0", 16));
}

TEST(Exr, TruncatedFilesAreRefused) {
  const std::string bytes = EncodeExr(RandomFloats(20, 4));
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(DecodeExr(std::string_view(bytes).substr(0, size), "picture"), Error) << size;
  }
}

TEST(Exr, ChannelsOfAnotherSizeAreRefused) {
  FloatImage image = RandomFloats(2, 2);
  image.channels["Z"].pop_back();
  ExpectError([&] { EncodeExr(image); }, "channel Z has 3 values, expected 4");
  image.channels.clear();
  ExpectError([&] { EncodeExr(image); }, "0 channels");
  ExpectError([&] { DecodeExr("no picture", "a.exr"); }, "a.exr: not an OpenEXR file");
}

}  // namespace
}  // namespace daumier::render
