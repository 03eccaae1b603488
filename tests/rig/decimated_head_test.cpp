#include "rig/decimated_head.h"

#include "geometry/closed_surface.h"
#include "geometry/corner_uv.h"
#include "geometry/normals.h"
#include "geometry/topology.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "rig/texture_space.h"
#include "tests/geometry/shapes.h"
#include "tests/rig/named_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::rig {
namespace {

class DecimatedHeadTest : public ::testing::Test {
 protected:
  static double AreaOf(const geometry::TriangleMesh& mesh, const std::vector<int>& values, int value) {
    const Eigen::VectorXd areas = geometry::TriangleAreas(mesh);
    double sum = 0;
    for (size_t f = 0; f < values.size(); ++f) sum += values[f] == value ? areas[Eigen::Index(f)] : 0;
    return sum;
  }

  static bool HasSameTriangles(const RiggedHead& a, const RiggedHead& b) {
    return a.mesh.triangles.rows() == b.mesh.triangles.rows() && a.mesh.triangles == b.mesh.triangles;
  }

  const faces::FaceModel model_ = testing::NamedModel();
  const RiggedHead head_ =
      HeadRig(model_.face_template)
          .On(model_.face_template.neutral, ExpressionTargets(model_).On(model_.face_template.neutral));
  const int half_ = NumTriangles(head_) / 2;
  const DecimatedHead fewer_ = Decimated(head_, half_);
};

TEST_F(DecimatedHeadTest, HasAsFewTrianglesAsAskedForAndTheSameParts) {
  EXPECT_TRUE(fewer_.is_reached);
  EXPECT_LE(fewer_.num_triangles, half_);
  EXPECT_GE(fewer_.num_triangles, half_ - 1);
  EXPECT_EQ(fewer_.num_triangles, NumTriangles(fewer_.head));
  EXPECT_EQ(fewer_.num_triangles_before, NumTriangles(head_));
  const RiggedHead& head = fewer_.head;
  EXPECT_TRUE(geometry::IsClosed(head.mesh.triangles));
  EXPECT_EQ(geometry::EulerCharacteristic(head.mesh.triangles), geometry::EulerCharacteristic(head_.mesh.triangles));
  EXPECT_EQ(head.materials.size(), size_t(head.mesh.triangles.rows()));
  EXPECT_EQ(head.targets.names, head_.targets.names);
  EXPECT_EQ(head.targets.offsets.rows(), 3 * head.mesh.vertices.rows());
  EXPECT_NO_THROW(geometry::CheckUv(head.mesh));
  const std::set<faces::HeadMaterial> before(head_.materials.begin(), head_.materials.end()),
      after(head.materials.begin(), head.materials.end());
  EXPECT_EQ(before, after);
  ASSERT_EQ(head.eyes.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const RiggedEye& eye = head.eyes[i];
    EXPECT_EQ(eye.centre, head_.eyes[i].centre);
    EXPECT_TRUE(geometry::IsClosed(eye.mesh.triangles));
    EXPECT_EQ(eye.materials.size(), size_t(eye.mesh.triangles.rows()));
    EXPECT_LT(eye.mesh.triangles.rows(), head_.eyes[i].mesh.triangles.rows()) << "eyes share the budget";
    EXPECT_NO_THROW(geometry::CheckUv(eye.mesh));
  }
}

TEST_F(DecimatedHeadTest, VerticesThatRemainKeepPlaceDisplacementsAndUv) {
  int before = 0;
  for (Eigen::Index v = 0; v < fewer_.head.mesh.vertices.rows(); ++v) {
    while (before < head_.mesh.vertices.rows() && head_.mesh.vertices.row(before) != fewer_.head.mesh.vertices.row(v))
      ++before;
    ASSERT_LT(before, head_.mesh.vertices.rows()) << "in their old order";
    EXPECT_EQ(fewer_.head.targets.offsets.middleRows(3 * v, 3), head_.targets.offsets.middleRows(3 * before, 3));
  }
  const auto uv_at_places = [](const RiggedHead& head) {
    std::set<std::array<double, 5>> corners;
    for (Eigen::Index i = 0; i < head.mesh.triangles.size(); ++i) {
      const auto place = head.mesh.vertices.row(head.mesh.triangles.data()[i]);
      const auto uv = head.mesh.uv.row(head.mesh.uv_triangles.data()[i]);
      corners.insert({place.x(), place.y(), place.z(), uv.x(), uv.y()});
    }
    return corners;
  };
  EXPECT_TRUE(std::ranges::includes(uv_at_places(head_), uv_at_places(fewer_.head)));
}

TEST_F(DecimatedHeadTest, KeepsThePeakOfEveryTarget) {
  EXPECT_EQ(fewer_.greatest_peak_loss, 0);
  EXPECT_TRUE(fewer_.worst_target.empty());
  for (Eigen::Index t = 0; t < head_.targets.offsets.cols(); ++t) {
    const auto peak = [&](const RiggedHead& head) {
      Eigen::Map<const Eigen::Matrix3Xf> columns(head.targets.offsets.col(t).data(), 3, head.mesh.vertices.rows());
      return columns.colwise().norm().maxCoeff();
    };
    EXPECT_EQ(peak(fewer_.head), peak(head_));
  }
}

TEST_F(DecimatedHeadTest, TheNeckKeepsItsCap) {
  ASSERT_FALSE(head_.neck_cap.empty());
  geometry::TriangleMesh cap{fewer_.head.mesh.vertices, fewer_.head.mesh.triangles(fewer_.head.neck_cap, Eigen::all)};
  EXPECT_EQ(geometry::EulerCharacteristic(cap.triangles), 1) << "a disc";
}

TEST_F(DecimatedHeadTest, BordersOfItsOwnMaterialsStay) {
  RiggedHead own = head_;
  own.own_materials = {{.name = "left"}, {.name = "right"}};
  const auto side = [](const geometry::TriangleMesh& mesh, double shift) {
    std::vector<int> sides;
    for (const auto& t : mesh.triangles.rowwise()) sides.push_back(testing::MiddleOf(mesh, t, 0) + shift > 0 ? 0 : 1);
    return sides;
  };
  own.own = side(own.mesh, 0);
  for (RiggedEye& eye : own.eyes) eye.own = side(eye.mesh, eye.centre.x());
  const RiggedHead head = Decimated(own, half_).head;
  ASSERT_EQ(head.own.size(), size_t(head.mesh.triangles.rows()));
  EXPECT_NEAR(AreaOf(head.mesh, head.own, 0) / AreaOf(own.mesh, own.own, 0), 1, 0.1);
  EXPECT_EQ(head.eyes[0].own.size(), size_t(head.eyes[0].mesh.triangles.rows()));
}

TEST_F(DecimatedHeadTest, AHeadOfFewTrianglesIsUnchanged) {
  const DecimatedHead same = Decimated(head_, NumTriangles(head_));
  EXPECT_EQ(same.num_triangles, same.num_triangles_before);
  EXPECT_EQ(same.head.mesh.triangles, head_.mesh.triangles);
  EXPECT_EQ(same.head.mesh.vertices, head_.mesh.vertices);
}

TEST_F(DecimatedHeadTest, ByTheNeutralPoseAloneItLosesPeaksOrNot) {
  const DecimatedHead plain = Decimated(head_, half_, DecimatedPoses::kNeutral);
  EXPECT_TRUE(plain.is_reached);
  EXPECT_EQ(plain.greatest_peak_loss > 0, !plain.worst_target.empty());
  EXPECT_LE(plain.greatest_peak_loss, 1);
}

TEST_F(DecimatedHeadTest, ManyVerticesLeaveRoomForTheLargestTargetsAloneAndKeepAllPeaks) {
  const Eigen::Index num_vertices = JoinedMesh(head_).vertices.rows();
  const RiggedHead one = Decimated(head_, half_, DecimatedPoses::kAll, num_vertices).head;
  EXPECT_FALSE(HasSameTriangles(one, fewer_.head));
  EXPECT_EQ(Decimated(head_, half_, DecimatedPoses::kAll, 2 * num_vertices).greatest_peak_loss, 0);
  EXPECT_TRUE(HasSameTriangles(Decimated(head_, half_, DecimatedPoses::kAll, 100 * num_vertices).head, fewer_.head));
}

TEST_F(DecimatedHeadTest, ReportsWhatItCannotReach) {
  const DecimatedHead least = Decimated(head_, 1);
  EXPECT_FALSE(least.is_reached);
  EXPECT_GT(least.num_triangles, 1);
  EXPECT_LT(least.num_triangles, half_);
  EXPECT_EQ(least.greatest_peak_loss, 0);
}

}  // namespace
}  // namespace daumier::rig
