#include "gltf/head_reader.h"

#include "core/json.h"
#include "gltf/head_file.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

namespace daumier::gltf {
namespace {

using testing::BallHead;
using testing::ExpectError;

constexpr double kRounding = 2e-6;  // cm: float32 metres.

rig::WeightsClip NoClip() {
  return {};
}

HeadInFile Reread(const rig::RiggedHead& head, const render::Image* texture, const HeadFileOptions& options = {}) {
  return ParseHead(HeadToGlb(head, texture, NoClip(), options), "head.glb");
}

/// Everything but `of_file_vertices`: BallHead has no unused vertices and keeps their order.
void ExpectSameHead(const rig::RiggedHead& read, const rig::RiggedHead& head) {
  EXPECT_EQ(read.mesh.triangles, head.mesh.triangles);
  const Eigen::RowVector3d pivot = head.head_pivot.transpose();
  EXPECT_LT((read.mesh.vertices.rowwise() + pivot - head.mesh.vertices).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_EQ(read.targets.names, head.targets.names);
  EXPECT_LT((read.targets.offsets - head.targets.offsets).cwiseAbs().maxCoeff(), 1.1e-4f) << "below 1e-6 m: 0";
  EXPECT_EQ(read.materials, head.materials);
  EXPECT_EQ(read.neck_cap, head.neck_cap);
  EXPECT_TRUE(read.head_pivot.isZero(0));
  EXPECT_LT((read.jaw_pivot + head.head_pivot - head.jaw_pivot).norm(), kRounding);
  ASSERT_EQ(read.eyes.size(), head.eyes.size());
  for (size_t e = 0; e < head.eyes.size(); ++e) {
    EXPECT_LT((read.eyes[e].centre + head.head_pivot - head.eyes[e].centre).norm(), kRounding);
    EXPECT_EQ(read.eyes[e].mesh.triangles, head.eyes[e].mesh.triangles);
    EXPECT_EQ(read.eyes[e].materials, head.eyes[e].materials);
  }
  EXPECT_EQ(read.source, head.source);
  EXPECT_EQ(read.licence, head.licence);
}

TEST(ReadHead, UndoesHeadToGlb) {
  rig::RiggedHead head = BallHead();
  head.neck_cap = {1, 2, 7};
  render::Image texture(4, 4, 3, 90);
  texture.at(1, 2, 0) = 200;
  const HeadInFile read = Reread(head, &texture);
  ExpectSameHead(read.head, head);
  ASSERT_TRUE(read.texture);
  EXPECT_EQ(*read.texture, texture);
  EXPECT_NEAR(read.pivot_height_cm, 155, 1e-9);
  EXPECT_FALSE(read.has_normals);
  EXPECT_GT(read.of_file_vertices.size(), size_t(head.mesh.vertices.rows())) << "split at the seam";
  EXPECT_TRUE(Reread(head, nullptr, {.normals = true}).has_normals);
}

TEST(ReadHead, OfColouredHeadsWeldsBordersOfMaterials) {
  const rig::RiggedHead head = BallHead();
  const HeadInFile read = Reread(head, nullptr);
  ExpectSameHead(read.head, head);
  EXPECT_FALSE(read.texture);
}

TEST(ReadHead, GivesTheFileAgain) {
  const render::Image texture(4, 4, 3, 90);
  const std::string bytes = HeadToGlb(BallHead(), &texture, NoClip());
  const HeadInFile once = ParseHead(bytes, "head.glb");
  const std::string again = HeadToGlb(once.head, once.texture.get(), NoClip());
  const HeadInFile twice = ParseHead(again, "again.glb");
  EXPECT_EQ(twice.of_file_vertices, once.of_file_vertices);
  EXPECT_EQ(twice.head.mesh.triangles, once.head.mesh.triangles);
  EXPECT_LT((twice.head.mesh.vertices - once.head.mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((twice.head.mesh.uv - once.head.mesh.uv).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ReadHead, KeepsOwnMaterialsAndJoinsTheirParts) {
  rig::RiggedHead head = BallHead();
  head.own_materials = {{.name = "skin", .colour = {0.5f, 1, 0.25f}, .opacity = 1},
                        {.name = "hat", .colour = {1, 1, 1}, .opacity = 0.5f}};
  for (Eigen::Index f = 0; f < head.mesh.triangles.rows(); ++f)
    head.own.push_back(head.mesh.vertices(head.mesh.triangles(f, 0), 1) > 8 ? 1 : 0);
  for (rig::RiggedEye& eye : head.eyes) eye.own.assign(size_t(eye.mesh.triangles.rows()), 0);
  const HeadInFile read = Reread(head, nullptr);
  EXPECT_EQ(read.head.mesh.vertices.rows(), head.mesh.vertices.rows()) << "one surface";
  ASSERT_EQ(read.head.own_materials.size(), 2u);
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(read.head.own_materials[m].name, head.own_materials[m].name);
    EXPECT_EQ(read.head.own_materials[m].colour, head.own_materials[m].colour);
    EXPECT_EQ(read.head.own_materials[m].opacity, head.own_materials[m].opacity);
  }
  EXPECT_EQ(std::ranges::count(read.head.own, 1), std::ranges::count(head.own, 1));
  EXPECT_EQ(read.head.eyes[0].own, head.eyes[0].own);
}

TEST(ReadHead, KeepsAttachmentsWithTheirColours) {
  rig::RiggedHead head = BallHead();
  rig::HeadAttachment tuft{"Hair", {geometry::Points(3, 3), geometry::Triangles(1, 3), {}, {}}, Eigen::MatrixXf(3, 3)};
  tuft.mesh.vertices << -1, 12, 0, 1, 12, 0, 0, 14, 0;
  tuft.mesh.triangles << 0, 1, 2;
  tuft.mesh.uv.resize(0, 2);
  tuft.mesh.uv_triangles.resize(0, 3);
  tuft.colours << 1, 0.5f, 0, 0.2f, 0.3f, 0.4f, 0, 0, 0.9f;
  head.attachments.push_back(tuft);
  const HeadInFile read = Reread(head, nullptr);
  ASSERT_EQ(read.head.attachments.size(), 1u);
  EXPECT_EQ(read.head.attachments[0].name, "Hair");
  EXPECT_EQ(read.head.attachments[0].mesh.triangles, tuft.mesh.triangles);
  EXPECT_LT((read.head.attachments[0].colours - tuft.colours).cwiseAbs().maxCoeff(), 0.02f);
}

/// A file whose document was changed; its chunks are those of any .glb.
std::string WithDocument(const std::string& bytes, const std::function<void(Json&)>& change) {
  uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  Json json = Json::parse(bytes.substr(20, length));
  change(json);
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string changed = bytes.substr(0, 12);
  const auto put = [&](uint32_t number) { changed.append(reinterpret_cast<const char*>(&number), 4); };
  put(uint32_t(text.size()));
  put(0x4E4F534A);
  changed += text + bytes.substr(20 + length);
  const auto size = uint32_t(changed.size());
  std::memcpy(changed.data() + 8, &size, 4);
  return changed;
}

TEST(ReadHead, RefusesWhatItDidNotWrite) {
  const std::string bytes = HeadToGlb(BallHead(), nullptr, NoClip());
  const auto refuse = [&](const std::function<void(Json&)>& change, const std::string& part) {
    ExpectError([&] { ParseHead(WithDocument(bytes, change), "head.glb"); }, part);
  };
  refuse([](Json& json) { json["asset"]["generator"] = "Khronos Blender"; },
         "head.glb: was written by Khronos Blender. Give a head that `daumier rig` or `daumier avatar` wrote");
  refuse([](Json& json) { json["meshes"][0]["primitives"][0]["targets"].erase(0); }, "51 targets have 52 names");
  refuse([](Json& json) { json["meshes"][0]["primitives"][0].erase("indices"); }, "head.glb: is damaged");
  refuse([](Json& json) { json["nodes"] = 3; }, "head.glb: is damaged");
  refuse([](Json& json) { json["nodes"].erase(json["nodes"].size() - 1); }, "head.glb: is damaged");
  refuse([](Json& json) { json["scenes"][0]["nodes"][0] = 77; }, "head.glb: is damaged");
  ExpectError(
      [] { ParseHead(HeadToGlb(BallHead(), nullptr, NoClip(), {.nodes = HeadNodeNames::kReadyPlayerMe}), "rpm.glb"); },
      "rpm.glb: has the nodes of Ready Player Me");
  ExpectError([] { ParseHead(HeadToVrm(BallHead(), nullptr), "head.vrm"); }, "head.vrm: has the nodes of");
  ExpectError([] { ParseHead(HeadToGlb(BallHead(), nullptr, NoClip(), {.compressed = true}), "small.glb"); },
              "small.glb: is compressed");
}

TEST(ReadHead, WithoutStatedTrianglesHasSkin) {
  const render::Image texture(4, 4, 3, 90);
  const std::string bytes = HeadToGlb(BallHead(), &texture, NoClip());
  const HeadInFile read = ParseHead(WithDocument(bytes,
                                                 [](Json& json) {
                                                   for (Json& node : json["nodes"]) node.erase("extras");
                                                 }),
                                    "old.glb");
  EXPECT_EQ(std::ranges::count(read.head.materials, faces::HeadMaterial::kSkin), std::ssize(read.head.materials));
}

}  // namespace
}  // namespace daumier::gltf
