#include "geometry/registration.h"

#include "geometry/registration_quality.h"
#include "geometry/surface_matcher.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <limits>
#include <numeric>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

/// A head-like closed surface without symmetry, of some 1,000 vertices, and one of 4,000 with other triangles.
Points Shape(Points points) {
  for (auto p : points.rowwise()) {
    const double nose = std::exp(-8 * (p - Eigen::RowVector3d(0, 0, 1)).squaredNorm());
    const double chin = std::exp(-6 * (p - Eigen::RowVector3d(0, -0.8, 0.6)).squaredNorm());
    p = Eigen::RowVector3d(7 * p.x(), 10 * p.y(), 8 * p.z() + 2 * nose + chin + 0.3 * p.x());
  }
  return points;
}
TriangleMesh Head(int depth) {
  const TriangleMesh sphere = testing::Sphere(1, depth);
  return {Shape(sphere.vertices), sphere.triangles};
}
TriangleMesh OtherHead() {  // The same surface from another grid: a turned sphere, cut finer.
  const TriangleMesh sphere = testing::Sphere(1, 5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3(1, 2, 1).normalized()).toRotationMatrix();
  return {Shape(sphere.vertices * turn.transpose()), sphere.triangles};
}

/// A smooth warp in the manner of a caricature.
Points Warp(Points points) {
  for (auto p : points.rowwise()) {
    const double low = std::exp(-0.02 * (p - Eigen::RowVector3d(0, -9, 4)).squaredNorm());
    p += Eigen::RowVector3d(0.1 * p.y(), -3 * low, 0.02 * p.y() * p.y() + 0.5 * std::sin(0.3 * p.x()));
  }
  return points;
}

RegistrationTemplate Source() {
  RegistrationTemplate source{Head(4), {}, {}};
  for (int v = 0; v < 66; ++v) source.landmarks.push_back(v);  // The coarse grid inside the fine one.
  source.landmark_weights = Eigen::VectorXd::Ones(66);
  return source;
}

Points LandmarksOf(const RegistrationTemplate& source) {
  return source.mesh.vertices(source.landmarks, Eigen::all);
}

TEST(Registration, ATargetEqualToTheTemplateGivesTheTemplate) {
  const NonRigidRegistration registration(Source(), {});
  const Registration result = registration.Register(registration.source().mesh, LandmarksOf(registration.source()));
  EXPECT_LT((result.vertices - registration.source().mesh.vertices).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((result.aligned - registration.source().mesh.vertices).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Registration, RecoversASmoothWarpFromAnotherTriangulation) {
  const NonRigidRegistration registration(Source(), {});
  const TriangleMesh& mesh = registration.source().mesh;
  TriangleMesh target = OtherHead();
  target.vertices = Warp(target.vertices);
  const Points truth = Warp(mesh.vertices), landmarks = truth(registration.source().landmarks, Eigen::all);
  const Registration result = registration.Register(target, landmarks);
  const Points expected = result.template_from_target.Apply(truth);
  const Eigen::VectorXd before = (mesh.vertices - expected).rowwise().norm(),
                        after = (result.vertices - expected).rowwise().norm();
  EXPECT_GT(before.mean(), 0.5);
  EXPECT_LT(after.mean(), 0.1);
  const SurfaceMatcher matcher({result.template_from_target.Apply(target.vertices), target.triangles});
  std::vector<int> all(mesh.vertices.rows());
  std::iota(all.begin(), all.end(), 0);
  const auto quality = MeasureRegistration(mesh, result.vertices, all, matcher, {});
  EXPECT_LT(quality.template_to_target.value().mean, 0.01);
  EXPECT_GT(quality.coverage, 0.99);
  EXPECT_EQ(quality.flipped_region, 0);
}

TEST(Registration, WhatTheTargetLacksFollowsSmoothly) {
  // The target is the front of the warped head, z > 2.
  const NonRigidRegistration registration(Source(), {});
  TriangleMesh target = OtherHead();
  Triangles front(0, 3);
  for (int f = 0; f < target.triangles.rows(); ++f) {
    double least = std::numeric_limits<double>::infinity();
    for (const int v : target.triangles.row(f)) least = std::min(least, target.vertices(v, 2));
    if (least < 2) continue;
    front.conservativeResize(front.rows() + 1, 3);
    front.bottomRows(1) = target.triangles.row(f);
  }
  target = {Warp(target.vertices), front};
  const Points truth = Warp(registration.source().mesh.vertices);
  const Registration result = registration.Register(target, truth(registration.source().landmarks, Eigen::all));
  const Points error = result.vertices - result.template_from_target.Apply(truth);
  EXPECT_LT(error.rowwise().norm().maxCoeff(), 2);
  EXPECT_LT(error.rowwise().norm().mean(), 0.3);
}

TEST(Registration, ASimilarityOfTheTargetChangesNothing) {
  RegistrationOptions options;
  options.num_rounds = 3;
  const NonRigidRegistration registration(Source(), options);
  TriangleMesh target = OtherHead();
  target.vertices = Warp(target.vertices);
  const Points landmarks = Warp(LandmarksOf(registration.source()));
  const Similarity moved{0.1, Eigen::AngleAxisd(1.2, Vector3(0, 1, 2).normalized()).toRotationMatrix(), {5, -3, 2}};
  const Registration here = registration.Register(target, landmarks);
  const Registration there =
      registration.Register({moved.Apply(target.vertices), target.triangles}, moved.Apply(landmarks));
  EXPECT_LT((here.vertices - there.vertices).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(there.template_from_target.scale, 10 * here.template_from_target.scale, 1e-8);
}

TEST(Registration, TheSameInputGivesTheSameBytes) {
  RegistrationOptions options;
  options.num_rounds = 2;
  const NonRigidRegistration registration(Source(), options);
  const Points landmarks = Warp(LandmarksOf(registration.source()));
  EXPECT_EQ(registration.Register(OtherHead(), landmarks).vertices,
            registration.Register(OtherHead(), landmarks).vertices);
}

TEST(Registration, RegistersFromSeveralThreads) {
  RegistrationOptions options;
  options.num_rounds = 1;
  const NonRigidRegistration registration(Source(), options);
  const TriangleMesh target = Head(3);
  const Points landmarks = Warp(LandmarksOf(registration.source()));
  testing::ExpectTheSameFromThreads(1, [&] { return registration.Register(target, landmarks).vertices; });
}

TEST(Registration, AnchorsHoldWhatNothingMatches) {
  RegistrationTemplate source = Source();
  const int back = 5;  // (0, 0, -8): far behind.
  const auto with_anchors = [&](std::vector<int> anchors) {
    source.anchors = std::move(anchors);
    const NonRigidRegistration registration(source, {});
    Points landmarks = LandmarksOf(source);
    landmarks.row(4) += Eigen::RowVector3d(0, 0, 30);
    TriangleMesh speck = testing::EquilateralTriangle();  // Nothing to match.
    speck.vertices.array() += 500;
    return (registration.Register(speck, landmarks).aligned.row(back) - source.mesh.vertices.row(back)).norm();
  };
  source.landmarks = {0, 1, 2, 3, 4};
  source.landmark_weights = Eigen::VectorXd::Ones(5);
  EXPECT_LT(with_anchors({back, 30, 50}), with_anchors({}));
}

TEST(Registration, RefusesBadInput) {
  const auto with = [](auto change) {
    RegistrationTemplate source = Source();
    change(source);
    NonRigidRegistration(source, {});
  };
  ExpectError([&] { with([](auto& source) { source.landmarks[3] = 5000; }); }, "a landmark 5000 is out of range");
  ExpectError([&] { with([](auto& source) { source.landmarks[3] = 4; }); }, "vertex 4 is a landmark twice");
  ExpectError([&] { with([](auto& source) { source.anchors = {7, 7}; }); }, "vertex 7 is an anchor twice");
  ExpectError([&] { with([](auto& source) { source.landmarks.resize(2); }); }, "2 landmarks; three or more");
  ExpectError([&] { with([](auto& source) { source.landmark_weights[9] = 0; }); }, "expected one each, above 0");

  const NonRigidRegistration registration(Source(), {});
  const TriangleMesh& mesh = registration.source().mesh;
  const Points landmarks = LandmarksOf(registration.source());
  ExpectError([&] { registration.Register(mesh, landmarks.topRows(65)); }, "65 landmarks on the target, expected 66");
  Points broken = landmarks;
  broken(2, 1) = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { registration.Register(mesh, broken); }, "a landmark on the target is not finite");
  TriangleMesh cracked = mesh;
  cracked.vertices(2, 1) = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { registration.Register(cracked, landmarks); }, "finite positions");
  ExpectError([&] { registration.Register({mesh.vertices, Triangles(0, 3)}, landmarks); }, "at least one triangle");
}

}  // namespace
}  // namespace daumier::geometry
