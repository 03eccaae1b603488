#include "gltf/head_file.h"

#include "core/files.h"
#include "gltf/glb_builder.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/glb_reader.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <meshoptimizer.h>

namespace daumier::gltf {
namespace {

namespace fs = std::filesystem;
using testing::BallHead;
using testing::ExpectError;

rig::WeightsClip OpenJaw() {
  rig::WeightsClip clip;
  clip.names = {"jawOpen", "eyeLookUpLeft"};
  clip.weights = Eigen::MatrixXf::Constant(30, 2, 0.5f);
  return clip;
}

const Json& ChannelOf(const Json& animation, int node, const std::string& path) {
  for (const Json& channel : animation["channels"]) {
    if (channel["target"]["node"] == node && channel["target"]["path"] == path) return channel;
  }
  throw Error("no channel " + path);
}

TEST(HeadToGlb, AnimatesWeightsHeadAndEyesInOneLinearClip) {
  const testing::GlbReader file(HeadToGlb(BallHead(), nullptr, OpenJaw()));
  ASSERT_EQ(file.json()["animations"].size(), 1u);
  const Json& animation = file.json()["animations"][0];
  for (const Json& sampler : animation["samplers"]) {
    EXPECT_EQ(sampler["interpolation"], "LINEAR");
    EXPECT_EQ(sampler["input"], animation["samplers"][0]["input"]) << "all at the same times";
  }
  const FloatRows times = file.Floats(animation["samplers"][0]["input"]);
  EXPECT_EQ(times.rows(), 32);
  EXPECT_EQ(file.accessor(animation["samplers"][0]["input"])["max"][0], times(31, 0));
  const auto values = [&](const char* node, const char* path) {
    const Json& channel = ChannelOf(animation, file.Node(node), path);
    return file.Floats(animation["samplers"][channel["sampler"].get<size_t>()]["output"]);
  };
  const FloatRows weights = values("Head", "weights");
  ASSERT_EQ(weights.rows(), 32 * 52) << "every key has all targets";
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LE(weights.maxCoeff(), 1);
  EXPECT_TRUE(weights.topRows(2 * 52).isZero()) << "neutral at 0 and 0.05 s";
  EXPECT_GE(times(1, 0), 0.05f);
  EXPECT_EQ(weights(2 * 52 + 17, 0), 0.5f) << "jawOpen";
  EXPECT_NEAR(values("LeftEye", "rotation")(2, 0), -std::sin(0.1308997), 1e-6) << "15 degrees up, about x";
  EXPECT_EQ(values("RightEye", "rotation").row(2), Eigen::RowVector4f(0, 0, 0, 1));
  EXPECT_EQ(values("Head", "rotation").rows(), 32);
}

TEST(HeadToGlb, ShowsTheDemoClipUnlessThereIsAnother) {
  const testing::GlbReader demo(HeadToGlb(BallHead(), nullptr, std::nullopt));
  EXPECT_EQ(demo.json()["animations"].size(), 1u);
  const testing::GlbReader still(HeadToGlb(BallHead(), nullptr, rig::WeightsClip()));
  EXPECT_FALSE(still.json().contains("animations"));
}

TEST(HeadToGlb, ArraysHaveViewsOfTheirOwnAndRequireNoExtension) {
  const testing::GlbReader file(HeadToGlb(BallHead(), nullptr, std::nullopt, {.normals = true}));
  EXPECT_FALSE(file.json().contains("extensionsRequired"));
  EXPECT_FALSE(file.json().contains("extensionsUsed"));
  EXPECT_EQ(file.json()["accessors"].size(), file.json()["bufferViews"].size());
  for (size_t a = 0; a < file.json()["accessors"].size(); ++a) {
    EXPECT_EQ(file.accessor(int(a))["bufferView"], a);
    EXPECT_FALSE(file.accessor(int(a)).contains("sparse"));
  }
  const Json& targets = file.primitive("Head")["targets"];
  for (const Json& target : targets) EXPECT_EQ(target.size(), 2u) << "every target has the same attributes";
  for (const Json& target : targets) EXPECT_TRUE(file.accessor(target["POSITION"]).contains("min"));
}

TEST(HeadToGlb, PutsThePivotAtItsHeight) {
  const testing::GlbReader file(HeadToGlb(BallHead(), nullptr, std::nullopt, {.pivot_height_m = 1.25}));
  EXPECT_EQ(file.node("Head")["translation"], Json({0, 1.25, 0}));
  EXPECT_EQ(file.json()["scenes"][0]["nodes"], Json({file.Node("Head")}));
}

TEST(HeadToGlb, GivesEqualBytesForEqualInput) {
  const render::Image texture(8, 8, 3, 90);
  for (const bool compressed : {false, true}) {
    const HeadFileOptions options{.compressed = compressed};
    EXPECT_EQ(Sha256(HeadToGlb(BallHead(), &texture, OpenJaw(), options)),
              Sha256(HeadToGlb(BallHead(), &texture, OpenJaw(), options)));
  }
}

TEST(HeadToGlb, CompressedDiffersByLessThanAHundredthOfAMillimetre) {
  const rig::RiggedHead head = BallHead(60, 90);
  const std::string plain_bytes = HeadToGlb(head, nullptr, OpenJaw());
  const std::string small_bytes = HeadToGlb(head, nullptr, OpenJaw(), {.compressed = true});
  EXPECT_LT(small_bytes.size(), plain_bytes.size() / 5);
  const testing::GlbReader plain(plain_bytes), small(small_bytes);
  // As a reader of the extension decodes it.
  const auto decoded = [&](int accessor) {
    const Json& view = small.view_of(accessor)["extensions"]["EXT_meshopt_compression"];
    const size_t count = view["count"], stride = view["byteStride"];
    FloatRows values(Eigen::Index(count), Eigen::Index(stride / sizeof(float)));
    EXPECT_EQ(meshopt_decodeVertexBuffer(
                  values.data(), count, stride,
                  reinterpret_cast<const unsigned char*>(small.binary().data()) + view["byteOffset"].get<size_t>(),
                  view["byteLength"]),
              0);
    meshopt_decodeFilterExp(values.data(), count, stride);
    return values;
  };
  // The files order vertices differently: compared are sorted rows of position and jawOpen.
  const auto sorted_rows = [](const FloatRows& rest, const FloatRows& jaw) {
    std::vector<std::array<long, 3>> rows;
    for (Eigen::Index n = 0; n < rest.rows(); ++n) {
      const Eigen::RowVector3f open = rest.row(n) + jaw.row(n);
      rows.push_back({std::lround(1e4 * open.x()), std::lround(1e4 * open.y()), std::lround(1e4 * open.z())});
    }
    std::sort(rows.begin(), rows.end());
    return rows;
  };
  const Json &a = plain.primitive("Head"), &b = small.primitive("Head");
  const auto expected =
      sorted_rows(plain.Floats(a["attributes"]["POSITION"]), plain.Floats(a["targets"][17]["POSITION"]));
  const FloatRows rest = decoded(b["attributes"]["POSITION"]), jaw = decoded(b["targets"][17]["POSITION"]);
  EXPECT_EQ(rest.rows(), std::ssize(expected));
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(small.accessor(b["attributes"]["POSITION"])["max"][size_t(c)], rest.col(c).maxCoeff());
    EXPECT_NEAR(rest.col(c).mean(), plain.Floats(a["attributes"]["POSITION"]).col(c).mean(), 1e-6f);
    EXPECT_NEAR(jaw.col(c).minCoeff(), plain.Floats(a["targets"][17]["POSITION"]).col(c).minCoeff(), 1e-5f);
  }
  EXPECT_EQ(small.json()["meshes"][0]["extras"], plain.json()["meshes"][0]["extras"]);
}

TEST(HeadToGlb, RefusesAHeadThatIsNone) {
  rig::RiggedHead head = BallHead();
  head.mesh.vertices(3, 0) = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { HeadToGlb(head, nullptr, std::nullopt); }, "vertex 3 of the head is not finite");
}

TEST(WriteHead, ChoosesTheFormatByExtension) {
  const testing::TempDir folder;
  WriteHead(folder / "head.glb", BallHead(), nullptr, OpenJaw());
  EXPECT_EQ(ReadFile(folder / "head.glb"), HeadToGlb(BallHead(), nullptr, OpenJaw()));
  WriteHead(folder / "head.vrm", BallHead(), nullptr, OpenJaw());
  EXPECT_EQ(ReadFile(folder / "head.vrm"), HeadToVrm(BallHead(), nullptr));
  ExpectError([&] { WriteHead(folder / "head.fbx", BallHead(), nullptr, OpenJaw()); },
              "head.fbx: heads are written as .glb or .vrm, not as '.fbx'");
}

TEST(WriteHead, LeavesNothingBehindWhenItFails) {
  const testing::TempDir folder;
  rig::RiggedHead head = BallHead();
  head.targets.offsets.conservativeResize(9, 52);
  ExpectError([&] { WriteHead(folder / "head.glb", head, nullptr, std::nullopt); }, "targets of 9 numbers");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  ExpectError([&] { WriteHead(folder / "no/such/folder/head.glb", BallHead(), nullptr, std::nullopt); }, "head.glb");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(WriteHead, GltfValidatorFindsNoErrorAndNoWarning) {
  const fs::path script = testing::SourceRoot() / "tools/npm/validate_gltf.mjs";
  if (!fs::exists(script.parent_path() / "node_modules/gltf-validator")) {
    GTEST_SKIP() << "gltf-validator is not installed; ./dev setup installs it";
  }
  if (testing::RunProcess({"/bin/sh", "-c", "command -v node"}).exit_code != 0) GTEST_SKIP() << "there is no node";
  const testing::TempDir folder;
  const render::Image texture(16, 16, 3, 128);
  WriteHead(folder / "plain.glb", BallHead(), nullptr, std::nullopt);
  WriteHead(folder / "textured.glb", BallHead(), &texture, OpenJaw(), {.normals = true});
  WriteHead(folder / "head.vrm", BallHead(), &texture, std::nullopt);
  const auto result = testing::RunProcess({"/usr/bin/env", "node", script.string(), (folder / "plain.glb").string(),
                                           (folder / "textured.glb").string(), (folder / "head.vrm").string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

}  // namespace
}  // namespace daumier::gltf
