#include "fitting/fine_alignment.h"

#include "faces/openings.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <cmath>

namespace daumier::fitting {
namespace {

using testing::ExpectError;

PortraitPose AlignedPose(double yaw) {
  PortraitPose pose;
  pose << 0.05, yaw, 0.1, 0.4, -0.6, -35;
  return pose;
}

/// A posed face and where its anchors are in the picture.
struct AlignmentProblem {
  faces::FaceTemplate face = testing::SyntheticFace();
  FineAlignment alignment;
  PortraitPose pose;
  PicturePoints landmarks{68, 2};

  explicit AlignmentProblem(const FineAlignmentOptions& options = {}, double yaw = 0.1)
      : alignment(face, options), pose(AlignedPose(yaw)) {
    const std::array<int, 68> anchors = alignment.Anchors(face.neutral, pose);
    landmarks = Projected(Posed(face.neutral(std::vector<int>(anchors.begin(), anchors.end()), Eigen::all), pose));
  }
  AlignedFace Align(const Eigen::VectorXd& confidences = {}) const {
    return alignment.Align(face.neutral, pose, landmarks, confidences);
  }
};

double LargestMove(const geometry::Points& a, const geometry::Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

TEST(FineAlignment, LandmarksInPlaceLeaveTheFace) {
  for (const char* laplacian : {"uniform", "cotangent"}) {
    for (const char* contour : {"slide", "fixed"}) {
      const AlignmentProblem problem({.laplacian = laplacian, .contour = contour});
      const AlignedFace aligned = problem.Align();
      EXPECT_LT(LargestMove(aligned.vertices, problem.face.neutral), 1e-6);
      EXPECT_LT(aligned.rms_before_px, 1e-9);
    }
  }
}

TEST(FineAlignment, SolvesEquation10WithTheDepthOfEquation11) {
  AlignmentProblem problem({.contour = "fixed", .eyes = 0.5, .brows = 2, .hidden = 1, .keep_order = false});
  for (int k = 36; k < 48; ++k) problem.landmarks.row(k) += Eigen::RowVector2d(1.5, k < 42 ? -2 : 1);
  const AlignedFace aligned = problem.Align();

  const int num_vertices = problem.face.num_vertices();
  const Eigen::MatrixXd s = geometry::UniformLaplacian(problem.face.triangles, num_vertices);
  const Eigen::MatrixXd l = s.diagonal().cwiseInverse().asDiagonal() * s;
  Eigen::MatrixXd system = l.transpose() * l, rhs = system * problem.face.neutral;
  const geometry::Points posed = Posed(problem.face.neutral, problem.pose);
  const Eigen::Matrix3d rotation = RotationOf(problem.pose);
  for (int k = 0; k < 68; ++k) {
    const int vertex = problem.face.annotation.landmarks[size_t(k)];
    const double depth = 100 - posed(vertex, 2), weight = k < 17 ? 1 : k < 27 ? 2 : k < 36 ? 1 : k < 48 ? 0.5 : 1;
    const Eigen::Vector3d seen((problem.landmarks(k, 0) - 112) * depth / 1015,
                               (112 - problem.landmarks(k, 1)) * depth / 1015, posed(vertex, 2));
    const Eigen::Vector3d target = rotation.transpose() * (seen - problem.pose.tail<3>());
    system(vertex, vertex) += weight;
    rhs.row(vertex) += weight * target.transpose();
  }
  const geometry::Points expected = system.ldlt().solve(rhs);
  EXPECT_LT(LargestMove(aligned.vertices, expected), 1e-7);
  EXPECT_GT(LargestMove(aligned.vertices, problem.face.neutral), 0.1);
}

TEST(FineAlignment, BringsAnchorsToLandmarksAtTheirDepth) {
  for (const char* laplacian : {"uniform", "cotangent"}) {
    AlignmentProblem problem(
        {.laplacian = laplacian, .eyes = 100, .brows = 100, .nose = 100, .mouth = 100, .jaw = 100});
    for (int k = 36; k < 48; ++k) problem.landmarks.row(k) *= 1.02;
    const AlignedFace aligned = problem.Align();
    EXPECT_GT(aligned.rms_before_px, 1);
    EXPECT_LT(aligned.rms_px, 0.05);
    EXPECT_LT((Posed(aligned.vertices, problem.pose) - Posed(problem.face.neutral, problem.pose))
                  .col(2)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-3);
  }
}

TEST(FineAlignment, HiddenAndDoubtfulLandmarksWeighLess) {
  const AlignmentProblem problem({.hidden = 0.05}, 1.2);
  Eigen::VectorXd confidences = Eigen::VectorXd::Ones(68);
  confidences[30] = 0.5;
  const Eigen::VectorXd weights = problem.Align(confidences).weights;
  // A head that looks to the picture's right shows its own right half.
  EXPECT_NEAR(weights[36], 1, 1e-9);
  EXPECT_LT(weights[45], 0.3);
  EXPECT_NEAR(weights[30], 0.5, 0.2);
  EXPECT_NEAR(weights[16], 1, 1e-9);  // The silhouette is seen.
}

TEST(FineAlignment, IgnoresLandmarksOfConfidenceZero) {
  AlignmentProblem problem;
  Eigen::VectorXd confidences = Eigen::VectorXd::Ones(68);
  for (const int k : {3, 20, 40, 66}) {
    confidences[k] = 0;
    problem.landmarks.row(k).setConstant(std::nan(""));
  }
  EXPECT_LT(LargestMove(problem.Align(confidences).vertices, problem.face.neutral), 1e-6);
}

TEST(FineAlignment, TheContourIsTheSilhouetteOfATurnedHead) {
  const AlignmentProblem problem({}, 0.9);
  const std::array<int, 68> anchors = problem.alignment.Anchors(problem.face.neutral, problem.pose);
  const PicturePoints pixels = Projected(Posed(problem.face.neutral, problem.pose));
  const auto& landmarks = problem.face.annotation.landmarks;
  int moved = 0;
  for (int k = 9; k < 16; ++k) {  // Turned away, at the right border of the face.
    EXPECT_GE(pixels(anchors[size_t(k)], 0), pixels(landmarks[size_t(k)], 0) - 1.5);
    moved += anchors[size_t(k)] != landmarks[size_t(k)];
  }
  EXPECT_GE(moved, 3);
  for (int k = 17; k < 68; ++k) EXPECT_EQ(anchors[size_t(k)], landmarks[size_t(k)]);
  EXPECT_EQ(anchors[8], landmarks[8]);
}

TEST(FineAlignment, JawLandmarksMaySlideAlongTheirLine) {
  AlignmentProblem sliding, fixed({.contour = "fixed"});
  for (AlignmentProblem* problem : {&sliding, &fixed}) {
    const PicturePoints before = problem->landmarks;
    for (int k = 1; k < 8; ++k) problem->landmarks.row(k) = 0.7 * before.row(k) + 0.3 * before.row(k + 1);
  }
  const double by_sliding = LargestMove(sliding.Align().vertices, sliding.face.neutral),
               by_fixed = LargestMove(fixed.Align().vertices, fixed.face.neutral);
  EXPECT_LT(by_sliding, 0.4 * by_fixed);
}

TEST(FineAlignment, LidsAndLipsKeepTheirOrder) {
  AlignmentProblem problem({.eyes = 100, .mouth = 100}, 0);
  for (const auto& [upper, lower] : {std::pair{37, 41}, {38, 40}, {43, 47}, {44, 46}, {61, 67}, {62, 66}, {63, 65}}) {
    const Eigen::RowVector2d middle = (problem.landmarks.row(upper) + problem.landmarks.row(lower)) / 2;
    problem.landmarks.row(upper) = middle + Eigen::RowVector2d(0, 4);  // y down: below the lower one.
    problem.landmarks.row(lower) = middle - Eigen::RowVector2d(0, 4);
  }
  const faces::FaceOpenings openings = faces::FindOpenings(problem.face);
  constexpr double kTouchingCm = 0.02;
  const geometry::Points kept = problem.Align().vertices;
  for (const faces::Opening& opening : {openings.lips, openings.lids[0], openings.lids[1]})
    EXPECT_LT(faces::CrossingDepth(opening, kept), kTouchingCm);
  AlignmentProblem loose({.eyes = 100, .mouth = 100, .keep_order = false}, 0);
  loose.landmarks = problem.landmarks;
  EXPECT_GT(faces::CrossingDepth(openings.lids[0], loose.Align().vertices), 10 * kTouchingCm);
}

TEST(FineAlignment, SeveralThreadsGetTheSameFaces) {
  AlignmentProblem problem;
  problem.landmarks.row(30) += Eigen::RowVector2d(2, 1);
  testing::ExpectTheSameFromThreads(2, [&] { return problem.Align().vertices; });
}

TEST(FineAlignment, RefusesWhatIsNoSetOfLandmarks) {
  const AlignmentProblem problem;
  const auto align = [&](const geometry::Points& face, const PicturePoints& landmarks, const Eigen::VectorXd& c) {
    problem.alignment.Align(face, problem.pose, landmarks, c);
  };
  const geometry::Points& face = problem.face.neutral;
  ExpectError([&] { align(face, problem.landmarks.topRows(60), {}); }, "60 landmarks");
  ExpectError([&] { align(face, problem.landmarks, Eigen::VectorXd::Ones(3)); }, "3 confidences");
  ExpectError([&] { align(face.topRows(50), problem.landmarks, {}); }, "a face of 50 vertices");
  ExpectError([&] { align(face, problem.landmarks, -Eigen::VectorXd::Ones(68)); }, "landmark 0 has the confidence -1");
  ExpectError([&] { align(face, problem.landmarks, Eigen::VectorXd::Zero(68)); }, "no landmark has a weight");
}

}  // namespace
}  // namespace daumier::fitting
