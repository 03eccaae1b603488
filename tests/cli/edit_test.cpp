#include "core/files.h"
#include "core/json.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "tests/cli/pipeline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;

/// `daumier edit` by the shipped face model.
class EditCommand : public ::testing::Test {
 protected:
  ProcessResult Edit(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command = {"/usr/bin/env", "DAUMIER_WEIGHTS=" + (SourceRoot() / "weights").string(),
                                        DAUMIER_PROGRAM, "--quiet", "edit"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return RunProcess(command);
  }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  Json ReadEdit(const std::string& name) const { return ReadJson(folder_ / name / "edit.json"); }

  const TempDir folder_;
};

/// Heads of portraits have their necks cut elsewhere, and so another number of vertices than the template's.
TEST_F(EditCommand, BeginsWithTheFaceOfAMeshThatEndsWithOtherParts) {
  ASSERT_EQ(Edit({"--random", "1", "--seed", "3", "--out", In("random")}).exit_code, 0);
  std::string text = ReadFile(folder_ / "random/random_1.obj");
  const size_t num_vertices = size_t(geometry::ReadObj(folder_ / "random/random_1.obj").vertices.rows());
  text += fmt::format("v 0 0 0\nv 1 0 0\nv 0 1 0\nf {} {} {}\n", num_vertices + 1, num_vertices + 2, num_vertices + 3);
  WriteFileAtomically(folder_ / "longer.obj", text);
  const ProcessResult longer = Edit({"--face", In("longer.obj"), "--out", In("longer")});
  ASSERT_EQ(longer.exit_code, 0) << longer.err;
  ASSERT_EQ(Edit({"--face", In("random/random_1.obj"), "--out", In("same")}).exit_code, 0);
  EXPECT_EQ(ReadEdit("longer").at("faces")[0].at("code"), ReadEdit("same").at("faces")[0].at("code"));
}

TEST_F(EditCommand, HandlesGoBackToTheirCodeAndMesh) {
  const ProcessResult moved = Edit({"--handle", "nose=1", "--steps", "2", "--ply", "--out", In("nose")});
  ASSERT_EQ(moved.exit_code, 0) << moved.err;
  for (const char* name : {"mean.obj", "handles_1.obj", "handles_2.obj", "handles_2.ply", "sheet.png", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder_ / "nose" / name)) << name;
  const Json faces = ReadEdit("nose").at("faces");
  ASSERT_EQ(faces.size(), 3u);
  EXPECT_LE(faces[2].at("residual_share").get<double>(), 0.05);
  EXPECT_TRUE(faces[2].at("usual").get<bool>());
  // The written mesh is a face of the model; so is the stored code.
  const ProcessResult from_mesh = Edit({"--face", In("nose/handles_2.obj"), "--out", In("from_mesh")});
  ASSERT_EQ(from_mesh.exit_code, 0) << from_mesh.err;
  EXPECT_LT(ReadEdit("from_mesh").at("faces")[0].at("mean_error_mm").get<double>(), 0.2);
  const ProcessResult from_code = Edit({"--code", In("nose/edit.json#handles_2"), "--out", In("from_code")});
  ASSERT_EQ(from_code.exit_code, 0) << from_code.err;
  EXPECT_EQ(ReadFile(folder_ / "from_code/handles_2.obj"), ReadFile(folder_ / "nose/handles_2.obj"));
}

TEST_F(EditCommand, SamplesAreThoseOfTheirSeed) {
  ASSERT_EQ(Edit({"--random", "2", "--seed", "5", "--out", In("a")}).exit_code, 0);
  ASSERT_EQ(Edit({"--random", "2", "--seed", "5", "--out", In("b")}).exit_code, 0);
  EXPECT_EQ(ReadFile(folder_ / "a/random_2.obj"), ReadFile(folder_ / "b/random_2.obj"));
  EXPECT_NE(ReadFile(folder_ / "a/random_1.obj"), ReadFile(folder_ / "a/random_2.obj"));
  const ProcessResult between =
      Edit({"--face", In("a/random_1.obj"), "--toward", In("a/random_2.obj"), "--steps", "2", "--out", In("between")});
  ASSERT_EQ(between.exit_code, 0) << between.err;
  const geometry::Points start = geometry::ReadObj(folder_ / "between/random_1.obj").vertices,
                         middle = geometry::ReadObj(folder_ / "between/toward_1.obj").vertices,
                         end = geometry::ReadObj(folder_ / "between/toward_2.obj").vertices;
  EXPECT_LT((middle - (start + end) / 2).cwiseAbs().maxCoeff(), 1e-3);  // A linear model.
}

TEST_F(EditCommand, LandmarksOfAPictureGiveAFace) {
  std::string text;
  for (int k = 0; k < 68; ++k) {  // An oval face with the usual places, by a few rules; one point is absent.
    const double t = k < 17 ? 3.1416 * (k - 8) / 16.0 : 0;
    const double x = k < 17   ? 100 + 70 * std::sin(t)
                     : k < 27 ? 50 + 11 * (k - 17)
                     : k < 31 ? 100
                     : k < 36 ? 86 + 7 * (k - 31)
                     : k < 42 ? 60 + 5 * ((k - 36) % 4)
                     : k < 48 ? 122 + 5 * ((k - 42) % 4)
                              : 75 + 4 * ((k - 48) % 12);
    const double y = k < 17   ? 90 + 80 * std::cos(t)
                     : k < 27 ? 70
                     : k < 31 ? 85 + 10 * (k - 27)
                     : k < 36 ? 122
                     : k < 48 ? 85
                              : 142;
    text += k == 40 ? "nan nan\n" : fmt::format("{} {}\n", x, y);
  }
  WriteFileAtomically(folder_ / "points.txt", text);
  const ProcessResult result = Edit({"--landmarks", In("points.txt"), "--out", In("face")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json face = ReadEdit("face").at("faces")[0];
  EXPECT_EQ(face.at("num_landmarks"), 67);
  EXPECT_LT(face.at("mean_distance_share").get<double>(), 0.2);
}

TEST_F(EditCommand, AnyAnnotatedSetOfPointsGivesAFace) {
  const fs::path face = folder_ / "mean/mean.obj";
  ASSERT_EQ(Edit({"--random", "1", "--out", In("mean")}).exit_code, 0);
  const geometry::Points vertices = geometry::ReadObj(face).vertices;
  std::string points, numbers;
  for (int v = 0; v < vertices.rows(); v += 400) {
    points += fmt::format("{} {}\n", 200 + 12 * vertices(v, 0), 200 - 12 * vertices(v, 1));
    numbers += fmt::format("{}\n", v % 1600 == 0 ? -1 : v);
  }
  WriteFileAtomically(folder_ / "points.txt", points);
  WriteFileAtomically(folder_ / "vertices.txt", numbers);
  const ProcessResult result =
      Edit({"--landmarks", In("points.txt"), "--landmark-vertices", In("vertices.txt"), "--out", In("face")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(ReadEdit("face").at("faces")[0].at("mean_distance_share").get<double>(), 0.01);
  EXPECT_EQ(Edit({"--landmark-vertices", In("vertices.txt"), "--out", In("face")}).exit_code, 2);
}

TEST_F(EditCommand, APictureWithoutAFaceIsRefused) {
  render::WriteImage(folder_ / "plain.png", render::Image(120, 120, 3, 200));
  const ProcessResult result = Edit({"--picture", In("plain.png"), "--out", In("face")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("plain.png"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--landmarks FILE"), std::string::npos) << result.err;
  EXPECT_EQ(Edit({"--picture", In("plain.png"), "--code", In("a.json"), "--out", In("face")}).exit_code, 2);
}

TEST_F(EditCommand, APictureIsATextureOfEveryFace) {
  const std::string picture = (SourceRoot() / "docs/examples/portraits/woman.jpg").string();
  const ProcessResult result = Edit({"--picture", picture, "--texture", "--texture-size", "256", "--handle", "nose=1",
                                     "--steps", "1", "--out", In("face")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json edit = ReadEdit("face"), texture = edit.at("texture");
  EXPECT_NEAR(
      texture.at("seen").get<double>() + texture.at("mirrored").get<double>() + texture.at("filled").get<double>(), 1,
      1e-4);
  EXPECT_GT(texture.at("seen").get<double>(), 0.2);
  const render::Image atlas = render::ReadImage(folder_ / "face/texture.png");
  EXPECT_EQ(atlas.width, 256);
  EXPECT_EQ(atlas.height, 256);
  const geometry::PolygonMesh start = geometry::ReadObj(folder_ / "face/woman.obj"),
                              edited = geometry::ReadObj(folder_ / "face/handles_1.obj");
  ASSERT_TRUE(start.has_uv());
  EXPECT_EQ(start.uv, edited.uv);  // One atlas.
  EXPECT_EQ(start.uv_corners, edited.uv_corners);
  for (const char* name : {"woman.mtl", "handles_1.mtl"})
    EXPECT_NE(ReadFile(folder_ / "face" / name).find("map_Kd texture.png"), std::string::npos) << name;
  // A head is a face of the model again, and an edit of its code has the same atlas.
  const ProcessResult from_head = Edit({"--face", In("face/handles_1.obj"), "--out", In("from_head")});
  ASSERT_EQ(from_head.exit_code, 0) << from_head.err;
  EXPECT_LT(ReadEdit("from_head").at("faces")[0].at("mean_error_mm").get<double>(), 0.2);
  const ProcessResult later = Edit({"--code", In("face/edit.json#handles_1"), "--texture", "--handle", "ears=0.5",
                                    "--steps", "1", "--out", In("later")});
  ASSERT_EQ(later.exit_code, 0) << later.err;
  EXPECT_EQ(render::ReadImage(folder_ / "later/texture.png").pixels, atlas.pixels);
  EXPECT_EQ(geometry::ReadObj(folder_ / "later/start.obj").vertices, edited.vertices);
  EXPECT_NE(geometry::ReadObj(folder_ / "later/handles_1.obj").vertices, edited.vertices);
}

TEST_F(EditCommand, WritesOverNothingThatItReads) {
  ASSERT_EQ(Edit({"--random", "1", "--out", In("first")}).exit_code, 0);
  const std::string before = ReadFile(folder_ / "first/edit.json");
  for (const std::vector<std::string>& input : {std::vector<std::string>{"--code", In("first/edit.json#random_1")},
                                                {"--face", In("first/random_1.obj")},
                                                {"--face", In("first/random_1")},
                                                {"--toward", In("first/random_1.obj")}}) {
    std::vector<std::string> words = input;
    words.insert(words.end(), {"--out", In("first")});
    EXPECT_EQ(Edit(words).exit_code, 2) << words[0] << " " << words[1];
    EXPECT_EQ(ReadFile(folder_ / "first/edit.json"), before);
  }
}

TEST_F(EditCommand, RefusesWhatItCannotDo) {
  const auto expect = [&](const std::vector<std::string>& arguments, int exit_code, const std::string& part) {
    const ProcessResult result = Edit(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << part;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  };
  const std::string out = In("out");
  expect({"--random", "1"}, 2, "--out FOLDER is missing");
  expect({"--handle", "knee=1", "--out", out}, 2, "no landmark, vertex, triangle or preset");
  expect({"--face", In("absent.obj"), "--out", out}, 2, "there is no");
  expect({"--label", "smile=1", "--out", out}, 2, "add --labelled FOLDER");
  expect({"--handle", "nose=1", "--texture", "--out", out}, 2, "--texture needs the picture");
  expect({In("absent"), "--out", out}, 2, "there is no model here");
  WriteFileAtomically(folder_ / "small.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect({"--face", In("small.obj"), "--out", out}, 1, "Add --mesh-landmarks");
  WriteFileAtomically(folder_ / "few.txt", "0 0\n1 1\n");
  expect({"--landmarks", In("few.txt"), "--out", out}, 1, "few.txt");
  WriteFileAtomically(folder_ / "code.json", "{}");
  expect({"--code", In("code.json"), "--out", out}, 1, "no edit.json");
  EXPECT_FALSE(fs::exists(out));
  MakeDirectory(out);
  WriteFileAtomically(folder_ / "out/mine.txt", "mine");
  expect({"--random", "1", "--out", out}, 2, "out");
  EXPECT_EQ(ReadFile(folder_ / "out/mine.txt"), "mine");
}

}  // namespace
}  // namespace daumier::testing
