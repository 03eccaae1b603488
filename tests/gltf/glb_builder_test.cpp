#include "gltf/glb_builder.h"

#include "tests/support/expect_error.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

namespace daumier::gltf {
namespace {

FloatRows SomeRows() {
  FloatRows rows(3, 3);
  rows << 1, -2, 0.1f, 4, 5, 6, -7, 8, 9;
  return rows;
}

TEST(GlbBuilder, FloatsComeBackExactlyWithTheirBounds) {
  GlbBuilder builder(GlbEncoding::kPlain);
  const int plain = builder.AddAttribute(SomeRows(), kPositionExponent);
  const int bounded = builder.AddAttribute(SomeRows(), kPositionExponent, true);
  const testing::GlbReader file(builder.Finish());
  EXPECT_EQ(file.Floats(plain), SomeRows());
  EXPECT_FALSE(file.accessor(plain).contains("min"));
  EXPECT_EQ(file.accessor(bounded)["min"], Json({-7, -2, 0.1f}));
  EXPECT_EQ(file.accessor(bounded)["max"], Json({4, 8, 9}));
  EXPECT_EQ(file.accessor(bounded)["type"], "VEC3");
  EXPECT_EQ(file.view_of(bounded)["target"], 34962);
  EXPECT_NE(file.accessor(plain)["bufferView"], file.accessor(bounded)["bufferView"]);
}

TEST(GlbBuilder, IndicesAreShortWhereTheyFit) {
  GlbBuilder builder(GlbEncoding::kPlain);
  const std::vector<uint32_t> indices = {0, 1, 65534, 2, 1, 0, 5, 6, 7};
  const int narrow = builder.AddIndices(indices, 65535), wide = builder.AddIndices(indices, 65536);
  const int floats = builder.AddAttribute(SomeRows(), 0);
  const testing::GlbReader file(builder.Finish());
  EXPECT_EQ(file.accessor(narrow)["componentType"], 5123);
  EXPECT_EQ(file.accessor(wide)["componentType"], 5125);
  EXPECT_EQ(file.Indices(narrow), indices);
  EXPECT_EQ(file.Indices(wide), indices);
  EXPECT_EQ(file.view_of(narrow)["target"], 34963);
  EXPECT_EQ(file.Floats(floats), SomeRows()) << "18 bytes of indices precede it";
  EXPECT_EQ(file.view_of(floats)["byteOffset"].get<int>() % 4, 0);
}

TEST(GlbBuilder, KeysAreScalarsOrElements) {
  GlbBuilder builder(GlbEncoding::kPlain);
  const std::vector<float> times = {0, 0.5f, 2};
  const int time = builder.AddTimes(times);
  FloatRows turns(3, 4);
  turns << 0, 0, 0, 1, 0, 0, 0.6f, 0.8f, 1, 0, 0, 0;
  const int weights = builder.AddKeys(SomeRows(), true, kWeightExponent), turn = builder.AddKeys(turns, false, 0);
  const testing::GlbReader file(builder.Finish());
  EXPECT_EQ(file.accessor(time)["max"], Json({2}));
  EXPECT_EQ(file.accessor(weights)["count"], 9);
  EXPECT_EQ(file.Floats(turn), turns);
  EXPECT_FALSE(file.view_of(weights).contains("target"));
}

TEST(GlbBuilder, ColoursAreNormalizedBytes) {
  GlbBuilder builder(GlbEncoding::kPlain);
  const std::vector<std::array<uint8_t, 4>> colours = {{255, 0, 1, 255}, {2, 3, 4, 255}};
  const int accessor = builder.AddColors(colours);
  const testing::GlbReader file(builder.Finish());
  EXPECT_EQ(file.accessor(accessor)["type"], "VEC4");
  EXPECT_EQ(file.accessor(accessor)["normalized"], true);
  EXPECT_EQ(file.binary().substr(0, 8), std::string_view("\xff\x00\x01\xff\x02\x03\x04\xff", 8));
}

TEST(GlbBuilder, CompressedViewsNameTheExtensionWhichTheFileRequires) {
  GlbBuilder builder(GlbEncoding::kMeshopt);
  FloatRows rows = FloatRows::Constant(100, 3, 0.3f);
  const int accessor = builder.AddAttribute(rows, -2, true);
  const testing::GlbReader file(builder.Finish());
  EXPECT_EQ(file.accessor(accessor)["min"], Json({0.25, 0.25, 0.25})) << "bounds are those of the rounded values";
  const Json& compressed = file.view_of(accessor)["extensions"]["EXT_meshopt_compression"];
  EXPECT_EQ(compressed["mode"], "ATTRIBUTES");
  EXPECT_EQ(compressed["filter"], "EXPONENTIAL");
  EXPECT_EQ(compressed["byteStride"], 12);
  EXPECT_EQ(compressed["count"], 100);
  EXPECT_EQ(file.json()["extensionsRequired"], Json({"EXT_meshopt_compression"}));
  EXPECT_EQ(file.json()["buffers"][1]["byteLength"], 1200);
  EXPECT_EQ(file.json()["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
  EXPECT_EQ(file.json()["buffers"][0]["byteLength"], file.binary().size());
}

TEST(GlbBuilder, CompressesKeysOfMoreTargetsThanAnElementTakes) {
  GlbBuilder builder(GlbEncoding::kMeshopt);
  const int few = builder.AddKeys(FloatRows::Constant(3, 64, 0.5f), true, kWeightExponent);
  const int many = builder.AddKeys(FloatRows::Constant(3, 67, 0.5f), true, kWeightExponent);
  const testing::GlbReader file(builder.Finish());
  EXPECT_EQ(file.view_of(few)["extensions"]["EXT_meshopt_compression"]["byteStride"], 256);
  EXPECT_EQ(file.view_of(many)["extensions"]["EXT_meshopt_compression"]["byteStride"], 4);
  EXPECT_EQ(file.view_of(many)["extensions"]["EXT_meshopt_compression"]["count"], 3 * 67);
  EXPECT_EQ(file.accessor(many)["count"], 3 * 67);
}

TEST(GlbBuilder, RefusesElementsThatGltfLacks) {
  GlbBuilder builder(GlbEncoding::kPlain);
  testing::ExpectError([&] { builder.AddAttribute(FloatRows::Zero(2, 5), 0); }, "expected 1 .. 4");
}

}  // namespace
}  // namespace daumier::gltf
