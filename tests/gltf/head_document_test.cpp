#include "gltf/head_document.h"

#include "tests/support/ball_head.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::gltf {
namespace {

/// The nodes alone.
testing::GlbReader DocumentOf(const rig::RiggedHead& head, const render::Image* texture,
                              GlbEncoding encoding = GlbEncoding::kPlain) {
  GlbBuilder builder(encoding);
  AddAsset(builder, head);
  AddHead(builder, head, texture, {}, 1.5);
  return testing::GlbReader(builder.Finish());
}

void ExpectTranslation(const testing::GlbReader& file, const char* node, const std::vector<double>& expected) {
  const std::vector<double> found = file.node(node)["translation"];
  ASSERT_EQ(found.size(), 3u);
  for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-12) << node;
}

TEST(AddHead, PutsEyesAndJawBelowTheHeadAtTheirPivots) {
  const rig::RiggedHead head = testing::BallHead();  // Pivot (0, 1, -1), eyes (+-3, 4, 7), jaw (0, -1, 1).
  const testing::GlbReader file = DocumentOf(head, nullptr);
  ExpectTranslation(file, "Head", {0, 1.5, 0});
  ExpectTranslation(file, "LeftEye", {0.03, 0.03, 0.08});
  ExpectTranslation(file, "RightEye", {-0.03, 0.03, 0.08});
  ExpectTranslation(file, "Jaw", {0, -0.02, 0.02});
  const std::set<int> children = file.node("Head")["children"];
  EXPECT_EQ(children, (std::set<int>{file.Node("LeftEye"), file.Node("RightEye"), file.Node("Jaw")}));
  EXPECT_FALSE(file.node("Jaw").contains("mesh"));

  const FloatRows positions = file.Floats(file.primitive("LeftEye")["attributes"]["POSITION"]);
  EXPECT_LT(positions.colwise().mean().norm(), 1e-3f) << "a ball about its own centre";
  EXPECT_NEAR(positions.rowwise().norm().maxCoeff(), 0.012f, 1e-6f);
  EXPECT_NEAR(file.Floats(file.primitive("Head")["attributes"]["POSITION"]).col(1).maxCoeff(), 0.10f, 1e-6f)
      << "the crown, 11 cm, from the pivot";
}

TEST(AddHead, OfAHeadWithoutEyesHasNone) {
  rig::RiggedHead head = testing::BallHead();
  head.eyes.clear();
  const testing::GlbReader file = DocumentOf(head, nullptr);
  EXPECT_EQ(file.json()["nodes"].size(), 2u);
  EXPECT_EQ(file.json()["materials"].size(), 1u);
}

/// A red triangle above the head.
rig::HeadAttachment Tuft() {
  rig::HeadAttachment tuft{"Tuft", {geometry::Points(3, 3), geometry::Triangles(1, 3), {}, {}}, Eigen::MatrixXf(3, 3)};
  tuft.mesh.vertices << -1, 12, 0, 1, 12, 0, 0, 14, 0;
  tuft.mesh.triangles << 0, 1, 2;
  tuft.mesh.uv.resize(0, 2);
  tuft.mesh.uv_triangles.resize(0, 3);
  tuft.colours.rowwise() = Eigen::RowVector3f(1, 0, 0);
  return tuft;
}

TEST(AddHead, HangsAttachmentsOnTheHeadWithTheirColours) {
  rig::RiggedHead head = testing::BallHead();
  head.attachments.push_back(Tuft());
  EXPECT_NO_THROW(CheckHead(head, nullptr));
  const testing::GlbReader file = DocumentOf(head, nullptr);
  const std::set<int> children = file.node("Head")["children"];
  EXPECT_TRUE(children.contains(file.Node("Tuft")));
  EXPECT_FALSE(file.primitive("Tuft").contains("targets"));
  EXPECT_TRUE(file.primitive("Tuft")["attributes"].contains("COLOR_0"));
  const FloatRows positions = file.Floats(file.primitive("Tuft")["attributes"]["POSITION"]);
  EXPECT_NEAR(positions.col(1).maxCoeff(), 0.13f, 1e-6f) << "14 cm, from the pivot at 1";
}

TEST(AddHead, NamesAreUniqueAndMadeOfLettersAndDigits) {
  rig::RiggedHead head = testing::BallHead();
  head.attachments.push_back(Tuft());
  const testing::GlbReader file = DocumentOf(head, nullptr);
  std::set<std::string> names;
  for (const char* list : {"nodes", "meshes", "materials"}) {
    for (const Json& item : file.json()[list]) {
      const std::string name = item["name"];
      EXPECT_TRUE(names.insert(name).second) << name;
      EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0; })) << name;
    }
  }
}

TEST(AddHead, EmbedsOneTextureForAllMaterials) {
  render::Image texture(2, 2, 3);
  texture.at(0, 0, 1) = 7;
  const testing::GlbReader file = DocumentOf(testing::BallHead(), &texture);
  ASSERT_EQ(file.json()["images"].size(), 1u);
  const Json& view = file.json()["bufferViews"][file.json()["images"][0]["bufferView"].get<size_t>()];
  const std::string_view bytes = file.binary().substr(view["byteOffset"], view["byteLength"]);
  EXPECT_EQ(file.json()["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(render::DecodeImage(bytes, "texture"), texture);
  ASSERT_EQ(file.json()["materials"].size(), 2u);
  for (const Json& material : file.json()["materials"]) {
    EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 0);
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  }
  EXPECT_FALSE(file.primitive("Head")["attributes"].contains("COLOR_0"));
  const testing::GlbReader small = DocumentOf(testing::BallHead(), &texture, GlbEncoding::kMeshopt);
  EXPECT_EQ(small.json()["images"][0]["mimeType"], "image/jpeg");
}

TEST(AddAsset, CarriesLicenceAndSourceWithTheNotice) {
  rig::RiggedHead head = testing::BallHead();
  head.source = "ict";
  head.licence = "MIT, (c) 2020 HOLDER";
  const testing::GlbReader file = DocumentOf(head, nullptr);
  const Json& asset = file.json()["asset"];
  EXPECT_EQ(asset["version"], "2.0");
  EXPECT_EQ(asset["copyright"], "MIT, (c) 2020 HOLDER");
  EXPECT_EQ(asset["extras"]["name"], "ict");
  EXPECT_NE(asset["extras"]["notices"].get<std::string>().find("Permission is hereby granted"), std::string::npos);
}

}  // namespace
}  // namespace daumier::gltf
