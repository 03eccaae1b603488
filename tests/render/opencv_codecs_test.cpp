#include "render/opencv_codecs.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace daumier::render {
namespace {

TEST(OpenCvDecode, ReadsWhatOpenCvWrites) {
  cv::Mat image(4, 3, CV_8UC1);
  for (int i = 0; i < 12; ++i) image.data[i] = uint8_t(20 * i);
  std::vector<uint8_t> bytes;
  ASSERT_TRUE(cv::imencode(".bmp", image, bytes));
  const cv::Mat read = OpenCvDecode(cv::Mat(bytes), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.size(), image.size());
  EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace daumier::render
