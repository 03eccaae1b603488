#include "rig/printed_head.h"

#include "geometry/closed_surface.h"
#include "geometry/stl.h"
#include "geometry/topology.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "tests/geometry/shapes.h"
#include "tests/rig/named_model.h"
#include "tests/support/expect_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using ::testing::HasSubstr;

class PrintedHeadTest : public ::testing::Test {
 protected:
  const faces::FaceModel model_ = testing::NamedModel();
  const RiggedHead head_ =
      HeadRig(model_.face_template)
          .On(model_.face_template.neutral, ExpressionTargets(model_).On(model_.face_template.neutral));
};

/// A head of a mesh alone.
RiggedHead HeadOf(geometry::TriangleMesh mesh) {
  RiggedHead head;
  head.materials.assign(size_t(mesh.triangles.rows()), faces::HeadMaterial::kSkin);
  head.targets.offsets.resize(3 * mesh.vertices.rows(), 0);
  head.mesh = std::move(mesh);
  return head;
}

/// A ball of radius 5 without the triangles whose middles are beyond 4 along an axis.
geometry::TriangleMesh BallOpenAt(std::initializer_list<geometry::Vector3> directions) {
  geometry::TriangleMesh ball = testing::Sphere(5, 4);
  std::vector<int> rows;
  for (int f = 0; f < ball.triangles.rows(); ++f) {
    const geometry::Vector3 middle = ball.vertices(ball.triangles.row(f), Eigen::all).colwise().mean();
    if (std::ranges::none_of(directions, [&](const geometry::Vector3& d) { return middle.dot(d) > 4; }))
      rows.push_back(f);
  }
  ball.triangles = ball.triangles(rows, Eigen::all).eval();
  return ball;
}

void ExpectPrintable(const PrintedHead& print) {
  EXPECT_TRUE(geometry::IsClosed(print.mesh.triangles));
  EXPECT_NO_THROW(geometry::CheckManifold(print.mesh.triangles, int(print.mesh.vertices.rows())));
  const auto parts = geometry::ConnectedParts(print.mesh);
  EXPECT_EQ(print.num_shells, int(parts.size()));
  for (const geometry::TriangleMesh& part : parts) EXPECT_GT(geometry::EnclosedVolume(part), 0);
  EXPECT_EQ(print.mesh.vertices.col(2).minCoeff(), 0);
  const auto read = geometry::DecodeStl(geometry::EncodeStl(print.mesh, "head"));
  EXPECT_EQ(read.triangles.rows(), print.mesh.triangles.rows());
  EXPECT_EQ(read.vertices.rows(), print.mesh.vertices.rows());
  EXPECT_TRUE(geometry::IsClosed(read.triangles));
}

TEST_F(PrintedHeadTest, IsClosedShellsInMillimetresOnAFlatBase) {
  const PrintedHead print = MakePrintedHead(head_);
  ExpectPrintable(print);
  EXPECT_EQ(print.num_shells, 1 + 3 + 2) << "skin, teeth, tongue, eyes";
  EXPECT_EQ(print.num_holes, 0);
  EXPECT_TRUE(print.warnings.empty());
  EXPECT_FALSE(print.faces_up);
  const double height = head_.mesh.vertices.col(1).maxCoeff() - head_.mesh.vertices.col(1).minCoeff();
  EXPECT_GT(print.SizeMm().z(), 10 * height - 15);
  EXPECT_LT(print.SizeMm().z(), 10 * height + 15);
  // z up and the face to -y: what is foremost is farthest along -y, as high as it was.
  Eigen::Index foremost, printed;
  head_.mesh.vertices.col(2).maxCoeff(&foremost);
  print.mesh.vertices.col(1).minCoeff(&printed);
  const double below_top = head_.mesh.vertices.col(1).maxCoeff() - head_.mesh.vertices(foremost, 1);
  EXPECT_NEAR(print.SizeMm().z() - print.mesh.vertices(printed, 2), 10 * below_top, 1e-6);
}

TEST_F(PrintedHeadTest, ShowsAPose) {
  const PrintedHead rest = MakePrintedHead(head_), open = MakePrintedHead(head_, {{"jawOpen", 1.0f}});
  ExpectPrintable(open);
  EXPECT_GT((rest.mesh.vertices.colwise().mean() - open.mesh.vertices.colwise().mean()).norm(), 1e-3);
  testing::ExpectError([&] { MakePrintedHead(head_, {{"jawWide", 1.0f}}); }, "no target 'jawWide'");
}

TEST(PrintedHead, AScanWithAnOpenNeckAndAHoleIsClosed) {
  const PrintedHead print =
      MakePrintedHead(HeadOf(BallOpenAt({-geometry::Vector3::UnitY(), geometry::Vector3::UnitX() * 0.87})));
  ExpectPrintable(print);
  EXPECT_EQ(print.num_shells, 1);
  EXPECT_EQ(print.num_holes, 1);
  EXPECT_FALSE(print.faces_up);
  EXPECT_THAT(print.warnings, ::testing::ElementsAre(HasSubstr("1 holes are closed")));
}

TEST(PrintedHead, AMaskLiesOnItsBack) {
  const PrintedHead print = MakePrintedHead(HeadOf(BallOpenAt({-geometry::Vector3::UnitZ()})));
  ExpectPrintable(print);
  EXPECT_TRUE(print.faces_up);
  EXPECT_NEAR(print.SizeMm().z(), 10 * (5 + 4) + 2, 5);
}

TEST(PrintedHead, SheetsAreLeftOutAndWhatIsInsideOutIsTurned) {
  geometry::TriangleMesh ball = testing::Sphere(5, 3), sheet = testing::FlatSheet(4);
  ball.triangles.col(1).swap(ball.triangles.col(2));
  sheet.vertices.rowwise() += Eigen::RowVector3d(0, 6, 0);
  const PrintedHead print = MakePrintedHead(HeadOf(geometry::Joined({ball, sheet})));
  ExpectPrintable(print);
  EXPECT_EQ(print.num_shells, 1);
  EXPECT_EQ(print.num_thin, 1);
  EXPECT_THAT(print.warnings, ::testing::Contains(HasSubstr("1 parts thinner than 0.2 mm")));
  geometry::TriangleMesh sideways = testing::FlatSheet(4);
  sideways.vertices.col(0).swap(sideways.vertices.col(2));
  testing::ExpectError([&] { MakePrintedHead(HeadOf(sideways)); }, "without thickness");
}

TEST(PrintedHead, HolesThatTouchAtAVertexAreApartInTheFile) {
  geometry::TriangleMesh ball = testing::Sphere(5, 4);
  // Two holes around opposite neighbours of a vertex meet there.
  const geometry::Adjacency at = geometry::TrianglesAtVertices(ball.triangles, int(ball.vertices.rows()));
  std::vector<int> rows;
  for (int f = 0; f < ball.triangles.rows(); ++f)
    if (f != at[4][0] && f != at[4][2]) rows.push_back(f);
  ball.triangles = ball.triangles(rows, Eigen::all).eval();
  const PrintedHead print = MakePrintedHead(HeadOf(ball));
  ExpectPrintable(print);
  EXPECT_EQ(print.num_shells, 1);
}

TEST(PrintedHead, EdgesOfThreeTrianglesAreCutWithAWarning) {
  geometry::TriangleMesh ball = testing::Sphere(5, 3);
  const int a = ball.triangles(0, 0), b = ball.triangles(0, 1);
  ball.vertices.conservativeResize(ball.vertices.rows() + 1, Eigen::NoChange);
  ball.vertices.bottomRows(1) << 0, 9, 9;
  ball.triangles.conservativeResize(ball.triangles.rows() + 1, Eigen::NoChange);
  ball.triangles.bottomRows(1) << a, b, int(ball.vertices.rows()) - 1;
  const PrintedHead print = MakePrintedHead(HeadOf(ball));
  ExpectPrintable(print);
  EXPECT_EQ(print.num_shells, 1);
  EXPECT_THAT(print.warnings, ::testing::Contains(HasSubstr("1 edges have more than two triangles")));
}

TEST_F(PrintedHeadTest, HasItsAttachments) {
  RiggedHead head = head_;
  const PrintedHead bald = MakePrintedHead(head, {});
  geometry::TriangleMesh bun = testing::Sphere(2, 2);
  bun.vertices.rowwise() += head.mesh.vertices.colwise().maxCoeff();
  head.attachments.push_back({"Bun", bun, Eigen::MatrixXf::Zero(bun.vertices.rows(), 3)});
  const PrintedHead print = MakePrintedHead(head, {});
  ExpectPrintable(print);
  EXPECT_EQ(print.num_shells, bald.num_shells + 1);
}

}  // namespace
}  // namespace daumier::rig
