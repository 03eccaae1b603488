#include "faces/source_mesh.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::SyntheticGrid;

const SyntheticGrid& SourceGrid() {
  static const SyntheticGrid grid;
  return grid;
}

std::vector<int> Square() {
  return {SourceGrid().at(-1, 15), SourceGrid().at(1, 15), SourceGrid().at(1, 17), SourceGrid().at(-1, 17)};
}

TEST(SourceMesh, FloodStopsAtTheLoop) {
  const SourceMesh mesh(SourceGrid().mesh(), "grid");
  const auto loop = mesh.Trace(Square(), geometry::PathEnds::kClosed, "loop");
  EXPECT_EQ(loop.size(), 8u);
  EXPECT_EQ(mesh.Flood(SourceGrid().at(0, 16), {loop}, "inside"), SourceGrid().Block(0, 1, 15, 17));
  EXPECT_EQ(static_cast<Eigen::Index>(mesh.Flood(SourceGrid().at(0, 16), {}, "all").size()),
            SourceGrid().mesh().vertices.rows());
}

TEST(SourceMesh, MirrorIsThereOnlyForSymmetricMeshes) {
  EXPECT_EQ(SourceMesh(SourceGrid().mesh(), "grid").Mirrored({SourceGrid().at(3, 15)}, "x"),
            std::vector<int>{SourceGrid().at(-3, 15)});
  geometry::PolygonMesh bent = SourceGrid().mesh();
  bent.vertices(SourceGrid().at(3, 15), 2) += 1;
  const SourceMesh mesh(bent, "bent");
  EXPECT_FALSE(mesh.mirror().has_value());
  ExpectError([&] { mesh.Mirrored({0}, "cut eye"); },
              "annotation of bent, cut eye: the mesh is not its own mirror image");
}

TEST(SourceMesh, MessagesNameSourceAndEntry) {
  geometry::PolygonMesh lonely = SourceGrid().mesh();
  lonely.vertices.conservativeResize(lonely.vertices.rows() + 1, 3);
  lonely.vertices.bottomRows<1>() << 0, 0, 50;
  const SourceMesh mesh(lonely, "grid");
  const int last = static_cast<int>(lonely.vertices.rows()) - 1;
  ExpectError([&] { mesh.CheckVertex(last + 1, "hair"); }, "annotation of grid, hair: vertex");
  ExpectError([&] { mesh.Trace({0, last}, geometry::PathEnds::kOpen, "way"); }, "annotation of grid, way");
  ExpectError([&] { mesh.Flood(last, {}, "crop"); }, "is a corner of no polygon");
}

}  // namespace
}  // namespace daumier::faces
