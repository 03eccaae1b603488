#include "render/jpeg.h"

#include "tests/render/oriented_pictures.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(FirstJpeg, EndsAtTheEndMarkerWhateverFollows) {
  const std::string jpeg = testing::Encoded(".jpg", testing::SixBlocks());
  const std::string movie(
      "\0\0\0\x18"
      "ftypmp42\xFF\xDA\0\x08 and so on",
      28);
  for (const std::string& more : {std::string(), movie, jpeg, std::string(1000, '\0')}) {
    const std::string file = jpeg + more;
    const JpegExtent extent = FirstJpeg(file);
    EXPECT_EQ(extent.picture, jpeg);
    EXPECT_TRUE(extent.has_end);
    EXPECT_TRUE(extent.has_scan);
    EXPECT_TRUE(extent.exif.empty());
  }
}

TEST(FirstJpeg, StepsOverMarkersInSegmentsAndInCompressedData) {
  // A segment that holds a picture (a thumbnail); then FF00 is a byte, FFD0 a restart, FFFF padding.
  const std::string segment = "\xFF\xD8\xFF\xD9";
  const std::string file = std::string("\xFF\xD8\xFF\xE2\0\x06", 6) + segment + std::string("\xFF\xFF\xDA\0\x02", 5) +
                           std::string(
                               "ab\xFF\0c\xFF\xD0"
                               "d\xFF\xFF\xD9",
                               11) +
                           "rest";
  const JpegExtent extent = FirstJpeg(file);
  EXPECT_EQ(extent.picture.size(), file.size() - 4);
  EXPECT_TRUE(extent.has_end);
}

TEST(FirstJpeg, SkipsBytesBetweenSegments) {
  std::string jpeg = testing::Encoded(".jpg", testing::SixBlocks());
  jpeg.insert(2, "abc");
  const std::string file = jpeg + "more";
  EXPECT_EQ(FirstJpeg(file).picture, jpeg);
}

TEST(FirstJpeg, WithoutAnEndMarkerReachesToTheEndOfTheFile) {
  const std::string jpeg = testing::Encoded(".jpg", testing::SixBlocks());
  for (size_t size = 0; size < jpeg.size(); ++size) {
    const JpegExtent extent = FirstJpeg(std::string_view(jpeg).substr(0, size));
    EXPECT_FALSE(extent.has_end) << size;
    EXPECT_EQ(extent.picture.size(), size);
  }
}

TEST(FirstJpeg, FindsTheExifData) {
  const std::string jpeg = testing::Encoded(".jpg", testing::SixBlocks()), exif = testing::ExifData(3);
  const std::string file = testing::JpegWithExif(jpeg, exif);
  EXPECT_EQ(FirstJpeg(file).exif, exif);
}

TEST(IsJpeg, IsDecidedByTheFirstMarkers) {
  EXPECT_TRUE(IsJpeg("\xFF\xD8\xFF\xE0"));
  EXPECT_FALSE(IsJpeg("\xFF\xD8"));
  EXPECT_FALSE(IsJpeg("\x89PNG"));
}

}  // namespace
}  // namespace daumier::render
