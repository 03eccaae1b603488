#include "fitting/pictured_points.h"

#include "core/files.h"
#include "fitting/forehead_landmarks.h"
#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::testing {
namespace {

class PicturedPoints : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  const FieldModel model_;
  const faces::FaceTemplate& face_ = model_.face_template();
  const TempDir folder_;
};

TEST_F(PicturedPoints, AnAnnotatedSetHasItsOwnVertices) {
  const int jaw = face_.annotation.landmarks[3], nose = face_.annotation.landmarks[30];
  const auto landmarks = Write("points.txt", "10 20\n30 40\nnan nan\n50 60\n70 80\n");
  const auto vertices = Write("vertices.txt", fmt::format("{}\n5\n6\n{}\n-1\n", nose, jaw));
  const auto points = fitting::ReadPicturedPoints(face_, landmarks, vertices);
  ASSERT_EQ(points.size(), 3u);  // One is absent, one has no vertex.
  EXPECT_EQ(points[0].vertex, nose);
  EXPECT_EQ(points[0].jaw_landmark, -1);
  EXPECT_EQ(points[1].vertex, 5);
  EXPECT_EQ(points[1].pixel, Eigen::Vector2d(30, 40));
  EXPECT_EQ(points[2].vertex, jaw);
  EXPECT_EQ(points[2].jaw_landmark, 3);
}

/// A code is found again from 81 points of its face, and the forehead's points are what finds the height of the skull.
TEST_F(PicturedPoints, OfEightyOneTheLastAreTheForeheads) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const fitting::ScaledView view{10, turn, {150, 170}};
  Eigen::VectorXd code(FieldModel::kFields);
  code << 0.5, 0.8, -0.3, 0.4, 0, 0;
  const geometry::Points face = model_.Vertices(code);
  const fitting::ContourPaths contour(face_);
  const fitting::PicturePoints shown = fitting::ShownLandmarks(model_, contour, code, view);
  const auto forehead = fitting::ForeheadLandmarks(face_);
  std::string text;
  for (const auto& row : shown.rowwise()) text += fmt::format("{} {}\n", row.x(), row.y());
  for (const int vertex : forehead) {
    const geometry::Points point = face.row(vertex);
    const fitting::PicturePoints pixel = view.Project(point);
    text += fmt::format("{} {}\n", pixel(0, 0), pixel(0, 1));
  }
  const auto points = fitting::ReadPicturedPoints(face_, Write("81.txt", text));
  ASSERT_EQ(points.size(), 81u);
  EXPECT_EQ(points[71].vertex, forehead[3]);
  EXPECT_EQ(points[8].jaw_landmark, 8);
  const fitting::CodeLandmarkFit fit =
      fitting::FitCodeToLandmarks(model_, contour, points, {.deviation = 2e-3, .rounds = 30});
  EXPECT_LT(fit.distances_px.maxCoeff() / fit.eye_distance_px, 0.02);
  EXPECT_LT(fit.distances_px.tail(13).mean() / fit.eye_distance_px, 0.01);
}

TEST_F(PicturedPoints, SixtyEightAreInTheirOrder) {
  std::string text;
  for (int k = 0; k < 68; ++k) text += k == 20 ? "nan nan\n" : fmt::format("{} {}\n", k, 2 * k);
  const auto points = fitting::ReadPicturedPoints(face_, Write("68.txt", text));
  ASSERT_EQ(points.size(), 67u);
  EXPECT_EQ(points[20].vertex, face_.annotation.landmarks[21]);
  EXPECT_EQ(points[20].pixel, Eigen::Vector2d(21, 42));
  EXPECT_EQ(points[2].jaw_landmark, 2);
}

TEST_F(PicturedPoints, RefusesFilesThatDoNotFit) {
  const auto three = Write("three.txt", "1 2\n3 4\n5 6\n");
  ExpectError([&] { fitting::ReadPicturedPoints(face_, three); }, "three.txt");
  ExpectError([&] { fitting::ReadPicturedPoints(face_, three, Write("two.txt", "1\n2\n")); }, "has 2 vertices");
  ExpectError([&] { fitting::ReadPicturedPoints(face_, three, Write("far.txt", "1\n2\n1000000\n")); },
              "no vertex of the template");
  ExpectError([&] { fitting::ReadPicturedPoints(face_, three, Write("half.txt", "1\n2\n3.5\n")); },
              "no vertex of the template");
  ExpectError([&] { fitting::ReadPicturedPoints(face_, three, three); }, "expected one vertex");
  ExpectError([&] { fitting::ReadPicturedPoints(face_, Write("flat.txt", "1\n2\n3\n")); }, "flat.txt");
}

}  // namespace
}  // namespace daumier::testing
