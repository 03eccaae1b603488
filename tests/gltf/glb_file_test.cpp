#include "gltf/glb_file.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

namespace daumier::gltf {
namespace {

using testing::ExpectError;

/// Three vertices, a triangle, two colours and an image.
GlbBuilder SmallBuilder() {
  GlbBuilder builder(GlbEncoding::kPlain);
  FloatRows positions(3, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0.5f;
  builder.AddAttribute(positions, kPositionExponent, true);
  builder.AddIndices(std::vector<uint32_t>{0, 2, 1}, 3);
  builder.AddColors(std::vector<std::array<uint8_t, 4>>{{1, 2, 3, 255}, {4, 5, 6, 255}});
  builder.AddImage("a picture", "image/png");
  return builder;
}

/// Of a document that was changed behind its binary chunk.
std::string Changed(const std::function<void(Json&)>& change) {
  GlbBuilder builder = SmallBuilder();
  change(builder.json());
  return builder.Finish();
}

TEST(GlbFile, ReadsWhatTheBuilderWrites) {
  const GlbFile file(SmallBuilder().Finish(), "a.glb");
  EXPECT_EQ(file.Floats(0, 3)(2, 2), 0.5f);
  EXPECT_EQ(file.Indices(1, 3), (std::vector<uint32_t>{0, 2, 1}));
  EXPECT_EQ(file.Colours(2)[1], (std::array<uint8_t, 4>{4, 5, 6, 255}));
  EXPECT_EQ(file.ImageBytes(0), "a picture");
}

TEST(GlbFile, RefusesOtherFilesAndEveryTruncation) {
  ExpectError([] { GlbFile("v 0 0 0\n", "mesh.obj"); }, "mesh.obj: is no .glb");
  ExpectError([] { GlbFile("", "empty.glb"); }, "empty.glb: is no .glb");
  const std::string whole = SmallBuilder().Finish();
  for (size_t size = 4; size < whole.size(); ++size)
    ExpectError([&] { GlbFile(whole.substr(0, size), "cut.glb"); }, "cut.glb: is damaged");
  // Also where the stated length is that of the rest.
  for (size_t size = 12; size < whole.size(); size += 4) {
    std::string cut = whole.substr(0, size);
    const auto length = uint32_t(size);
    std::memcpy(cut.data() + 8, &length, 4);
    ExpectError([&] { GlbFile(cut, "cut.glb"); }, "cut.glb: is damaged");
  }
}

TEST(GlbFile, RefusesCompressedFiles) {
  ExpectError(
      [] { GlbFile(Changed([](Json& json) { json["extensionsRequired"] = {"EXT_meshopt_compression"}; }), "a"); },
      "a: is compressed. Give the plain .glb");
}

TEST(GlbFile, ChecksEveryRange) {
  const auto expect = [](const std::function<void(Json&)>& change, const std::string& part) {
    const GlbFile file(Changed(change), "a.glb");
    ExpectError([&] { file.Floats(0, 3); }, part);
  };
  expect([](Json& json) { json["accessors"][0]["count"] = 4; }, "an accessor is not in its view");
  expect([](Json& json) { json["accessors"][0]["count"] = -1; }, "an accessor is not in its view");
  expect([](Json& json) { json["accessors"][0]["count"] = int64_t(1) << 62; }, "an accessor is not in its view");
  expect([](Json& json) { json["accessors"][0]["byteOffset"] = 4; }, "an accessor is not in its view");
  expect([](Json& json) { json["accessors"][0]["bufferView"] = 9; }, "there is no 9 in bufferViews");
  expect([](Json& json) { json["accessors"][0]["componentType"] = 5123; }, "has not 3 floats");
  expect([](Json& json) { json["bufferViews"][0]["byteLength"] = 100000; }, "view 0 is not in its buffer");
  expect([](Json& json) { json["bufferViews"][0]["byteOffset"] = -4; }, "view 0 is not in its buffer");
  expect([](Json& json) { json["bufferViews"][0]["byteStride"] = 16; }, "view 0 is not in its buffer");
  const GlbFile file(SmallBuilder().Finish(), "a.glb");
  ExpectError([&] { file.Indices(1, 2); }, "a corner is vertex 2, there are 2");
  ExpectError([&] { file.Indices(0, 3); }, "has no indices");
  ExpectError([&] { file.Item("accessors", -1); }, "there is no -1 in accessors");
  ExpectError([&] { file.ImageBytes(1); }, "there is no 1 in images");
}

TEST(GlbFile, RefusesNumbersThatAreNotFinite) {
  GlbBuilder builder(GlbEncoding::kPlain);
  builder.AddAttribute(FloatRows::Constant(2, 3, std::numeric_limits<float>::quiet_NaN()), kPositionExponent);
  const GlbFile file(builder.Finish(), "a.glb");
  ExpectError([&] { file.Floats(0, 3); }, "a number that is not finite");
}

}  // namespace
}  // namespace daumier::gltf
