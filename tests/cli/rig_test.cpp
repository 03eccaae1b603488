// `daumier rig` as its users run it.
#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "faces/face_model_file.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "reports/head_file.h"
#include "rig/expression_targets.h"
#include "rig/face_sides.h"
#include "tests/cli/pipeline.h"
#include "tests/geometry/shapes.h"
#include "tests/support/glb_reader.h"
#include "tests/support/other_topology.h"
#include "tests/support/sealed_slit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The mean face of the shipped face model, as a mesh.
class RigCommand : public ::testing::Test {
 protected:
  static const faces::FaceModel& Model() {
    static const faces::FaceModel model = faces::ReadFaceModelWeights(SourceRoot() / "weights/face-ict");
    return model;
  }
  RigCommand() { Write("face.obj", Model().face_template.neutral); }

  void Write(const std::string& name, const geometry::Points& vertices) const {
    geometry::WriteObj(folder_ / name, faces::SurfaceMesh(Model().face_template, vertices));
  }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult Rig(const std::string& face, const std::string& out, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"rig", In(face), "--out", In(out)});
    return Daumier(options);
  }

  const TempDir folder_;
};

TEST_F(RigCommand, WritesAHeadThatMovesAndAPictureOfIt) {
  const ProcessResult result = Rig("face.obj", "head.glb", {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  EXPECT_EQ(summary.at("targets"), 52);
  EXPECT_EQ(summary.at("source"), "ict");
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  EXPECT_EQ(head.json()["meshes"][0]["extras"]["targetNames"].size(), 52u);
  EXPECT_EQ(head.json()["meshes"][0]["extras"]["targetNames"][0], "eyeBlinkLeft");
  EXPECT_EQ(head.json()["animations"].size(), 1u);
  EXPECT_THAT(head.json()["asset"]["copyright"].get<std::string>(), HasSubstr("MIT"));
  EXPECT_GT(render::ReadImage(folder_ / "head.png").width, 1000);
  // The same command again, and its bytes.
  const std::string bytes = ReadFile(folder_ / "head.glb");
  ASSERT_EQ(Rig("face", "head.glb").exit_code, 0) << "the mesh without its extension";
  EXPECT_EQ(ReadFile(folder_ / "head.glb"), bytes);
}

TEST_F(RigCommand, PlaysARecordingInTheNamesOfAProgram) {
  WriteFileAtomically(folder_ / "take.csv",
                      "Timecode,BlendShapeCount,JawOpen,EyeLookOutLeft,Smirk\n0:0:0:0,61,0,0,0\n0:0:0:2,61,1,1,0\n");
  const ProcessResult result = Rig("face.obj", "head.glb",
                                   {"--animate", In("take.csv"), "--names", "unreal", "--visemes", "--frames",
                                    In("frames"), "--frame-size", "48", "--vrm", "--compress"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("50 of 52 targets are missing and 0: "), HasSubstr("Smirk")));
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  const Json names = head.json()["meshes"][0]["extras"]["targetNames"];
  ASSERT_EQ(names.size(), 67u);
  EXPECT_EQ(names[17], "JawOpen");
  EXPECT_EQ(names[52], "viseme_sil");
  // The last key of the weights: JawOpen and EyeLookOutLeft are 1; and the left eye has turned by 30 degrees.
  for (const Json& channel : head.json()["animations"][0]["channels"]) {
    const Json& sampler = head.json()["animations"][0]["samplers"][channel["sampler"].get<size_t>()];
    const auto keys = head.Floats(sampler["output"].get<int>());
    const std::string node = head.json()["nodes"][channel["target"]["node"].get<size_t>()]["name"];
    if (channel["target"]["path"] == "weights") {
      EXPECT_NEAR(keys.bottomRows(67).sum(), 2, 1e-5);
      EXPECT_NEAR(keys(keys.rows() - 67 + 17, 0), 1, 1e-5);
    } else if (node == "LeftEye") {
      EXPECT_NEAR(keys(keys.rows() - 1, 1), std::sin(15 * std::numbers::pi / 180), 1e-4);
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "head.vrm"));
  EXPECT_LT(5 * fs::file_size(folder_ / "head_compressed.glb"), fs::file_size(folder_ / "head.glb"));
  const Manifest frames = ReadManifest(folder_ / "frames", "frames");
  EXPECT_EQ(frames.counts["frames"], 3);
  EXPECT_EQ(render::ReadImage(folder_ / "frames/frame_00003.png").width, 48);
  EXPECT_NE(ReadFile(folder_ / "frames/frame_00001.png"), ReadFile(folder_ / "frames/frame_00003.png"));
}

/// As heads do whose neck is cut elsewhere, because another neutral face than the model's decides on the cut.
TEST_F(RigCommand, RigsMeshesThatEndWithOtherParts) {
  geometry::TriangleMesh mesh = faces::SurfaceMesh(Model().face_template, Model().face_template.neutral);
  mesh.uv.resize(0, 2);
  mesh.uv_triangles.resize(0, 3);
  const Eigen::Index num_vertices = mesh.vertices.rows(), num_triangles = mesh.triangles.rows();
  mesh.vertices.conservativeResize(num_vertices + 3, Eigen::NoChange);
  mesh.vertices.bottomRows(3) << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.triangles.conservativeResize(num_triangles + 1, Eigen::NoChange);
  mesh.triangles.bottomRows(1) << int(num_vertices), int(num_vertices) + 1, int(num_vertices) + 2;
  geometry::WriteObj(folder_ / "other.obj", mesh);
  EXPECT_EQ(Rig("other.obj", "other.glb").exit_code, 0);
}

TEST_F(RigCommand, RigsFinishedHeadsAndRemovesTheExpressionThatAPredictionStates) {
  const faces::FaceModel& model = Model();
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(model.expression_shapes.cols());
  weights[5] = 0.5f;
  const Eigen::VectorXd offset = (model.expression_shapes * weights).cast<double>();
  const geometry::Points smiling =
      model.face_template.neutral + Eigen::Map<const geometry::Points>(offset.data(), offset.size() / 3, 3);
  MakeDirectory(folder_ / "predicted");
  reports::WriteHead(folder_ / "predicted/portrait.obj", faces::FinishedHead(model.face_template), smiling);
  const Json record = {{"coefficients", {{"expression", std::vector<float>(weights.begin(), weights.end())}}}};
  WriteFileAtomically(folder_ / "predicted/manifest.json",
                      Json{{"details", {{"drawings", {{"portrait", record}}}}}}.dump());
  const auto highest = [&](const std::string& out, const std::vector<std::string>& options) {
    const ProcessResult result = Rig("predicted/portrait", out, options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const GlbReader head(ReadFile(folder_ / out));
    return head.Floats(head.json()["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>());
  };
  ASSERT_EQ(Rig("face.obj", "neutral.glb").exit_code, 0);
  const GlbReader neutral(ReadFile(folder_ / "neutral.glb"));
  const auto expected =
      neutral.Floats(neutral.json()["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>());
  EXPECT_NEAR((highest("removed.glb", {}) - expected).cwiseAbs().maxCoeff(), 0, 2e-6);
  EXPECT_THAT(Rig("predicted/portrait", "kept.glb", {"--keep-expression"}).err, Not(HasSubstr("has no effect")));
  EXPECT_GT((highest("kept.glb", {"--keep-expression"}) - expected).cwiseAbs().maxCoeff(), 1e-3);
}

TEST_F(RigCommand, RefusesMeshesWithoutAFaceAndOtherUnits) {
  geometry::WriteObj(folder_ / "ball.obj", Sphere(1, 3));
  const ProcessResult ball = Rig("ball.obj", "head.glb");
  EXPECT_EQ(ball.exit_code, 1);
  EXPECT_THAT(ball.err,
              AllOf(HasSubstr("ball.obj: no face was found"), HasSubstr("give its landmarks with --landmarks")));
  Write("metres.obj", 0.01 * Model().face_template.neutral);
  EXPECT_THAT(Rig("metres.obj", "head.glb").err, HasSubstr("Scale it to centimetres"));
  EXPECT_FALSE(fs::exists(folder_ / "head.glb"));
  EXPECT_FALSE(fs::exists(folder_ / "head.png"));
}

/// The model's mean face with other vertices, lying on its back in metres, and a file of its landmarks.
class RigOfForeignHeads : public RigCommand {
 protected:
  RigOfForeignHeads() {
    Rng rng(1);
    const faces::FaceTemplate& face = Model().face_template;
    const OtherTopology other = DecimatedTopology({face.neutral, face.triangles}, 0.4, rng);
    mesh_ = {InMetresWithZUp(other.Vertices(face.neutral)), other.triangles};
    geometry::WriteObj(folder_ / "foreign.obj", mesh_);
    const geometry::Points landmarks = InMetresWithZUp(face.neutral(face.annotation.landmarks, Eigen::all));
    std::string text;
    for (const auto& p : landmarks.rowwise()) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
    WriteFileAtomically(folder_ / "landmarks.txt", text);
  }

  static geometry::Points InMetresWithZUp(const geometry::Points& points) {
    geometry::Points turned(points.rows(), 3);
    turned << points.col(0), -points.col(2), points.col(1);
    return 0.01 * turned;
  }

  geometry::TriangleMesh mesh_;
};

TEST_F(RigOfForeignHeads, WritesTheHeadsOwnVerticesUprightInTheirOrder) {
  const ProcessResult result = Rig("foreign.obj", "head.glb", {"--landmarks", In("landmarks.txt"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  EXPECT_EQ(summary["targets"], 52);
  EXPECT_EQ(summary["axes"], "z up, the face to -y");
  EXPECT_EQ(summary["unit"], "metres");
  EXPECT_EQ(summary["slits"], (Json{{"mouth", "open"}, {"right_eye", "open"}, {"left_eye", "open"}}));
  EXPECT_THAT(result.err, AllOf(HasSubstr("no eyeballs were found"), HasSubstr("no lower teeth")));
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  const auto positions = head.Floats(head.primitive("Head")["attributes"]["POSITION"].get<int>());
  ASSERT_EQ(positions.rows(), mesh_.vertices.rows());
  // Upright: z of the file is y, and differences are those of the file.
  for (const Eigen::Index v : {Eigen::Index(1), Eigen::Index(700), mesh_.vertices.rows() - 1}) {
    const Eigen::RowVector3d expected = mesh_.vertices.row(v) - mesh_.vertices.row(0);
    const Eigen::RowVector3f found = positions.row(v) - positions.row(0);
    EXPECT_NEAR(found.y(), expected.z(), 1e-6);
    EXPECT_NEAR(found.z(), -expected.y(), 1e-6);
    EXPECT_NEAR(found.x(), expected.x(), 1e-6);
  }
}

TEST_F(RigOfForeignHeads, IgnoresVerticesThatAreNotFinite) {
  const std::string text = ReadFile(folder_ / "foreign.obj");
  WriteFileAtomically(folder_ / "foreign.obj", text + "v nan 0 0\n");
  const ProcessResult result = Rig("foreign.obj", "head.glb", {"--landmarks", In("landmarks.txt"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 vertices are not finite and are ignored"));
  EXPECT_EQ(Json::parse(result.out)["vertices"], mesh_.vertices.rows() + 1);
}

TEST_F(RigOfForeignHeads, KeepsMaterialsAndUv) {
  mesh_.uv = mesh_.vertices.leftCols(2);
  mesh_.uv_triangles = mesh_.triangles;
  render::WriteImage(folder_ / "skin.png", render::Image(4, 4, 3, 200));
  const Eigen::Index half = mesh_.triangles.rows() / 2;
  geometry::WriteObj(folder_ / "foreign.obj", mesh_,
                     {{"a", "skin", half}, {"b", "collar", mesh_.triangles.rows() - half}},
                     {{"skin", {1, 1, 1}, 0}, {"collar", {0.5f, 0.25f, 0.125f}, 0}});
  WriteFileAtomically(folder_ / "foreign.mtl", "newmtl skin\nmap_Kd skin.png\nnewmtl collar\nKd 0.5 0.25 0.125\n");
  const ProcessResult result = Rig("foreign.obj", "head.glb", {"--landmarks", In("landmarks.txt")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  std::set<std::string> names;
  for (const Json& material : head.json()["materials"]) names.insert(material["name"].get<std::string>());
  EXPECT_EQ(names, (std::set<std::string>{"collar", "skin"}));
  EXPECT_EQ(head.json()["images"].size(), 1u);
  for (const Json& mesh : head.json()["meshes"])
    EXPECT_TRUE(mesh["primitives"][0]["attributes"].contains("TEXCOORD_0"));
}

TEST_F(RigOfForeignHeads, OpensSealedLipsWithCut) {
  const faces::FaceTemplate& face = Model().face_template;
  geometry::TriangleMesh sealed{InMetresWithZUp(face.neutral), face.triangles};
  Seal(rig::SlitsOf(rig::ExpressionTargets(Model()).contact())[0], sealed);
  geometry::WriteObj(folder_ / "sealed.obj", sealed, {{"a", "skin", sealed.triangles.rows()}},
                     {{"skin", {1, 0.5f, 0.25f}, 0}});
  WriteFileAtomically(folder_ / "sealed.mtl", "newmtl skin\nKd 1 0.5 0.25\n");
  const ProcessResult kept = Rig("sealed.obj", "kept.glb", {"--landmarks", In("landmarks.txt"), "--json"});
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_THAT(kept.err, AllOf(HasSubstr("the lips are sealed"), HasSubstr("--cut")));
  const ProcessResult result = Rig("sealed.obj", "head.glb", {"--landmarks", In("landmarks.txt"), "--json", "--cut"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  EXPECT_EQ(summary["slits"]["mouth"], "open");
  const Json& cut = summary["cut"];
  EXPECT_GT(cut["mouth"]["length_mm"].get<double>(), 40);
  EXPECT_EQ(cut["left_eye"], "not sealed");
  EXPECT_EQ(summary["vertices"],
            sealed.vertices.rows() + cut["vertices"].get<int>() + cut["pocket_vertices"].get<int>());
  const GlbReader head(ReadFile(folder_ / "head.glb"));
  std::set<std::string> names;
  for (const Json& material : head.json()["materials"]) names.insert(material["name"].get<std::string>());
  EXPECT_EQ(names, (std::set<std::string>{"mouth", "skin"}));
}

TEST_F(RigOfForeignHeads, RefusesATextureWithoutUv) {
  render::WriteImage(folder_ / "skin.png", render::Image(4, 4, 3, 200));
  const ProcessResult result = Rig("foreign.obj", "head.glb", {"--texture", In("skin.png")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("foreign.obj has no UV, which a texture needs. Export the mesh with UV"));
}

TEST_F(RigOfForeignHeads, StatesThatNothingWasCut) {
  const ProcessResult result =
      Rig("foreign.obj", "head.glb", {"--landmarks", In("landmarks.txt"), "--json", "--cut", "--keep-expression"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("nothing was cut"), HasSubstr("--keep-expression: has no effect")));
  EXPECT_EQ(Json::parse(result.out)["cut"]["vertices"], 0);
  EXPECT_EQ(Json::parse(result.out)["vertices"], mesh_.vertices.rows());
}

TEST_F(RigCommand, WritesAReadyPlayerMeHeadOfAtMost14MegabytesAndAVrm) {
  ASSERT_EQ(Rig("face.obj", "rpm.glb", {"--names", "rpm"}).exit_code, 0);
  EXPECT_LE(fs::file_size(folder_ / "rpm.glb"), 14'000'000u);
  const GlbReader rpm(ReadFile(folder_ / "rpm.glb"));
  const Json names = rpm.json()["meshes"][rpm.node("Wolf3D_Head")["mesh"].get<size_t>()]["extras"]["targetNames"];
  ASSERT_EQ(names.size(), 72u);
  EXPECT_EQ(names[0], "viseme_sil");
  EXPECT_EQ(names[15], "eyeBlinkLeft");
  EXPECT_EQ(names[71], "eyesLookDown");
  ASSERT_EQ(Rig("face.obj", "avatar.glb", {"--names", "vrm"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "avatar.vrm"));
}

TEST_F(RigCommand, RefusesMisuse) {
  WriteFileAtomically(folder_ / "head.png", "a picture of mine");
  WriteFileAtomically(folder_ / "mine.glb", "no head");
  WriteFileAtomically(folder_ / "atlas.png", "an atlas of mine");
  MakeDirectory(folder_ / "photos");
  WriteFileAtomically(folder_ / "photos/a.png", "precious");
  const std::vector<std::pair<ProcessResult, std::string>> misuses = {
      {Rig("face.obj", "head.obj"), "ends in .glb"},
      {Rig("face.obj", "head.glb"), "head.png"},
      {Rig("face.obj", "mine.glb"), "mine.glb"},
      {Rig("face.obj", "a.glb", {"--frames", In("photos")}), "photos"},
      {Rig("nobody.obj", "a.glb"), "there is no "},
      {Rig("photos", "a.glb"), "is a folder"},
      {Rig("face.obj", "a.glb", {"--names", "maya"}), "--names"},
      {Rig("face.obj", "a.glb", {"source.nam=ict"}), "source.name"},
      {Rig("face.obj", "a.glb", {"--hair-colour", "red"}), "--hair-colour red: there is no hair to colour. Add --hair"},
      {Rig("face.obj", "a.glb", {"--frame-size", "64"}), "Add --frames FOLDER"},
      {Rig("face.obj", "atlas.glb", {"--texture", In("atlas.png")}),
       "atlas.glb: the picture of expressions next to it is "},
      {Rig("face.obj", "none/a.glb"), "none"}};
  for (const auto& [result, part] : misuses) {
    EXPECT_EQ(result.exit_code, 2) << part << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(part));
  }
  EXPECT_EQ(ReadFile(folder_ / "head.png"), "a picture of mine");
  EXPECT_EQ(ReadFile(folder_ / "mine.glb"), "no head");
  EXPECT_FALSE(fs::exists(folder_ / "head.glb"));
}

TEST_F(RigCommand, WarnsOfOptionsWithoutEffect) {
  const ProcessResult result =
      Rig("face.obj", "head.glb", {"--keep-expression", "--cut", "--hair", "bald", "--hair-colour", "red"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("--keep-expression: has no effect. face is no face whose expression"),
                                HasSubstr("--cut: the lips and lids of face are not sealed"),
                                HasSubstr("--hair-colour red: has no effect, the head is bald")));
}

TEST_F(RigCommand, ABadClipWritesNothing) {
  WriteFileAtomically(folder_ / "take.csv", "time,jawOpen\n0,0\n1,wide\n");
  const ProcessResult result = Rig("face.obj", "head.glb", {"--animate", In("take.csv")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("take.csv: line 3: column jawOpen: 'wide' is no number"));
  EXPECT_FALSE(fs::exists(folder_ / "head.glb"));
}

}  // namespace
}  // namespace daumier::testing
