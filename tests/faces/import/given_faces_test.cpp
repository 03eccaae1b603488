#include "faces/import/given_faces.h"

#include "core/files.h"
#include "tests/faces/import/foreign_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::ForeignMesh;

/// Two persons, the second 10 % taller, in decimetres; the second expression lifts all by one unit.
GivenFiles Files() {
  GivenFiles files;
  files.source = "test";
  files.mesh = ForeignMesh();
  files.names = {"a", "b"};
  files.groups = {"x", "x"};
  files.expressions = {"neutral", "lifted"};
  files.cm_per_unit = 10;
  files.provenance = {{"name", "test"}, {"version", "1"}, {"checksum", ""}, {"licence", "mine"}};
  files.face = [](int identity, int expression) -> geometry::Points {
    geometry::Points points = ForeignMesh(10 * identity, 10).vertices;
    points.col(1).array() += expression;
    return points;
  };
  return files;
}

TEST(GivenFaces, TemplateIsTheMeanInCentimetres) {
  const GivenFaces given = ImportGivenFaces(Files(), testing::ForeignAnnotation());
  EXPECT_LT((given.face_template.neutral - ForeignMesh(5).vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((given.face(1, 0) - ForeignMesh(10).vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(((given.face(0, 1) - given.face(0, 0)).col(1).array() - 10).abs().maxCoeff(), 1e-9);
}

TEST(GivenFaces, AnnotationSetsTheUnitAndTheCrop) {
  AnnotationFile file = testing::ForeignAnnotation(false);
  file.cm_per_unit = 20;
  const auto& grid = testing::ForeignGrid();
  WaypointLoop neck{.name = "neck", .waypoints = {}, .mirror_of = {}};
  for (int i = 1 - testing::SyntheticGrid::kHalf; i <= testing::SyntheticGrid::kHalf; ++i)
    neck.waypoints.push_back(grid.at(i, 1));
  file.cuts = {neck};
  file.crop_seed = grid.at(0, 15);
  const GivenFaces given = ImportGivenFaces(Files(), file);
  const int num_cut = 2 * testing::SyntheticGrid::kHalf;
  EXPECT_EQ(given.face_template.num_vertices(), grid.mesh().vertices.rows() - num_cut);
  EXPECT_LT((given.face(0, 0) - 2 * ForeignMesh().vertices.bottomRows(given.face_template.num_vertices()))
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
}

TEST(GivenFaces, TemplateHasTheUvOfTheMesh) {
  GivenFiles files = Files();
  EXPECT_FALSE(ImportGivenFaces(files, testing::ForeignAnnotation()).face_template.has_uv());
  files.mesh.uv = geometry::TextureCoordinates::Random(files.mesh.vertices.rows(), 2);
  files.mesh.uv_corners = files.mesh.corners;
  const FaceTemplate face = ImportGivenFaces(files, testing::ForeignAnnotation()).face_template;
  EXPECT_EQ(face.uv, files.mesh.uv);
  EXPECT_EQ(face.uv_triangles, face.triangles);
}

TEST(GivenFaces, ChecksumNamesTheNeutralFaces) {
  GivenFiles files = Files();
  const Json one = ImportGivenFaces(files, testing::ForeignAnnotation()).face_template.provenance;
  EXPECT_EQ(one.at("checksum").get<std::string>().size(), 64u);
  EXPECT_EQ(one.at("licence"), "mine");
  EXPECT_EQ(one, ImportGivenFaces(files, testing::ForeignAnnotation()).face_template.provenance);
  files.face = [](int identity, int) { return ForeignMesh(11 * identity, 10).vertices; };
  EXPECT_NE(one, ImportGivenFaces(files, testing::ForeignAnnotation()).face_template.provenance);
}

TEST(GivenFaces, NoFaceIsRefused) {
  GivenFiles files = Files();
  files.names.clear();
  ExpectError([&] { ImportGivenFaces(files, testing::ForeignAnnotation()); }, "there is no face");
}

TEST(SameTopology, IgnoresWithWhichCornerAPolygonBegins) {
  const geometry::PolygonMesh mesh = ForeignMesh();
  geometry::PolygonMesh other = mesh;
  std::rotate(other.corners.begin(), other.corners.begin() + 1, other.corners.begin() + other.offsets[1]);
  CheckSameTopology(other, mesh, "other.obj");
  std::swap(other.corners[0], other.corners[1]);
  ExpectError([&] { CheckSameTopology(other, mesh, "other.obj"); }, "other.obj: polygon 0");
  other = mesh;
  other.corners.resize(other.offsets[other.num_polygons() - 1]);
  other.offsets.pop_back();
  ExpectError([&] { CheckSameTopology(other, mesh, "other.obj"); }, "share one topology");
}

}  // namespace
}  // namespace daumier::faces
