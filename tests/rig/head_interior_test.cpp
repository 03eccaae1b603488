#include "rig/head_interior.h"

#include "faces/face_model_file.h"
#include "geometry/topology.h"
#include "tests/rig/named_model.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace daumier::rig {
namespace {

/// How far a point is in front of all skin at its x and y, cm: negative behind it.
double InFront(const geometry::Vector3& point, const geometry::Points& face, const geometry::Triangles& triangles) {
  double front = -std::numeric_limits<double>::infinity();
  for (const auto& t : triangles.rowwise()) {
    const geometry::Vector3 a = face.row(t[0]), b = face.row(t[1]), c = face.row(t[2]);
    const auto cross = [](const geometry::Vector3& u, const geometry::Vector3& v) {
      return u.x() * v.y() - u.y() * v.x();
    };
    const double area = cross(b - a, c - a);
    if (area == 0) continue;
    const double of_b = cross(point - a, c - a) / area, of_c = cross(b - a, point - a) / area;
    if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
    front = std::max(front, a.z() + of_b * (b.z() - a.z()) + of_c * (c.z() - a.z()));
  }
  return point.z() - front;
}

/// Triangles about the mouth, and those that close it.
geometry::Triangles ClosedMouth(const faces::FaceTemplate& face) {
  const Eigen::RowVector3d mouth = face.neutral.row(face.annotation.landmarks[62]);
  const double width =
      (face.neutral.row(face.annotation.landmarks[60]) - face.neutral.row(face.annotation.landmarks[64])).norm();
  std::vector<int> near;
  for (Eigen::Index t = 0; t < face.triangles.rows(); ++t)
    if ((face.neutral.row(face.triangles(t, 0)) - mouth).norm() < 1.5 * width) near.push_back(int(t));
  const Eigen::Index num_closing = face.closing_triangles.rows() - face.num_eye_closing_triangles;
  geometry::Triangles triangles(Eigen::Index(near.size()) + num_closing, 3);
  triangles << face.triangles(near, Eigen::all), face.closing_triangles.bottomRows(num_closing);
  return triangles;
}

void ExpectHiddenAtRest(const faces::FaceModel& model, int num_faces, double spread) {
  const HeadInterior interior(model.face_template);
  const geometry::Triangles closed = ClosedMouth(model.face_template);
  for (int i = 0; i < num_faces; ++i) {
    Rng rng = Stream(5, "interior", i);
    const geometry::Points face = faces::IdentityFace(model, faces::DrawIdentity(model, rng, spread));
    const geometry::Points vertices = interior.Vertices(face);
    for (const auto& p : vertices.rowwise())
      EXPECT_LT(InFront(p.transpose(), face, closed), 0) << "face " << i << " at " << p;
  }
}

TEST(HeadInterior, IsClosedAndSmall) {
  EXPECT_LE(HeadInterior::NumVertices(), 1000);
  Eigen::Index num_triangles = 0;
  for (const ChartPiece& piece : HeadInterior::Charts(7)) {
    EXPECT_GE(piece.triangles.minCoeff(), 7);
    EXPECT_LT(piece.triangles.maxCoeff(), 7 + HeadInterior::NumVertices());
    EXPECT_NO_THROW(geometry::CheckManifold(piece.triangles, 7 + HeadInterior::NumVertices()));
    EXPECT_TRUE(geometry::BoundaryLoops(piece.triangles, 7 + HeadInterior::NumVertices()).empty());
    num_triangles += piece.triangles.rows();
  }
  EXPECT_EQ(size_t(num_triangles), HeadInterior::Materials().size());
}

TEST(HeadInterior, IsBehindTheSkinAroundTheMouth) {
  const faces::FaceModel model = testing::SyntheticModel();
  const auto& landmarks = model.face_template.annotation.landmarks;
  const HeadInterior interior(model.face_template);
  for (int i = 0; i < 10; ++i) {
    Rng rng = Stream(5, "interior", i);
    const geometry::Points face = faces::IdentityFace(model, faces::DrawIdentity(model, rng, 1.5));
    const Eigen::RowVector3d mouth = 0.5 * (face.row(landmarks[60]) + face.row(landmarks[64]));
    const double width = (face.row(landmarks[60]) - face.row(landmarks[64])).norm();
    const geometry::Points vertices = interior.Vertices(face);
    for (const auto& skin : face.rowwise()) {
      if ((skin - mouth).norm() > 0.8 * width) continue;
      for (const auto& p : vertices.rowwise())
        if ((p - skin).head<2>().norm() < 0.02 * width) EXPECT_LT(p.z(), skin.z());
    }
  }
}

TEST(HeadInterior, IsBehindClosedLipsOfScannedFaces) {
  const auto folder = testing::SourceRoot() / "weights/face-ict";
  ExpectHiddenAtRest(faces::ReadFaceModel(folder), 4, 2.5);
}

TEST(HeadInterior, LowerTeethOfAnOpenMouthAreAsMuchLower) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const HeadInterior interior(face);
  const auto& landmarks = face.annotation.landmarks;
  const double width = (face.neutral.row(landmarks[60]) - face.neutral.row(landmarks[64])).norm();
  geometry::Points open = face.neutral;
  const double lips = face.neutral(landmarks[66], 1);
  for (Eigen::Index v = 0; v < open.rows(); ++v)
    if (open(v, 1) <= lips + 1e-9 && std::abs(open(v, 0)) < 0.4 * width) open(v, 1) -= 0.5 * width;
  const geometry::Points moves = interior.Vertices(open) - interior.Vertices(face.neutral);
  const Eigen::Index num_upper = HeadInterior::Charts(0)[0].triangles.maxCoeff() + 1;
  const double lowered = -Eigen::VectorXd(moves.bottomRows(moves.rows() - num_upper).col(1)).mean();
  EXPECT_NEAR(Eigen::VectorXd(moves.topRows(num_upper).col(1)).cwiseAbs().maxCoeff(), 0, 1e-9);
  EXPECT_GT(lowered, 0.35 * width);
  EXPECT_LE(lowered, 0.5 * width + 1e-9);
}

TEST(HeadInterior, MovesAndGrowsWithTheFace) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const HeadInterior interior(face);
  const Eigen::RowVector3d shift(1, -2, 3);
  const geometry::Points moved = (1.5 * face.neutral).rowwise() + shift;
  EXPECT_LT((interior.Vertices(moved) - ((1.5 * interior.Vertices(face.neutral)).rowwise() + shift)).norm(), 1e-9);
}

/// Columns: the face turned about x as a jaw is, the same under a name that no jaw has, nothing.
MorphTargets TurnedTargets(const geometry::Points& face, const Eigen::Isometry3d& turn) {
  MorphTargets targets{{"jawOpen", "mouthPucker", "tongueOut"}, Eigen::MatrixXf::Zero(3 * face.rows(), 3)};
  for (Eigen::Index v = 0; v < face.rows(); ++v) {
    const Eigen::Vector3d p = face.row(v);
    targets.offsets.col(0).segment<3>(3 * v) = (turn * p - p).cast<float>();
  }
  targets.offsets.col(1) = targets.offsets.col(0);
  return targets;
}

TEST(HeadInterior, LowerTeethAndTongueFollowTheJawAsARigidBody) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const HeadInterior interior(face);
  Eigen::Isometry3d turn = Eigen::Translation3d(0, 2, 1) *
                           Eigen::AngleAxisd(20 * std::numbers::pi / 180, Eigen::Vector3d::UnitX()) *
                           Eigen::Translation3d(0, -2, -1);
  const MorphTargets targets = TurnedTargets(face.neutral, turn);
  const Eigen::MatrixXf offsets = interior.Offsets(face.neutral, targets);
  const geometry::Points vertices = interior.Vertices(face.neutral);
  const Eigen::Index num_upper = HeadInterior::Charts(0)[0].triangles.maxCoeff() + 1;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::Vector3d p = vertices.row(v);
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    if (v >= num_upper) expected = turn * p - p;
    EXPECT_LT((offsets.col(0).segment<3>(3 * v).cast<double>() - expected).norm(), 1e-4);
  }
  EXPECT_TRUE(offsets.col(1).isZero(0)) << "no motion of the jaw";
}

TEST(HeadInterior, LowerTeethStayBehindALipThatComesBack) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const HeadInterior interior(face);
  MorphTargets targets = TurnedTargets(face.neutral, Eigen::Isometry3d::Identity());
  for (Eigen::Index v = 0; v < face.neutral.rows(); ++v) targets.offsets.col(0)[3 * v + 1] = -0.5f;
  const Eigen::MatrixXf straight = interior.Offsets(face.neutral, targets);
  const auto& landmarks = face.annotation.landmarks;
  const double width = (face.neutral.row(landmarks[60]) - face.neutral.row(landmarks[64])).norm();
  const Eigen::RowVector3d lip = face.neutral.row(landmarks[57]);
  for (Eigen::Index v = 0; v < face.neutral.rows(); ++v)
    if (face.neutral(v, 1) <= lip.y() && (face.neutral.row(v) - lip).norm() < 0.25 * width)
      targets.offsets.col(0)[3 * v + 2] = float(-0.4 * width);
  const Eigen::MatrixXf back = interior.Offsets(face.neutral, targets);
  const Eigen::Index last = back.rows() / 3 - 1;
  EXPECT_LT(back(3 * last + 2, 0), straight(3 * last + 2, 0) - 0.05 * width);
  EXPECT_EQ(back(2, 0), 0) << "the upper teeth";
}

TEST(HeadInterior, OnlyTheTongueComesOut) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const HeadInterior interior(face);
  const Eigen::MatrixXf offsets =
      interior.Offsets(face.neutral, TurnedTargets(face.neutral, Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(offsets.col(0).isZero(0)) << "a target that moves nothing";
  const Eigen::Index first = HeadInterior::Charts(0)[2].triangles.minCoeff();
  EXPECT_TRUE(offsets.col(2).head(3 * first).isZero(0));
  const geometry::Points vertices = interior.Vertices(face.neutral);
  double foremost = 0, lips = 0;
  for (Eigen::Index v = first; v < vertices.rows(); ++v)
    foremost = std::max(foremost, vertices(v, 2) + double(offsets(3 * v + 2, 2)));
  for (const int landmark : {57, 66})
    lips = std::max(lips, face.neutral(face.annotation.landmarks[size_t(landmark)], 2));
  EXPECT_GT(foremost, lips + 0.3);
}

TEST(HeadInterior, ATongueThatIsOutFollowsTheJawOfItsTarget) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const HeadInterior interior(face);
  MorphTargets targets = TurnedTargets(face.neutral, Eigen::Isometry3d::Identity());
  const Eigen::MatrixXf still = interior.Offsets(face.neutral, targets);
  for (Eigen::Index v = 0; v < face.neutral.rows(); ++v) targets.offsets.col(2)[3 * v + 1] = -0.5f;
  const Eigen::MatrixXf open = interior.Offsets(face.neutral, targets);
  const Eigen::Index num_upper = HeadInterior::Charts(0)[0].triangles.maxCoeff() + 1;
  for (Eigen::Index v = 0; v < open.rows() / 3; ++v)
    EXPECT_NEAR(open(3 * v + 1, 2) - still(3 * v + 1, 2), v < num_upper ? 0 : -0.5, 1e-4);
}

}  // namespace
}  // namespace daumier::rig
