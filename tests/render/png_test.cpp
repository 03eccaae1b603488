#include "render/png.h"

#include "core/files.h"
#include "render/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>

namespace daumier::render {
namespace {

using testing::ExpectError;

void PutBigEndian(std::string& bytes, size_t offset, uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[offset + size_t(i)] = char(value >> (24 - 8 * i));
}

/// A PNG whose header, with a right checksum, has these fields: depth, colour type, compression, filter, interlace.
std::string PngOf(uint32_t width, uint32_t height, std::array<char, 5> fields = {8, 0, 0, 0, 0}) {
  const testing::TempDir folder;
  WriteImage(folder / "a.png", Image(4, 6, 1));
  std::string bytes = ReadFile(folder / "a.png");
  PutBigEndian(bytes, 16, width);
  PutBigEndian(bytes, 20, height);
  bytes.replace(24, 5, fields.data(), 5);
  PutBigEndian(bytes, 29, uint32_t(crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + 12), 17)));
  return bytes;
}

TEST(PngHeader, OfAWrittenPictureIsSound) {
  const std::string bytes = PngOf(6, 4);
  EXPECT_TRUE(IsPng(bytes));
  EXPECT_FALSE(IsPng(bytes.substr(1)));
  EXPECT_NO_THROW(CheckPngHeader(bytes, "a"));
  EXPECT_EQ(DecodeImage(bytes, "a").width, 6);
}

TEST(PngHeader, SizesAreNamed) {
  ExpectError([] { DecodeImage(PngOf(0, 4), "a.png"); }, "a.png: a PNG of 0 x 4 pixels (expected 1 to 1048576 a side");
  ExpectError([] { DecodeImage(PngOf(6, 0x7FFFFFFF), "a.png"); }, "a PNG of 6 x 2147483647 pixels");
  ExpectError([] { DecodeImage(PngOf(0xFFFFFFFF, 4), "a.png"); }, "a PNG of 4294967295 x 4 pixels");
  ExpectError([] { DecodeImage(PngOf(1 << 20, 1 << 20), "a.png"); }, "at most 1073741824 in all");
}

TEST(PngHeader, OtherFieldsAreNamed) {
  ExpectError([] { DecodeImage(PngOf(6, 4, {3, 0, 0, 0, 0}), "a.png"); }, "bit depth 3 and colour type 0");
  ExpectError([] { DecodeImage(PngOf(6, 4, {16, 3, 0, 0, 0}), "a.png"); }, "bit depth 16 and colour type 3");
  ExpectError([] { DecodeImage(PngOf(6, 4, {8, 5, 0, 0, 0}), "a.png"); }, "colour type 5");
  ExpectError([] { DecodeImage(PngOf(6, 4, {8, 0, 0, 0, 2}), "a.png"); }, "interlace 2");
}

TEST(PngHeader, DamageIsFound) {
  std::string bytes = PngOf(6, 4);
  for (size_t size = 8; size < 33; ++size)
    ExpectError([&] { CheckPngHeader(bytes.substr(0, size), "a.png"); }, "a.png: truncated PNG");
  bytes[19] ^= 1;
  ExpectError([&] { DecodeImage(bytes, "a.png"); }, "a.png: the header of the PNG is damaged");
  bytes[12] = 'X';
  ExpectError([&] { DecodeImage(bytes, "a.png"); }, "a.png: a PNG without a header");
}

std::string ChunkOf(const std::string& type, const std::string& data) {
  std::string chunk = std::string(4, '\0') + type + data + std::string(4, '\0');
  PutBigEndian(chunk, 0, uint32_t(data.size()));
  PutBigEndian(chunk, 8 + data.size(),
               uint32_t(crc32(0, reinterpret_cast<const Bytef*>(chunk.data() + 4), uInt(4 + data.size()))));
  return chunk;
}

TEST(PixelChunksOfPng, AreAllThatAWrittenPictureNeeds) {
  const std::string bytes = PngOf(6, 4);
  const Image image = DecodeImage(bytes, "a");
  // A colour profile that libpng complains about, and something after the end.
  const std::string with_profile = bytes.substr(0, 33) + ChunkOf("iCCP", "bad") + bytes.substr(33) + "rest";
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(DecodeImage(with_profile, "a"), image);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(PixelChunksOfPng(with_profile, "a"), PixelChunksOfPng(bytes, "a"));
}

TEST(PixelChunksOfPng, DamageIsAnErrorWithoutALineOfTheLibrary) {
  const std::string bytes = PngOf(6, 4), head = bytes.substr(0, 33), end = ChunkOf("IEND", "");
  std::string flipped = bytes;
  flipped[flipped.find("IDAT") + 6] ^= 1;
  ::testing::internal::CaptureStderr();
  ExpectError([&] { DecodeImage(flipped, "a.png"); }, "a.png: the PNG is damaged: the checksum of its chunk IDAT");
  ExpectError([&] { DecodeImage(head + ChunkOf("IDAT", "no zlib data") + end, "a.png"); },
              "a.png: the pixels of the PNG are damaged: zlib: incorrect header check");
  ExpectError([&] { DecodeImage(head + end, "a.png"); }, "a.png: truncated PNG");
  ExpectError([&] { DecodeImage(bytes.substr(0, bytes.find("IDAT") + 8), "a.png"); }, "a.png: truncated PNG");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace daumier::render
