#include "render/styles/jpeg_loss.h"

#include "tests/render/styles/colourful_picture.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::ColourfulPicture;
using daumier::testing::RootMeanSquare;

TEST(JpegLoss, ShrinksWithTheQuality) {
  const Image picture = ColourfulPicture();
  double last = 0;
  for (const int quality : {100, 90, 60, 30, 8}) {
    const double loss = RootMeanSquare(JpegLoss(picture, quality), picture);
    EXPECT_GT(loss, last) << quality;
    last = loss;
  }
  EXPECT_LT(RootMeanSquare(JpegLoss(Image(17, 9, 3, 77), 90), Image(17, 9, 3, 77)), 1.01);
  daumier::testing::ExpectError([&] { JpegLoss(picture, 0); }, "quality is 0");
  daumier::testing::ExpectError([&] { JpegLoss(Image(8, 8, 1), 50); }, "1 channels");
}

TEST(JpegLoss, OfOneCosineIsItsRoundedCoefficient) {
  // 128 + 20 cos((2 i + 1) pi / 16) down a block: one coefficient, 20 * 4 * sqrt(1/2) * ... = 20 * 8 * 0.5 * 0.5 * sqrt(2).
  Image image(8, 8, 3);
  for (int row = 0; row < 8; ++row) {
    const auto value = static_cast<uint8_t>(std::lround(128 + 20 * std::cos((2 * row + 1) * 3.14159265358979 / 16)));
    for (int i = 0; i < 24; ++i) image.pixels[size_t(row) * 24 + i] = value;
  }
  // 113.1 is a multiple of 2 (step 12 at quality 92: (12 * 16 + 50) / 100 = 2) to within 1: the picture comes back.
  const Image back = JpegLoss(image, 92);
  for (size_t i = 0; i < back.pixels.size(); ++i) EXPECT_NEAR(back.pixels[i], image.pixels[i], 2);
}

}  // namespace
}  // namespace daumier::render
