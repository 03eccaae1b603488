#include "render/png_writer.h"

#include "render/opencv_bridge.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace daumier::render {
namespace {

Image Ramp(int height, int width, int channels) {
  Image image(height, width, channels);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = uint8_t(i * i / 7 + 3 * i);
  return image;
}

TEST(EncodePng, OpenCvReadsItExactly) {
  for (const int channels : {1, 3}) {
    Image image = Ramp(37, 53, channels);
    const std::string bytes = EncodePng(image);
    cv::Mat mat = cv::imdecode(std::vector<uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(mat.channels(), channels);
    if (channels == 3) cv::cvtColor(mat, mat, cv::COLOR_BGR2RGB);
    EXPECT_EQ(cv::norm(mat, MatView(image), cv::NORM_INF), 0);
  }
}

TEST(EncodePng, AFlatPictureIsSmall) {
  Image image(360, 360, 3);
  EXPECT_LT(EncodePng(image).size(), 4000);
}

TEST(EncodePng, IsReadBackExactly) {
  const Image image = Ramp(5, 1, 3);
  EXPECT_EQ(DecodeImage(EncodePng(image), "picture"), image);
}

TEST(EncodePng, APictureThatIsTooLargeForPngIsRefused) {
  Image image;
  image.width = 2000000, image.height = 1, image.channels = 1;
  image.pixels.resize(2000000);
  testing::ExpectError([&] { EncodePng(image); }, "libpng cannot encode a picture");
}

}  // namespace
}  // namespace daumier::render
