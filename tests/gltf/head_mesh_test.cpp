#include "gltf/head_mesh.h"

#include "geometry/normals.h"
#include "tests/support/ball_head.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace daumier::gltf {
namespace {

const geometry::Vector3 kOrigin = geometry::Vector3::Zero();

/// The file of one mesh, as `primitive(0)` of a node.
testing::GlbReader FileOf(const rig::RiggedHead& head, bool is_coloured, const HeadFileOptions& options) {
  GlbBuilder builder(GlbEncoding::kPlain);
  const int mesh = AddMesh(builder, "Face", head.mesh, head.materials, kOrigin, head.targets, 0, is_coloured, options);
  builder.Add("nodes", {{"name", "Head"}, {"mesh", mesh}});
  return testing::GlbReader(builder.Finish());
}

TEST(PositionsFrom, AreMetresFromThePivot) {
  geometry::Points points(2, 3);
  points << 1, 2, 3, 110, 200, -50;
  const FloatRows positions =
      PositionsFrom({10, 0, 50}, points, {.source_vertices = {1, 1, 0}, .uv = {}, .indices = {}});
  EXPECT_EQ(positions.row(0), Eigen::RowVector3f(1, 2, -1));
  EXPECT_EQ(positions.row(1), positions.row(0));
  EXPECT_TRUE(positions.row(2).isApprox(Eigen::RowVector3f(-0.09f, 0.02f, -0.47f)));
}

TEST(SplitNormals, OfABallPointOutwardsAlsoAtTheSeam) {
  const geometry::TriangleMesh ball = testing::UvBall(3, 12, 18);
  const SplitMesh split = SplitAtSeams(ball, {});
  const FloatRows normals = SplitNormals(ball, split);
  for (int n = 0; n < split.num_vertices(); ++n) {
    const Eigen::RowVector3f outwards = (ball.vertices.row(split.source_vertices[size_t(n)]) / 3).cast<float>();
    EXPECT_TRUE(normals.row(n).isApprox(outwards, 1e-5f)) << normals.row(n) << ", expected " << outwards;
  }
}

TEST(SplitNormals, HaveUnitLengthWhereNoTriangleHasArea) {
  geometry::TriangleMesh mesh;
  mesh.vertices = geometry::Points::Zero(3, 3);
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  EXPECT_EQ(SplitNormals(mesh, SplitAtSeams(mesh, {})).row(1), Eigen::RowVector3f(0, 0, 1));
}

TEST(AddMesh, KeepsPositionsUvAndTrianglesOfEveryCorner) {
  const rig::RiggedHead head = testing::BallHead();
  const testing::GlbReader file = FileOf(head, false, {});
  const Json& primitive = file.primitive("Head");
  const FloatRows positions = file.Floats(primitive["attributes"]["POSITION"]);
  const FloatRows uv = file.Floats(primitive["attributes"]["TEXCOORD_0"]);
  const std::vector<uint32_t> indices = file.Indices(primitive["indices"]);
  ASSERT_EQ(std::ssize(indices), head.mesh.triangles.size());
  for (Eigen::Index t = 0; t < head.mesh.triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const uint32_t n = indices[size_t(3 * t + c)];
      const Eigen::RowVector3d corner = head.mesh.vertices.row(head.mesh.triangles(t, c));
      EXPECT_EQ(positions.row(n), (0.01 * corner).cast<float>());
      const Eigen::RowVector2d at = head.mesh.uv.row(head.mesh.uv_triangles(t, c));
      EXPECT_FLOAT_EQ(uv(n, 0), float(at.x()));
      EXPECT_FLOAT_EQ(uv(n, 1), 1 - float(at.y())) << "v = 0 is the top of the picture";
    }
  }
}

TEST(AddMesh, TargetsAreDenseAndSmallDisplacementsAreZero) {
  rig::RiggedHead head = testing::BallHead();
  head.targets.offsets(0, 5) = 0.99e-4f;  // cm
  head.targets.offsets(1, 5) = -2e-4f;
  const testing::GlbReader file = FileOf(head, false, {});
  const Json& primitive = file.primitive("Head");
  ASSERT_EQ(primitive["targets"].size(), 52u);
  const SplitMesh split = SplitAtSeams(head.mesh, {});
  for (size_t t = 0; t < 52; ++t) {
    ASSERT_EQ(primitive["targets"][t].size(), 1u) << "positions alone";
    const int accessor = primitive["targets"][t]["POSITION"];
    EXPECT_TRUE(file.accessor(accessor).contains("bufferView") && !file.accessor(accessor).contains("sparse"));
    const FloatRows displacements = file.Floats(accessor);
    for (int n = 0; n < split.num_vertices(); ++n) {
      for (int c = 0; c < 3; ++c) {
        const float metres = 0.01f * head.targets.offsets(3 * split.source_vertices[size_t(n)] + c, Eigen::Index(t));
        EXPECT_EQ(displacements(n, c), std::abs(metres) < 1e-6f ? 0.f : metres);
      }
    }
  }
  EXPECT_EQ(file.Floats(primitive["targets"][5]["POSITION"])(0, 0), 0);
  EXPECT_LT(file.Floats(primitive["targets"][5]["POSITION"])(0, 1), 0);
}

TEST(AddMesh, NormalsOfTargetsLeadToThoseOfTheDisplacedSurface) {
  const rig::RiggedHead head = testing::BallHead();
  const testing::GlbReader file = FileOf(head, false, {.normals = true});
  const Json& primitive = file.primitive("Head");
  const size_t jaw = 17;
  geometry::TriangleMesh open = head.mesh;
  for (Eigen::Index v = 0; v < open.vertices.rows(); ++v) {
    open.vertices.row(v) += head.targets.offsets.col(jaw).segment<3>(3 * v).cast<double>().transpose();
  }
  const FloatRows expected = SplitNormals(open, SplitAtSeams(open, {}));
  const FloatRows found =
      file.Floats(primitive["attributes"]["NORMAL"]) + file.Floats(primitive["targets"][jaw]["NORMAL"]);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6f);
  for (const Json& target : primitive["targets"]) EXPECT_TRUE(target.contains("NORMAL"));
}

TEST(AddMesh, NamesTargetsAtMeshAndPrimitiveWithWeightsOfZero) {
  const rig::RiggedHead head = testing::BallHead();
  const testing::GlbReader file = FileOf(head, false, {});
  const Json& mesh = file.json()["meshes"][0];
  EXPECT_EQ(mesh["extras"]["targetNames"], Json(head.targets.names));
  EXPECT_EQ(mesh["primitives"][0]["extras"], mesh["extras"]);
  EXPECT_EQ(mesh["weights"], Json(std::vector<int>(52, 0)));
}

TEST(AddMesh, StatesTheLimitsOfWeightsInTheNamesOfTheFile) {
  rig::RiggedHead head = testing::BallHead();
  const auto limits = [&] { return FileOf(head, false, {}).json()["meshes"][0]["extras"]["weightLimits"]; };
  EXPECT_EQ(limits()["mouthClose"], Json({{"base", 0.0}, {"jawOpen", 1.0}}));
  EXPECT_EQ(limits()["eyeBlinkLeft"]["base"], 1.0);
  EXPECT_LT(limits()["eyeBlinkLeft"]["eyeSquintLeft"], 0);
  for (std::string& name : head.targets.names) name[0] = char(std::toupper(name[0]));
  EXPECT_EQ(limits()["MouthClose"], Json({{"base", 0.0}, {"JawOpen", 1.0}}));
}

TEST(AddMesh, ColoursByMaterialWithoutBlendingAcrossTheirBorder) {
  const rig::RiggedHead head = testing::BallHead();  // Its first triangle is throat, the others skin.
  const testing::GlbReader file = FileOf(head, true, {});
  const Json& primitive = file.primitive("Head");
  const int accessor = primitive["attributes"]["COLOR_0"];
  const size_t offset = file.view_of(accessor)["byteOffset"];
  const std::vector<uint32_t> indices = file.Indices(primitive["indices"]);
  const auto colour = [&](size_t corner) { return file.binary().substr(offset + 4 * indices[corner], 4); };
  EXPECT_EQ(colour(0), colour(1));
  EXPECT_NE(colour(0), colour(3));
  for (size_t corner = 3; corner < indices.size(); ++corner) EXPECT_EQ(colour(corner), colour(3));
  EXPECT_FALSE(FileOf(head, false, {}).primitive("Head")["attributes"].contains("COLOR_0"));
}

}  // namespace
}  // namespace daumier::gltf
