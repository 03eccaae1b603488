#include "benchmark/predictions.h"

#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/kit_predictions.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::benchmark {
namespace {

using testing::ExpectError;
using testing::SmallKit;

class KitPredictions : public ::testing::Test {
 protected:
  std::map<std::string, std::filesystem::path> Files(KitTask task = KitTask::kCaricatures) const {
    return PredictionFiles(folder_.path(), kit_, task, KitSplit::kTest);
  }
  geometry::Points Neutral() const { return kit_.face_template().neutral; }
  const Kit kit_{SmallKit()};
  const testing::TempDir folder_;
};

TEST_F(KitPredictions, AreFoundByTheNamesOfTheirInputs) {
  testing::WriteFace(kit_, folder_ / "person-007-a.ply", Neutral());
  WriteFileAtomically(folder_ / "method.json", "{}");
  WriteFileAtomically(folder_ / "preview.png", "");
  EXPECT_EQ(Files().size(), 1u);
  WriteFileAtomically(folder_ / "person-007-a.obj", "v 0 0 0\n");
  EXPECT_EQ(Files().at("person-007-a").extension(), ".ply") << "the first of the kinds counts";
}

TEST_F(KitPredictions, OfUnknownNamesAreRefused) {
  ExpectError([&] { Files(); }, "has no prediction (expected NAME.ply, NAME.obj, for example person-007-a.ply)");
  testing::WriteFace(kit_, folder_ / "person-07-a.ply", Neutral());
  ExpectError([&] { Files(); }, "Name it as its input: person-007-a?");
  std::filesystem::rename(folder_ / "person-07-a.ply", folder_ / "person-001-a.ply");
  ExpectError([&] { Files(); }, "It is of the split train: --split train");
  ExpectError([&] { PredictionFiles(folder_ / "absent", kit_, KitTask::kDrawings, KitSplit::kTest); },
              "no such folder");
}

TEST_F(KitPredictions, OfTheKitsTopologyHaveItsVertices) {
  const FaceReaderOfFolder reader(folder_.path(), kit_);
  testing::WriteFace(kit_, folder_ / "a.ply", Neutral());
  const PredictedFace face = reader.Read(folder_ / "a.ply");
  EXPECT_TRUE(face.has_kit_topology);
  EXPECT_LT((face.mesh.vertices - Neutral()).norm(), 1e-4);
  WriteFileAtomically(folder_ / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError([&] { reader.Read(folder_ / "b.obj"); }, "b.obj has 3 vertices (expected");
  ExpectError([&] { reader.Read(folder_ / "b.obj"); }, "write landmarks.txt next to them: 68 lines");
  testing::AllowWarnings();  // The reader counts such vertices.
  WriteFileAtomically(folder_ / "c.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError([&] { reader.Read(folder_ / "c.obj"); }, "c.obj");
}

TEST_F(KitPredictions, OfOtherNumberingAreRefused) {
  const FaceReaderOfFolder reader(folder_.path(), kit_);
  geometry::TriangleMesh mesh{Neutral(), kit_.face_template().triangles};
  const int last = kit_.face_template().num_vertices() - 1;
  mesh.vertices = Neutral().colwise().reverse();
  mesh.triangles = last - mesh.triangles.array();
  geometry::WritePly(folder_ / "a.ply", mesh);
  ExpectError([&] { reader.Read(folder_ / "a.ply"); }, "its vertices are numbered otherwise");
}

TEST_F(KitPredictions, MayHaveMoreBehindTheVerticesOfTheKit) {
  const FaceReaderOfFolder reader(folder_.path(), kit_);
  geometry::TriangleMesh mesh{Neutral(), kit_.face_template().triangles};
  mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
  mesh.vertices.bottomRows(1) << 1, 2, 3;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) << 0, 1, int(Neutral().rows());
  geometry::WritePly(folder_ / "a.ply", mesh);
  EXPECT_TRUE(reader.Read(folder_ / "a.ply").has_kit_topology);
}

TEST_F(KitPredictions, OfAnotherTopologyNameTheirLandmarks) {
  std::string lines;
  for (int i = 0; i < 68; ++i) lines += fmt::format("{}\n", i == 3 ? -1 : i % 4);
  WriteFileAtomically(folder_ / "landmarks.txt", lines);
  const FaceReaderOfFolder reader(folder_.path(), kit_);
  EXPECT_EQ(reader.landmarks()[3], -1);
  EXPECT_EQ(reader.landmarks()[5], 1);
  WriteFileAtomically(folder_ / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  EXPECT_FALSE(reader.Read(folder_ / "b.obj").has_kit_topology);
  WriteFileAtomically(folder_ / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError([&] { reader.Read(folder_ / "b.obj"); }, "names vertex 3");
  WriteFileAtomically(folder_ / "landmarks.txt", "1\n2\n");
  ExpectError([&] { FaceReaderOfFolder(folder_.path(), kit_); }, "landmarks.txt");
}

TEST_F(KitPredictions, AreNamedByAHashOfTheirBytes) {
  testing::WriteFace(kit_, folder_ / "person-007-a.ply", Neutral());
  const std::string before = PredictionsHash(Files());
  EXPECT_EQ(before.size(), 64u);
  testing::WriteFace(kit_, folder_ / "person-007-a.ply", 2 * Neutral());
  EXPECT_NE(PredictionsHash(Files()), before);
}

}  // namespace
}  // namespace daumier::benchmark
