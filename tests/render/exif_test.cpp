#include "render/exif.h"

#include "core/random.h"
#include "tests/render/oriented_pictures.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExifData;
using testing::JpegWithExif;
using testing::PngWithExif;
using testing::SixBlocks;
using testing::WebpWithExif;

TEST(ExifOrientation, IsReadOfEachFormatInBothByteOrders) {
  const std::string jpeg = testing::Encoded(".jpg", SixBlocks()), png = testing::Encoded(".png", SixBlocks()),
                    webp = testing::Encoded(".webp", SixBlocks());
  for (const std::string& plain : {jpeg, png, webp}) EXPECT_EQ(ExifOrientation(plain), 1);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool big_endian : {false, true}) {
      const std::string exif = ExifData(orientation, big_endian);
      EXPECT_EQ(ExifOrientation(JpegWithExif(jpeg, exif)), orientation);
      EXPECT_EQ(ExifOrientation(PngWithExif(png, exif)), orientation);
      EXPECT_EQ(ExifOrientation(WebpWithExif(webp, exif, 48, 32)), orientation);
    }
  }
}

TEST(ExifOrientation, IsOneWhereTheDataAreDamaged) {
  const std::string jpeg = testing::Encoded(".jpg", SixBlocks());
  for (const int orientation : {0, 9, 255}) EXPECT_EQ(ExifOrientation(JpegWithExif(jpeg, ExifData(orientation))), 1);
  EXPECT_EQ(ExifOrientation(""), 1);
  EXPECT_EQ(ExifOrientation("II*"), 1);
  const std::string whole = JpegWithExif(jpeg, ExifData(6));
  for (size_t size = 0; size < 60; ++size) {
    const int orientation = ExifOrientation(std::string_view(whole).substr(0, size));
    EXPECT_TRUE(orientation == 1 || orientation == 6) << size;
  }
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = whole.substr(0, 80);
    damaged[2 + rng.Below(78)] = char(rng.Below(256));
    const int orientation = ExifOrientation(damaged);
    EXPECT_TRUE(orientation >= 1 && orientation <= 8);
  }
}

}  // namespace
}  // namespace daumier::render
