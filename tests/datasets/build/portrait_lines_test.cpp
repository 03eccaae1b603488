#include "datasets/build/portrait_lines.h"

#include "datasets/read/portrait_camera.h"
#include "render/rasteriser.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

class PortraitLinesTest : public ::testing::Test {
 protected:
  PortraitLinesTest() : lines_(face_template_) {
    const geometry::Points landmarks = face_template_.neutral(face_template_.annotation.landmarks, Eigen::all);
    face_ = face_template_.neutral.rowwise() - landmarks.colwise().mean();
  }

  static render::Camera Camera(float yaw = 0) { return PortraitCamera({}, std::vector<float>{0, yaw, 0, 0, 0, -40}); }
  /// Buffers of the face alone, with eyes and mouth closed.
  render::PictureBuffers Own(const render::Camera& camera) const {
    render::PictureBuffers buffers = render::EmptyPictureBuffers(224, 224);
    geometry::Triangles triangles(face_template_.triangles.rows() + face_template_.closing_triangles.rows(), 3);
    triangles << face_template_.triangles, face_template_.closing_triangles;
    const render::Raster raster = render::Rasterise(camera, {face_, triangles});
    std::copy(raster.depth.begin(), raster.depth.end(), buffers.depth.begin());
    return buffers;
  }
  /// The share of a curve's vertices that are points of a stroke.
  double Drawn(const std::string& name, const render::Camera& camera,
               const std::vector<render::Stroke>& strokes) const {
    for (const faces::FeatureCurve& curve : face_template_.annotation.curves) {
      if (curve.name != name) continue;
      const geometry::Points pixels = render::Project(camera, face_(curve.vertices, Eigen::all));
      double num_drawn = 0;
      for (const auto& pixel : pixels.rowwise()) num_drawn += IsDrawn(pixel[0], pixel[1], strokes);
      return num_drawn / double(pixels.rows());
    }
    ADD_FAILURE() << "no curve " << name;
    return 0;
  }

  faces::FaceTemplate face_template_ = testing::SyntheticFace();
  geometry::Points face_;
  PortraitLines lines_;

 private:
  static bool IsDrawn(double x, double y, const std::vector<render::Stroke>& strokes) {
    for (const render::Stroke& stroke : strokes)
      for (const auto& point : stroke.points)
        if (std::hypot(point[0] - x, point[1] - y) < 1e-3) return true;
    return false;
  }
};

TEST_F(PortraitLinesTest, TheLinesOfNoseLidsLipsAndEarsAreDrawnAndNoOthers) {
  const render::Camera camera = Camera();
  const auto strokes = lines_.Draw(face_, camera, render::EmptyPictureBuffers(224, 224));
  for (const char* name : {"nose", "upper_eye_left", "upper_eye_right", "upper_mouth", "lower_mouth", "ear_left"})
    EXPECT_EQ(Drawn(name, camera, strokes), 1) << name;
  for (const char* name : {"brow_left", "profile_upper"}) EXPECT_LT(Drawn(name, camera, strokes), 0.3) << name;
}

TEST_F(PortraitLinesTest, WhatTheFaceItselfHidesIsNotDrawn) {
  const render::Camera camera = Camera(1);  // To its own left: the right ear is seen, the left one is behind.
  const auto strokes = lines_.Draw(face_, camera, Own(camera));
  EXPECT_EQ(Drawn("ear_right", camera, strokes), 1);
  EXPECT_EQ(Drawn("ear_left", camera, strokes), 0);
}

TEST_F(PortraitLinesTest, OccludingContoursLieWhereTheFaceEnds) {
  const render::Camera camera = Camera();
  const render::PictureBuffers buffers = Own(camera);
  const auto strokes = lines_.Draw(face_, camera, buffers);
  // The left and right end of the face in the row of the hairline, where no other line is.
  const int row = int(render::Project(camera, face_.row(face_template_.annotation.hairline_vertex))(0, 1));
  int left = 224, right = 0;
  for (int column = 0; column < 224; ++column)
    if (buffers.is_covered(size_t(row) * 224 + size_t(column))) left = std::min(left, column), right = column;
  ASSERT_LT(left, right);
  for (const int border : {left, right}) {
    double nearest = 1e9;
    for (const render::Stroke& stroke : strokes)
      for (const auto& point : stroke.points)
        nearest = std::min(nearest, std::hypot(double(point[0]) - border, double(point[1]) - row));
    EXPECT_LT(nearest, 10) << "a step of the grid is about as long";
  }
}

TEST_F(PortraitLinesTest, NothingIsDrawnBehindWhatIsNearer) {
  const render::Camera camera = Camera();
  render::PictureBuffers buffers = render::EmptyPictureBuffers(224, 224);
  std::fill(buffers.depth.begin(), buffers.depth.end(), 50.0f);
  EXPECT_TRUE(lines_.Draw(face_, camera, buffers).empty());
  for (size_t pixel = 0; pixel < buffers.size(); ++pixel)
    if (pixel % 224 >= 112) buffers.depth[pixel] = 1e10f;
  const auto strokes = lines_.Draw(face_, camera, buffers);
  EXPECT_EQ(Drawn("upper_eye_left", camera, strokes), 1);
  EXPECT_EQ(Drawn("upper_eye_right", camera, strokes), 0);
  for (const render::Stroke& stroke : strokes) {
    EXPECT_GE(stroke.points.size(), 2u);
    for (size_t p = 1; p < stroke.points.size(); ++p)
      EXPECT_GT((stroke.points[p - 1][0] + stroke.points[p][0]) / 2, 112 - 5);
  }
}

TEST_F(PortraitLinesTest, BuffersOfAnotherSizeAreRefused) {
  testing::ExpectError([&] { lines_.Draw(face_, Camera(), render::EmptyPictureBuffers(100, 100)); },
                       "a depth map of 100 x 100 for a camera of 224 x 224");
}

}  // namespace
}  // namespace daumier::datasets
