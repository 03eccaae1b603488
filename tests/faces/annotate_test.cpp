#include "faces/annotate.h"

#include "geometry/topology.h"
#include "tests/faces/template_checks.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::SyntheticGrid;

const SyntheticGrid& Grid() {
  static const SyntheticGrid grid;
  return grid;
}

std::vector<int> Row(int j) {
  std::vector<int> row;
  for (int i = 1 - SyntheticGrid::kHalf; i <= SyntheticGrid::kHalf; ++i) row.push_back(Grid().at(i, j));
  return row;
}

/// The border of the cells low_i..high_i, low_j..high_j, with every vertex listed.
std::vector<int> Border(int low_i, int high_i, int low_j, int high_j) {
  std::vector<int> border;
  for (int i = low_i; i < high_i; ++i) border.push_back(Grid().at(i, low_j));
  for (int j = low_j; j < high_j; ++j) border.push_back(Grid().at(high_i, j));
  for (int i = high_i; i > low_i; --i) border.push_back(Grid().at(i, high_j));
  for (int j = high_j; j > low_j; --j) border.push_back(Grid().at(low_i, j));
  return border;
}

/// The synthetic face with its lowest row of polygons cut away.
AnnotationFile File() {
  AnnotationFile file;
  file.landmarks = testing::SyntheticFace().annotation.landmarks;
  file.hairline = Grid().at(0, 21);
  file.crop_seed = Grid().at(0, 15);
  file.cuts = {{.name = "neck", .waypoints = Row(1), .mirror_of = {}}};
  const auto region = [](const std::string& name, std::vector<int> loop, int seed) {
    return RegionRule{.name = name, .loop = std::move(loop), .seed = seed, .mirror_of = {}, .range = {}};
  };
  file.regions = {region("face", Border(-11, 11, 2, 21), Grid().at(0, 15)),
                  region("nose", Border(-2, 2, 9, 11), Grid().at(0, 10)),
                  region("ear_left", Border(11, 14, 8, 16), Grid().at(12, 12))};
  file.regions.push_back({.name = "ear_right", .loop = {}, .seed = -1, .mirror_of = "ear_left", .range = {}});
  file.curves = {
      {.curve = {"brow_left", "brow", View::kFrontal, false, {Grid().at(3, 15), Grid().at(7, 15)}}, .mirror = true},
      {.curve = {"ring", "nose", View::kFrontal, true, Border(-2, 2, 8, 11)}, .mirror = false}};
  return file;
}

FaceTemplate Annotated(const AnnotationFile& file) {
  return Annotate(Grid().mesh(), file, "synthetic").face_template;
}

TEST(Annotate, UvFollowsItsCornersThroughCropAndTriangulation) {
  // UV of a corner encodes its polygon and its vertex.
  geometry::PolygonMesh mesh = Grid().mesh();
  for (int p = 0; p < mesh.num_polygons(); ++p)
    for (int c = mesh.offsets[p]; c < mesh.offsets[p + 1]; ++c) mesh.uv_corners.push_back(c);
  mesh.uv.resize(static_cast<int>(mesh.corners.size()), 2);
  for (int p = 0; p < mesh.num_polygons(); ++p)
    for (int c = mesh.offsets[p]; c < mesh.offsets[p + 1]; ++c) mesh.uv.row(c) << p, mesh.corners[c];
  const AnnotatedTemplate annotated = Annotate(mesh, File(), "synthetic");
  const FaceTemplate& face = annotated.face_template;
  EXPECT_EQ(face.triangles, Annotated(File()).triangles);
  ASSERT_EQ(face.uv_triangles.rows(), face.triangles.rows());
  EXPECT_LT(face.uv.rows(), mesh.uv.rows()) << "UV of cropped polygons is removed";
  for (Eigen::Index t = 0; t < face.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector2d uv = face.uv.row(face.uv_triangles(t, k));
      ASSERT_EQ(uv.y(), annotated.vertices.old_from_new[face.triangles(t, k)]);
      ASSERT_EQ(uv.x(), face.uv(face.uv_triangles(t, 0), 0)) << "the corners of a triangle are of one polygon";
    }
  }
}

TEST(Annotate, CropsRemapsAndCloses) {
  const AnnotatedTemplate annotated = Annotate(Grid().mesh(), File(), "synthetic");
  const FaceTemplate& face = annotated.face_template;
  testing::ExpectSoundTopology(face);
  EXPECT_EQ(face.num_vertices(), Grid().mesh().vertices.rows() - 2 * SyntheticGrid::kHalf);
  for (int v = 0; v < face.num_vertices(); ++v)
    EXPECT_EQ(face.neutral.row(v), Grid().mesh().vertices.row(annotated.vertices.old_from_new[v]));
  EXPECT_EQ(annotated.vertices.old_from_new[face.annotation.hairline_vertex], Grid().at(0, 21));
}

TEST(Annotate, RegionsAreWhatTheirLoopsEnclose) {
  const AnnotatedTemplate annotated = Annotate(Grid().mesh(), File(), "synthetic");
  const auto expected = [&](std::vector<int> block) { return geometry::SelectVertices(block, annotated.vertices); };
  const auto& regions = annotated.face_template.annotation.regions;
  EXPECT_EQ(regions.at("face"), expected(Grid().Block(0, 11, 2, 21)));
  EXPECT_EQ(regions.at("nose"), expected(Grid().Block(0, 2, 9, 11)));
  EXPECT_EQ(regions.at("ears"), expected(Grid().Block(11, 14, 8, 16)));
  EXPECT_EQ(regions.at("neck_border"), expected(Grid().Block(0, SyntheticGrid::kHalf, 1, 1)));
}

TEST(Annotate, CurvesAreTracedAndMirrored) {
  const AnnotatedTemplate annotated = Annotate(Grid().mesh(), File(), "synthetic");
  const Annotation& annotation = annotated.face_template.annotation;
  ASSERT_EQ(annotation.curves.size(), 3u);
  const FeatureCurve &left = annotation.curves[0], &right = annotation.curves[1];
  EXPECT_EQ(left.name, "brow_left");
  EXPECT_EQ(right.name, "brow_right");
  EXPECT_EQ(left.vertices.size(), 5u);
  for (size_t i = 0; i < left.vertices.size(); ++i) EXPECT_EQ(right.vertices[i], annotation.mirror[left.vertices[i]]);
  testing::ExpectCurvesAreEdgePaths(annotated.face_template);
}

TEST(Annotate, WhatDoesNotFitIsRefusedByName) {
  const auto refused = [](const std::function<void(AnnotationFile&)>& spoil, const std::string& part) {
    AnnotationFile file = File();
    spoil(file);
    ExpectError([&] { Annotated(file); }, part);
  };
  refused([](AnnotationFile& f) { f.landmarks[3] = Grid().at(0, 0); }, "landmark 3");
  refused([](AnnotationFile& f) { f.hairline = 99999; }, "hairline");
  refused([](AnnotationFile& f) { f.cuts[0].waypoints[0] = -1; }, "cut neck");
  refused([](AnnotationFile& f) { f.curves[0].curve.vertices.pop_back(); }, "curve brow_left");
  refused([](AnnotationFile& f) { f.curves[1].curve.name = "brow_right"; }, "brow_right");
  refused([](AnnotationFile& f) { f.regions.erase(f.regions.begin()); }, "region 'face' is missing");
  refused([](AnnotationFile& f) { f.regions[3].mirror_of = "tail"; }, "tail");
  refused([](AnnotationFile& f) { f.regions[0].range = {0, 2147483647}; }, "region face: vertex 2147483647");
  refused(
      [](AnnotationFile& f) {
        f.cuts.push_back({.name = "hole", .waypoints = Border(-1, 1, 17, 19), .mirror_of = {}});
      },
      "5 holes");
}

/// Landmarks and hairline of the whole synthetic face.
AnnotationFile LeastFile() {
  AnnotationFile file;
  file.landmarks = testing::SyntheticFace().annotation.landmarks;
  file.hairline = Grid().at(0, 21);
  return file;
}

FaceTemplate LeastAnnotated(const geometry::PolygonMesh& mesh, const AnnotationFile& file) {
  return Annotate(mesh, file, "foreign", Completeness::kLandmarks).face_template;
}

TEST(Annotate, LandmarksAreEnoughForAForeignTopology) {
  const FaceTemplate face = LeastAnnotated(Grid().mesh(), LeastFile());
  testing::ExpectSoundTopology(face);
  EXPECT_EQ(face.num_vertices(), Grid().mesh().vertices.rows());
  EXPECT_EQ(face.annotation.mirror, Grid().Mirror());
  const auto& regions = face.annotation.regions;
  EXPECT_EQ(static_cast<int>(regions.at("face").size()), face.num_vertices());
  EXPECT_EQ(regions.at("neck_border"), Grid().Block(0, SyntheticGrid::kHalf, 0, 0));
  EXPECT_EQ(regions.count("eyes") + regions.count("mouth"), 2u);
  EXPECT_EQ(regions.count("nose") + regions.count("ears"), 0u);
  ExpectError([&] { Annotate(Grid().mesh(), LeastFile(), "strict"); }, "region 'face' is missing");
}

TEST(Annotate, SpecifiedRegionsReplaceMissingHoles) {
  const FaceTemplate open = testing::SyntheticFace();
  geometry::PolygonMesh closed{open.neutral, {0}, {}};
  const auto add = [&](const geometry::Triangles& triangles) {
    for (const auto& t : triangles.rowwise()) {
      closed.corners.insert(closed.corners.end(), {t[0], t[1], t[2]});
      closed.offsets.push_back(static_cast<int>(closed.corners.size()));
    }
  };
  add(open.triangles);
  add(open.closing_triangles);
  AnnotationFile file = LeastFile();
  EXPECT_EQ(LeastAnnotated(closed, file).annotation.regions.count("mouth"), 0u);
  file.regions = {{.name = "mouth", .loop = {}, .seed = -1, .mirror_of = {}, .range = {}, .vertices = {9, 4, 9}}};
  EXPECT_EQ(LeastAnnotated(closed, file).annotation.regions.at("mouth"), (std::vector<int>{4, 9}));
}

TEST(Annotate, AsymmetricMeshesHaveNoMirrorAndMirrorNothing) {
  geometry::PolygonMesh bent = Grid().mesh();
  bent.vertices(Grid().at(5, 18), 2) += 0.5;
  AnnotationFile file = LeastFile();
  EXPECT_TRUE(LeastAnnotated(bent, file).annotation.mirror.empty());
  ExpectError([&] { Annotate(bent, File(), "strict"); }, "the mesh is not its own mirror image");
  file.curves = {File().curves[0]};
  ExpectError([&] { LeastAnnotated(bent, file); }, "curve brow_left: the mesh is not its own mirror image");
}

TEST(Annotate, WrongUnitsAxesAndSidesAreFound) {
  geometry::PolygonMesh mesh = Grid().mesh();
  mesh.vertices *= 10;
  ExpectError([&] { LeastAnnotated(mesh, LeastFile()); }, "'cm_per_unit'");
  mesh = Grid().mesh();
  mesh.vertices.col(1) *= -1;
  ExpectError([&] { LeastAnnotated(mesh, LeastFile()); }, "has to be upright");
  mesh = Grid().mesh();
  mesh.vertices.col(2) *= -1;
  ExpectError([&] { LeastAnnotated(mesh, LeastFile()); }, "look to +z");
  AnnotationFile swapped = LeastFile();
  std::swap(swapped.landmarks[0], swapped.landmarks[16]);
  ExpectError([&] { LeastAnnotated(Grid().mesh(), swapped); }, "its own left at +x");
}

}  // namespace
}  // namespace daumier::faces
