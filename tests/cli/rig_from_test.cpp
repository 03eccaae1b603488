// `daumier rig EDITED --from HEAD` as its users run it.
#include "core/files.h"
#include "core/json.h"
#include "geometry/obj.h"
#include "gltf/head_file.h"
#include "gltf/head_reader.h"
#include "tests/cli/pipeline.h"
#include "tests/support/ball_head.h"
#include "tests/support/glb_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A ball head with a texture in head.glb.
class RigFromCommand : public ::testing::Test {
 protected:
  RigFromCommand() {
    const render::Image texture(8, 8, 3, 120);
    gltf::WriteHead(folder_ / "head.glb", BallHead(), &texture, std::nullopt);
    WriteEdited("edited.obj", 0);
  }

  /// The mesh of head.glb as Blender exports it, in m, with a nose of `cm`.
  void WriteEdited(const std::string& name, double cm) const {
    geometry::TriangleMesh mesh = gltf::ReadHead(folder_ / "head.glb").head.mesh;
    for (auto vertex : mesh.vertices.rowwise()) {
      const double share = std::exp(-(vertex - Eigen::RowVector3d(0, 1, 10)).squaredNorm() / 4);
      vertex = 0.01 * (vertex + Eigen::RowVector3d(0, 155, share * cm));
    }
    geometry::WriteObj(folder_ / name, mesh);
  }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult RigFrom(const std::string& edited, const std::string& head, const std::string& out,
                        std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"rig", In(edited), "--from", In(head), "--out", In(out)});
    return Daumier(options);
  }

  const TempDir folder_;
};

TEST_F(RigFromCommand, WithoutAnEditGivesTheHeadAgain) {
  const ProcessResult result = RigFrom("edited.obj", "head.glb", "same.glb", {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("nothing was edited"));
  const Json summary = Json::parse(result.out);
  EXPECT_EQ(summary["matched_by"], "uv");
  EXPECT_EQ(summary["unit"], "metres");
  EXPECT_EQ(summary["edit_max_mm"], 0);
  EXPECT_EQ(summary["missing_vertices"], 0);
  EXPECT_THAT(result.err, ::testing::Not(HasSubstr("missing in it")));
  EXPECT_EQ(summary["target_change_max_mm"], 0);
  const gltf::HeadInFile before = gltf::ReadHead(folder_ / "head.glb"), after = gltf::ReadHead(folder_ / "same.glb");
  EXPECT_EQ(after.head.mesh.triangles, before.head.mesh.triangles);
  EXPECT_LT((after.head.mesh.vertices - before.head.mesh.vertices).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((after.head.targets.offsets - before.head.targets.offsets).cwiseAbs().maxCoeff(), 1.1e-4f);
  EXPECT_EQ(*after.texture, *before.texture);
  EXPECT_EQ(after.head.materials, before.head.materials);
}

TEST_F(RigFromCommand, WarnsOfAMeshThatWasDeletedInPart) {
  geometry::TriangleMesh mesh = gltf::ReadHead(folder_ / "head.glb").head.mesh;
  const int num_vertices = int(mesh.vertices.rows());
  std::vector<int> rows;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    if (mesh.vertices(mesh.triangles(f, 0), 2) > -2) rows.push_back(int(f));
  std::set<int> used;
  for (const int f : rows) used.insert(mesh.triangles.row(f).begin(), mesh.triangles.row(f).end());
  mesh.triangles = mesh.triangles(rows, Eigen::all).eval();
  mesh.uv_triangles = mesh.uv_triangles(rows, Eigen::all).eval();
  geometry::WriteObj(folder_ / "front.obj", mesh);
  const ProcessResult result = RigFrom("front.obj", "head.glb", "front.glb", {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const int num_missing = num_vertices - int(used.size());
  EXPECT_GT(num_missing, num_vertices / 5);
  EXPECT_EQ(Json::parse(result.out)["missing_vertices"], num_missing);
  EXPECT_THAT(result.err, HasSubstr(fmt::format("front.obj: {} of {} vertices ({:.1f} %)", num_missing, num_vertices,
                                                100.0 * num_missing / num_vertices)));
  EXPECT_EQ(gltf::ReadHead(folder_ / "front.glb").head.mesh.vertices.rows(), num_vertices) << "they are in it again";
}

TEST_F(RigFromCommand, TakesAnEditIntoHeadAndAvatar) {
  WriteEdited("nose.obj", 1);
  const ProcessResult result =
      RigFrom("nose.obj", "head.glb", "nose.glb", {"--vrm", "--compress", "--visemes", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  EXPECT_NEAR(summary["edit_max_mm"].get<double>(), 10, 1);
  EXPECT_GT(summary["target_change_max_mm"].get<double>(), 0.1);
  EXPECT_EQ(summary["targets"], 67);
  EXPECT_TRUE(fs::exists(folder_ / "nose.vrm"));
  EXPECT_TRUE(fs::exists(folder_ / "nose_compressed.glb"));
  const gltf::HeadInFile before = gltf::ReadHead(folder_ / "head.glb"), after = gltf::ReadHead(folder_ / "nose.glb");
  // The new head is about its pivot again: what no edit moved keeps its distances.
  EXPECT_NEAR((after.head.eyes[1].centre - after.head.eyes[0].centre).norm(), 6, 0.1);
  EXPECT_NEAR((after.head.mesh.vertices - before.head.mesh.vertices).col(2).maxCoeff(), 1, 0.1);
  // And again from the result, whose visemes are targets already.
  WriteEdited("again.obj", 0.5);
  const ProcessResult again = RigFrom("again.obj", "nose.glb", "again.glb", {"--visemes", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["targets"], 67);
}

TEST_F(RigFromCommand, KeepsOwnMaterials) {
  rig::RiggedHead head = BallHead();
  head.own_materials = {{.name = "skin"}, {.name = "hat", .colour = {0.5f, 0.25f, 0}}};
  for (Eigen::Index f = 0; f < head.mesh.triangles.rows(); ++f)
    head.own.push_back(head.mesh.vertices(head.mesh.triangles(f, 0), 1) > 8 ? 1 : 0);
  for (rig::RiggedEye& eye : head.eyes) eye.own.assign(size_t(eye.mesh.triangles.rows()), 0);
  gltf::WriteHead(folder_ / "head.glb", head, nullptr, std::nullopt);
  WriteEdited("edited.obj", 0);
  const ProcessResult result = RigFrom("edited.obj", "head.glb", "same.glb", {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["target_change_max_mm"], 0);
  const GlbReader before(ReadFile(folder_ / "head.glb")), after(ReadFile(folder_ / "same.glb"));
  EXPECT_EQ(after.json()["materials"], before.json()["materials"]);
  EXPECT_EQ(after.json()["nodes"].size(), before.json()["nodes"].size());
  for (const char* node : {"Head", "Head_hat"}) {
    const auto positions = [&](const GlbReader& file) {
      return file.Floats(file.primitive(node)["attributes"]["POSITION"].get<int>());
    };
    ASSERT_EQ(positions(after).rows(), positions(before).rows());
    EXPECT_NEAR(positions(after).norm(), positions(before).norm(), 1e-4f);
  }
}

TEST_F(RigFromCommand, KeepsTheNamesOfTheHead) {
  ASSERT_EQ(RigFrom("edited.obj", "head.glb", "phone.glb", {"--names", "mediapipe"}).exit_code, 0);
  ASSERT_EQ(RigFrom("edited.obj", "phone.glb", "kept.glb").exit_code, 0);
  ASSERT_EQ(RigFrom("edited.obj", "phone.glb", "apple.glb", {"--names", "arkit"}).exit_code, 0);
  const auto names = [&](const char* file) {
    const GlbReader head(ReadFile(folder_ / file));
    return head.json()["meshes"][0]["extras"]["targetNames"].get<std::vector<std::string>>();
  };
  EXPECT_EQ(names("kept.glb"), names("phone.glb"));
  EXPECT_EQ(names("kept.glb").front(), "_neutral");
  EXPECT_EQ(names("apple.glb"), names("head.glb"));
}

TEST_F(RigFromCommand, RefusesOtherMeshesHeadsAndOptions) {
  geometry::WriteObj(folder_ / "other.obj", UvBall(9, 7, 11));
  const ProcessResult other = RigFrom("other.obj", "head.glb", "a.glb");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, AllOf(HasSubstr("other.obj: does not fit "), HasSubstr("match in the head")));
  WriteFileAtomically(folder_ / "cut.glb", ReadFile(folder_ / "head.glb").substr(0, 1000));
  EXPECT_THAT(RigFrom("edited.obj", "cut.glb", "a.glb").err, HasSubstr("cut.glb: is damaged"));
  EXPECT_THAT(RigFrom("edited.obj", "edited.obj", "a.glb").err, HasSubstr("edited.obj: is no .glb"));
  ASSERT_EQ(RigFrom("edited.obj", "head.glb", "b.glb", {"--compress"}).exit_code, 0);
  EXPECT_THAT(RigFrom("edited.obj", "b_compressed.glb", "a.glb").err, HasSubstr("is compressed. Give the plain .glb"));
  const std::string png = In("head.png");
  WriteFileAtomically(png, "a picture");
  const std::vector<std::pair<ProcessResult, std::string>> misuses = {
      {RigFrom("edited.obj", "head.glb", "a.glb", {"--texture", png}), "--texture has no effect"},
      {RigFrom("edited.obj", "head.glb", "a.glb", {"--landmarks", In("edited.obj")}), "--landmarks has no effect"},
      {RigFrom("edited.obj", "head.glb", "a.glb", {"--hair", "short"}), "--hair has no effect"},
      {RigFrom("edited.obj", "head.glb", "a.glb", {"--cut"}), "--cut has no effect"},
      {RigFrom("edited.obj", "head.glb", "a.glb", {"source.name=ict"}), "key=value (overrides) has no effect"},
      {RigFrom("edited.obj", "head.glb", "head.glb", {}), "head.glb"},
      {RigFrom("edited.obj", "none.glb", "a.glb"), "none.glb"}};
  for (const auto& [result, part] : misuses) {
    EXPECT_EQ(result.exit_code, 2) << part << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(part));
  }
  EXPECT_FALSE(fs::exists(folder_ / "a.glb"));
}

}  // namespace
}  // namespace daumier::testing
