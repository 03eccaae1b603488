#include "rig/edited_match.h"

#include "core/random.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <numeric>

namespace daumier::rig {
namespace {

using testing::BallHead;
using testing::ExpectError;

/// The head's mesh as another program exports it: a vertex a place, in random order, y up, cm.
struct ExportedMesh {
  geometry::PolygonMesh mesh;
  std::vector<int> of_vertices;  ///< The place of each.
};

ExportedMesh Exported(const RiggedHead& head, uint64_t seed = 1) {
  Rng rng(seed);
  const geometry::TriangleMesh& from = head.mesh;
  ExportedMesh exported{.mesh = {}, .of_vertices = rng.Permutation(int(from.vertices.rows()))};
  std::vector<int> rows(exported.of_vertices.size());
  for (size_t i = 0; i < rows.size(); ++i) rows[size_t(exported.of_vertices[i])] = int(i);
  exported.mesh.vertices = from.vertices(exported.of_vertices, Eigen::all);
  exported.mesh.uv = from.uv;
  for (const int f : rng.Permutation(int(from.triangles.rows()))) {
    for (int k = 0; k < 3; ++k) {
      exported.mesh.corners.push_back(rows[size_t(from.triangles(f, k))]);
      exported.mesh.uv_corners.push_back(from.uv_triangles(f, k));
    }
    exported.mesh.offsets.push_back(int(exported.mesh.corners.size()));
  }
  return exported;
}

HeadNumbering InOrder(const RiggedHead& head, double height = 0) {
  HeadNumbering numbering{.of_file_vertices = std::vector<int>(size_t(head.mesh.vertices.rows())), .height_cm = height};
  std::iota(numbering.of_file_vertices.begin(), numbering.of_file_vertices.end(), 0);
  return numbering;
}

/// z up, metres.
geometry::Points MetresZUp(const geometry::Points& points) {
  geometry::Points turned(points.rows(), 3);
  turned << points.col(0), -points.col(2), points.col(1);
  return 0.01 * turned;
}

void ExpectUnchanged(const RiggedHead& head, const EditedMatch& match) {
  EXPECT_EQ(match.places, PlacesOf(head)) << "exactly: within 5 um";
  for (Eigen::Index v = 0; v < head.mesh.vertices.rows(); ++v) ASSERT_TRUE(match.is_matched[size_t(v)]) << v;
}

TEST(MatchEdited, FindsWeldedAndReorderedVerticesByUv) {
  const RiggedHead head = BallHead();
  const EditedMatch match = MatchEdited(head, InOrder(head), Exported(head).mesh);
  ExpectUnchanged(head, match);
  EXPECT_EQ(match.by, MatchedBy::kUv);
  EXPECT_EQ(match.num_vertices, head.mesh.vertices.rows());
  EXPECT_EQ(match.axes, "y up");
  EXPECT_EQ(match.unit, "centimetres");
  EXPECT_FALSE(match.is_matched.back()) << "eyes are not in it";
}

TEST(MatchEdited, UndoesWholeAxesUnitsAndTheSceneHeight) {
  const RiggedHead head = BallHead();
  geometry::PolygonMesh mesh = Exported(head).mesh;
  mesh.vertices.col(1).array() += 155;
  mesh.vertices = MetresZUp(mesh.vertices);
  const EditedMatch match = MatchEdited(head, InOrder(head, 155), mesh);
  ExpectUnchanged(head, match);
  EXPECT_EQ(match.axes, "z up");
  EXPECT_EQ(match.unit, "metres");
  mesh.vertices *= 1000;
  mesh.vertices.rowwise() += Eigen::RowVector3d(5000, 200, -70);
  const EditedMatch moved = MatchEdited(head, InOrder(head, 155), mesh);
  EXPECT_EQ(moved.unit, "millimetres");
  ExpectUnchanged(head, moved);
}

TEST(MatchEdited, KeepsAnEditAndTheSizeOfAHead) {
  const RiggedHead head = BallHead();
  ExportedMesh exported = Exported(head);
  exported.mesh.vertices(5, 2) += 1;
  const EditedMatch match = MatchEdited(head, InOrder(head), exported.mesh);
  geometry::Points expected = PlacesOf(head);
  expected(exported.of_vertices[5], 2) += 1;
  EXPECT_LT((match.places - expected).cwiseAbs().maxCoeff(), 1e-9);

  exported.mesh.vertices = 1.2 * head.mesh.vertices(exported.of_vertices, Eigen::all);
  const EditedMatch larger = MatchEdited(head, InOrder(head), exported.mesh);
  const Eigen::Index count = head.mesh.vertices.rows();
  const geometry::Points grown = larger.places.topRows(count);
  EXPECT_NEAR((grown.row(0) - grown.row(7)).norm(),
              1.2 * (head.mesh.vertices.row(0) - head.mesh.vertices.row(7)).norm(), 1e-9);
}

TEST(MatchEdited, TellsVerticesOfEqualUvApartByPlace) {
  RiggedHead head = BallHead();
  for (int r = 0; r < 40; ++r) head.mesh.uv.row(100 + r) = head.mesh.uv.row(60 + r);  // As mirrored halves have.
  ExpectUnchanged(head, MatchEdited(head, InOrder(head), Exported(head).mesh));
}

TEST(MatchEdited, FindsVerticesByOrderWithoutUv) {
  const RiggedHead head = BallHead();
  geometry::PolygonMesh mesh{.vertices = head.mesh.vertices};
  for (const auto& triangle : head.mesh.triangles.rowwise()) {
    mesh.corners.insert(mesh.corners.end(), triangle.begin(), triangle.end());
    mesh.offsets.push_back(int(mesh.corners.size()));
  }
  mesh.vertices.row(3).z() += 0.5;
  const EditedMatch match = MatchEdited(head, InOrder(head), mesh);
  EXPECT_EQ(match.by, MatchedBy::kOrder);
  EXPECT_NEAR(match.places(3, 2), head.mesh.vertices(3, 2) + 0.5, 1e-9);
  for (int& corner : mesh.corners) corner = (7 * corner + 3) % int(mesh.vertices.rows());  // 200 vertices.
  ExpectError([&] { MatchEdited(head, InOrder(head), mesh); }, "it has no UV, and another number or order of vertices");
}

TEST(MatchEdited, RefusesWhatDoesNotFit) {
  const RiggedHead head = BallHead();
  const geometry::PolygonMesh mesh = Exported(head).mesh;
  const auto refuse = [&](const std::function<void(geometry::PolygonMesh&)>& change, const std::string& part) {
    geometry::PolygonMesh changed = mesh;
    change(changed);
    ExpectError([&] { MatchEdited(head, InOrder(head), changed); }, part);
  };
  refuse([](auto& m) { m.uv.bottomRows(3).array() += 0.01; },
         "vertices have no match in the head: no vertex of it has");
  refuse([](auto& m) { m.uv.array() += 5; }, "its UV are others");
  refuse([](auto& m) { m.vertices *= 100; }, "Scale it back");
  refuse(
      [](auto& m) {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
        m.vertices = (m.vertices * turn.transpose()).eval();
      },
      "is turned by 40 degrees");
  refuse(
      [](auto& m) {
        m.corners.resize(3 * 20);
        m.uv_corners.resize(3 * 20);
        m.offsets.resize(21);
      },
      "vertices that the head's targets move are in the mesh");
}

TEST(PlacesOf, AreTheHeadsThenThoseOfItsEyes) {
  const RiggedHead head = BallHead();
  const geometry::Points places = PlacesOf(head);
  EXPECT_EQ(places.rows(), head.mesh.vertices.rows() + 2 * head.eyes[0].mesh.vertices.rows());
  EXPECT_LT((places.bottomRows(1).transpose() - head.eyes[1].centre - geometry::Vector3(0, 1.2, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace daumier::rig
