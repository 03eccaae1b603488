#include "fitting/stroke_deformation.h"

#include "fitting/curve_pull.h"
#include "fitting/stroke_distance.h"
#include "geometry/topology.h"
#include "tests/fitting/projected_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>

namespace daumier::fitting {
namespace {

/// A square of kSide x kSide vertices in the plane, 1 cm apart, and next to it a loose triangle that no curve passes.
/// One curve runs along the middle row. A pixel is a cm.
class StrokeDeformerTest : public ::testing::Test {
 protected:
  static constexpr int kSide = 7, kNumVertices = kSide * kSide + 3;

  StrokeDeformerTest() {
    triangles_.resize(2 * (kSide - 1) * (kSide - 1) + 1, 3);
    Eigen::Index next = 0;
    for (int y = 0; y + 1 < kSide; ++y) {
      for (int x = 0; x + 1 < kSide; ++x) {
        const int corner = y * kSide + x;
        triangles_.row(next++) << corner, corner + 1, corner + kSide;
        triangles_.row(next++) << corner + 1, corner + kSide + 1, corner + kSide;
      }
    }
    triangles_.row(next) << kSide * kSide, kSide * kSide + 1, kSide * kSide + 2;
    for (int vertex = 0; vertex < kNumVertices; ++vertex) {
      const auto x = float(vertex % kSide), y = float(vertex / kSide);
      face_.insert(face_.end(), {x, y, 0.1f * x * y});
    }
    for (int x = 0; x < kSide; ++x) curves_.vertices.push_back(kSide / 2 * kSide + x);
    curves_.offsets = {0, kSide};
    // World +y is up: a vertex of height y lies at 128 - y.
    curves_.camera.principal_point = {128, 128};
    curves_.camera.width = curves_.camera.height = 256;
  }

  StrokeDeformer Deformer(const StrokeDeformationOptions& options) const {
    return {triangles_, kNumVertices, curves_, options};
  }
  static Eigen::MatrixX3f Rows(const std::vector<float>& face) {
    return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(face.data(), kNumVertices, 3);
  }

  geometry::Triangles triangles_;
  ProjectedCurves curves_;
  std::vector<float> face_;
  const std::vector<render::Stroke> arch_ = {{0, {{126, 124}, {130, 123}, {132, 123.5f}, {136, 125}}}};
};

TEST_F(StrokeDeformerTest, OneRoundSolvesTheDenseNormalEquations) {
  const StrokeDeformationOptions options{.rounds = 1, .first_weight = 0.3, .last_weight = 0.3};
  const auto start = Project(curves_, face_);
  const CurvePull pull = PullOf(SegmentGrid(SegmentsOf(arch_), float(options.last_reach_px)), curves_.offsets,
                                Eigen::Map<const Eigen::VectorXf>(start.data(), Eigen::Index(start.size())),
                                float(options.last_reach_px), std::cos(float(options.max_angle * M_PI / 180)));
  const auto neighbours = geometry::VertexNeighbours(triangles_, kNumVertices);
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Identity(kNumVertices, kNumVertices);
  for (int i = 0; i < kNumVertices; ++i) {
    for (const int j : neighbours[i]) laplacian(i, j) -= 1.0 / double(neighbours[i].size());
  }
  Eigen::MatrixXd matrix = laplacian.transpose() * laplacian;
  matrix.diagonal().array() += 1e-8;
  Eigen::MatrixX2d rhs = Eigen::MatrixX2d::Zero(kNumVertices, 2);
  for (int k = 0; k < kSide; ++k) {
    const double weight = 0.3 * double(pull.weights[size_t(k)]);
    ASSERT_GT(weight, 0) << k;
    matrix(curves_.vertices[size_t(k)], curves_.vertices[size_t(k)]) += weight;
    for (int axis = 0; axis < 2; ++axis) {
      const auto i = size_t(2 * k + axis);
      rhs(curves_.vertices[size_t(k)], axis) = weight * double(pull.points[i] - start[i]);
    }
  }
  const Eigen::MatrixX2d moves = matrix.ldlt().solve(rhs);

  const Eigen::MatrixX3f moved = Rows(Deformer(options).Deform(face_, arch_)) - Rows(face_);
  EXPECT_LT((moved.col(0).cast<double>() - moves.col(0)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((moved.col(1).cast<double>() + moves.col(1)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT(moved.col(1).maxCoeff(), 0.5);
}

TEST_F(StrokeDeformerTest, KeepsDepthsAndPartsWithoutACurve) {
  const Eigen::MatrixX3f before = Rows(face_), after = Rows(Deformer({}).Deform(face_, arch_));
  EXPECT_EQ(after.col(2), before.col(2));
  EXPECT_LT((after - before).bottomRows(3).norm(), 1e-6);
}

TEST_F(StrokeDeformerTest, AShiftedLineShiftsTheWholeSurface) {
  // To the left and right the stroke continues, so that only the move across is determined.
  const std::vector<render::Stroke> line = {{0, {{100, 121}, {160, 121}}}};
  const Eigen::MatrixX3f moved = Rows(Deformer({.last_weight = 1e3}).Deform(face_, line)) - Rows(face_);
  const auto square = moved.topRows(kSide * kSide);
  EXPECT_LT((square.col(1).array() - 4).abs().maxCoeff(), 1e-3);
  EXPECT_LT(square.col(0).cwiseAbs().maxCoeff(), 1e-3);
}

TEST_F(StrokeDeformerTest, CurvesOfAFaceComeToLieOnTheStrokesOfAnother) {
  const ProjectedFace seen;
  const StrokeDeformer deformer(seen.face_template.triangles, seen.face_template.num_vertices(), seen.curves);
  const Eigen::VectorXf face = seen.Face(0, 0), other = seen.Face(3, 2);
  const auto strokes = CurveStrokes(seen.curves.offsets, seen.Points(other));
  const auto distance = [&](const std::vector<float>& of) {
    return DistanceBetween(strokes, CurveStrokes(seen.curves.offsets, Project(seen.curves, of))).two_way();
  };
  const std::vector<float> before(face.begin(), face.end()), after = deformer.Deform(before, strokes);
  EXPECT_LT(distance(after), 0.5 * distance(before));
  EXPECT_EQ(after, deformer.Deform(before, strokes));
}

TEST_F(StrokeDeformerTest, WithoutAStrokeWithinReachTheFaceComesBack) {
  const std::vector<render::Stroke> far = {{0, {{0, 0}, {20, 0}}}};
  for (const auto& strokes : {std::vector<render::Stroke>{}, far})
    EXPECT_EQ(Deformer({}).Deform(face_, strokes), face_);
  EXPECT_EQ(Deformer({.rounds = 0}).Deform(face_, arch_), face_);
}

TEST_F(StrokeDeformerTest, RefusesWhatItCannotFollow) {
  std::vector<float> face = face_;
  face.resize(9);
  testing::ExpectError([&] { Deformer({}).Deform(face, arch_); }, "a face of 9 coordinates");
  curves_.camera.perspective = true;
  testing::ExpectError([&] { Deformer({}); }, "orthographic camera alone");
}

TEST(StrokeDeformationOptions, AreParsed) {
  const auto options = ParseOptions<StrokeDeformationOptions>(Json{{"rounds", 3}, {"last_reach_px", 5.0}});
  EXPECT_EQ(options.rounds, 3);
  EXPECT_EQ(options.last_reach_px, 5.0);
}

}  // namespace
}  // namespace daumier::fitting
