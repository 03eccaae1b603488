#pragma once
#include "faces/face_model.h"
#include "geometry/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

/// What holds for the template of every source.
namespace daumier::testing {

/// One component, no non-manifold edge, the holes mouth, two eyes and neck; with closing_triangles only the neck is
/// left.
inline void ExpectSoundTopology(const faces::FaceTemplate& face) {
  const int n = face.num_vertices();
  EXPECT_NO_THROW(geometry::CheckManifold(face.triangles, n));
  EXPECT_EQ(geometry::BoundaryLoops(face.triangles, n).size(), 4u);
  EXPECT_EQ(geometry::EulerCharacteristic(face.triangles), -2);
  const auto components = geometry::ConnectedComponents(geometry::VertexNeighbours(face.triangles, n));
  EXPECT_EQ(*std::max_element(components.begin(), components.end()), 0);

  geometry::Triangles closed(face.triangles.rows() + face.closing_triangles.rows(), 3);
  closed << face.triangles, face.closing_triangles;
  EXPECT_NO_THROW(geometry::CheckManifold(closed, n));
  EXPECT_EQ(geometry::BoundaryLoops(closed, n).size(), 1u);
  geometry::Triangles eyes_closed(face.triangles.rows() + face.num_eye_closing_triangles, 3);
  eyes_closed << face.triangles, face.closing_triangles.topRows(face.num_eye_closing_triangles);
  EXPECT_EQ(geometry::BoundaryLoops(eyes_closed, n).size(), 2u);
}

/// UV of every corner, one-to-one up to a few corners: triangles keep their orientation in the picture, and seldom does
/// an edge have different UV on its two sides (a seam).
inline void ExpectUvUnfoldsTheFace(const faces::FaceTemplate& face) {
  ASSERT_EQ(face.uv_triangles.rows(), face.triangles.rows());
  std::map<std::pair<int, int>, std::pair<int, int>> uv_of_edge;
  int num_turned = 0, num_seams = 0;
  for (Eigen::Index t = 0; t < face.triangles.rows(); ++t) {
    const auto corner = [&](int k) { return Eigen::Vector2d(face.uv.row(face.uv_triangles(t, k))); };
    const Eigen::Vector2d a = corner(1) - corner(0), b = corner(2) - corner(0);
    num_turned += a.x() * b.y() - a.y() * b.x() <= 0;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      uv_of_edge[{face.triangles(t, k), face.triangles(t, next)}] = {face.uv_triangles(t, k),
                                                                     face.uv_triangles(t, next)};
    }
  }
  for (const auto& [edge, uv] : uv_of_edge) {
    const auto other = uv_of_edge.find({edge.second, edge.first});
    num_seams += other != uv_of_edge.end() && other->second != std::pair(uv.second, uv.first);
  }
  EXPECT_LE(num_turned, 0.01 * double(face.triangles.rows()));
  EXPECT_LE(num_seams, 0.05 * double(uv_of_edge.size()));
}

inline void ExpectCurvesAreEdgePaths(const faces::FaceTemplate& face) {
  const auto neighbours = geometry::VertexNeighbours(face.triangles, face.num_vertices());
  for (const faces::FeatureCurve& curve : face.annotation.curves) {
    ASSERT_GE(curve.vertices.size(), 2u) << curve.name;
    for (size_t i = 0; i + (curve.closed ? 0 : 1) < curve.vertices.size(); ++i) {
      const auto around = neighbours[curve.vertices[i]];
      EXPECT_TRUE(std::binary_search(around.begin(), around.end(), curve.vertices[(i + 1) % curve.vertices.size()]))
          << curve.name;
    }
  }
}

/// Left is +x, the order of parts from chin to brow is a face's, and right and left landmarks mirror each other.
inline void ExpectLandmarksOfAFace(const faces::FaceTemplate& face) {
  const faces::Annotation& annotation = face.annotation;
  const auto at = [&](int landmark) -> geometry::Vector3 {
    return face.neutral.row(annotation.landmarks[landmark]).transpose();
  };
  static constexpr int kPairs[][2] = {{0, 16},  {1, 15},  {2, 14},  {3, 13},  {4, 12},  {5, 11},  {6, 10},  {7, 9},
                                      {8, 8},   {17, 26}, {18, 25}, {19, 24}, {20, 23}, {21, 22}, {27, 27}, {28, 28},
                                      {29, 29}, {30, 30}, {31, 35}, {32, 34}, {33, 33}, {36, 45}, {37, 44}, {38, 43},
                                      {39, 42}, {40, 47}, {41, 46}, {48, 54}, {49, 53}, {50, 52}, {51, 51}, {59, 55},
                                      {58, 56}, {57, 57}, {60, 64}, {61, 63}, {62, 62}, {67, 65}, {66, 66}};
  // ICT's own jaw landmarks of left and right are not each other's mirror image to the vertex.
  for (const auto& [right, left] : kPairs) {
    const geometry::Vector3 image = at(right).cwiseProduct(geometry::Vector3(-1, 1, 1));
    EXPECT_LT((image - at(left)).norm(), right < 8 ? 1.0 : 0.05) << right << " " << left;
    EXPECT_GE(at(left).x(), -1e-3) << left;
  }
  for (int i = 0; i < 68; ++i) EXPECT_GE(at(i).y(), at(8).y() - 1e-9) << i << " lies below the chin";
  for (int i = 17; i < 27; ++i) EXPECT_GT(at(i).y(), at(37).y()) << "brow " << i;
  EXPECT_GT(at(37).y(), at(41).y());
  EXPECT_GT(at(41).y(), at(30).y());
  EXPECT_GT(at(30).y(), at(33).y());
  EXPECT_GT(at(33).y(), at(51).y());
  EXPECT_GT(at(51).y(), at(57).y());
  EXPECT_GT(at(57).y(), at(8).y());
  EXPECT_GT(at(30).z(), at(0).z() + 5) << "the nose points to +z";
  EXPECT_GT(face.neutral(annotation.hairline_vertex, 1), at(19).y());
  EXPECT_EQ(annotation.mirror[annotation.hairline_vertex], annotation.hairline_vertex);
}

inline void ExpectSoundAnnotation(const faces::FaceTemplate& face) {
  const faces::Annotation& annotation = face.annotation;
  for (int v = 0; v < face.num_vertices(); ++v) {
    ASSERT_EQ(annotation.mirror[annotation.mirror[v]], v);
    const geometry::Vector3 image = face.neutral.row(v).transpose().cwiseProduct(geometry::Vector3(-1, 1, 1));
    ASSERT_LT((face.neutral.row(annotation.mirror[v]).transpose() - image).norm(), 0.05);
  }
  for (const char* name : {"face", "eyes", "mouth", "neck_border", "ears", "nose"}) {
    const auto& region = annotation.regions.at(name);
    EXPECT_FALSE(region.empty()) << name;
    EXPECT_TRUE(std::is_sorted(region.begin(), region.end())) << name;
  }
  for (const auto& [a, b] : {std::pair("eyes", "mouth"),
                             {"eyes", "neck_border"},
                             {"mouth", "neck_border"},
                             {"eyes", "nose"},
                             {"mouth", "nose"},
                             {"ears", "nose"},
                             {"ears", "eyes"},
                             {"ears", "mouth"}}) {
    std::vector<int> common;
    std::set_intersection(annotation.regions.at(a).begin(), annotation.regions.at(a).end(),
                          annotation.regions.at(b).begin(), annotation.regions.at(b).end(), std::back_inserter(common));
    EXPECT_TRUE(common.empty()) << a << " and " << b << " share " << common.size() << " vertices";
  }
  for (const faces::FeatureCurve& curve : annotation.curves) {
    const size_t at = curve.name.find("left");
    if (at == std::string::npos) continue;
    const std::string name = std::string(curve.name).replace(at, 4, "right");
    const auto other =
        std::find_if(annotation.curves.begin(), annotation.curves.end(), [&](const auto& c) { return c.name == name; });
    ASSERT_NE(other, annotation.curves.end()) << name;
    ASSERT_EQ(other->vertices.size(), curve.vertices.size());
    for (size_t i = 0; i < curve.vertices.size(); ++i)
      EXPECT_EQ(annotation.mirror[curve.vertices[i]], other->vertices[i]) << name;
  }
}

}  // namespace daumier::testing
