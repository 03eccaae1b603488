#include "systems/deform/edit_points.h"

#include "core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::testing {
namespace {

TEST(EditPoints, ReadsLandmarksVerticesAndPresets) {
  const faces::FaceTemplate face = SyntheticFace();
  const deform::EditHandles landmark = deform::ParseHandle(face, "30=0,0,1.5");
  EXPECT_EQ(landmark.points, std::vector<int>{face.annotation.landmarks[30]});
  EXPECT_EQ(landmark.displacements, (geometry::Points(1, 3) << 0, 0, 1.5).finished());
  EXPECT_EQ(deform::ParseHandle(face, "v12=-1,2e-1,0").points, std::vector<int>{12});
  EXPECT_EQ(deform::ParseHandle(face, "chin=2").displacements, (geometry::Points(1, 3) << 0, -2, 0).finished());
}

TEST(EditPoints, PresetsOfBothSidesAreSymmetric) {
  const faces::FaceTemplate face = SyntheticFace();
  for (const char* name : {"cheeks", "ears"}) {
    const deform::EditHandles handles = deform::PresetHandles(face, name, 1);
    ASSERT_EQ(handles.points.size(), 2u) << name;
    EXPECT_NEAR(face.neutral(handles.points[0], 0), -face.neutral(handles.points[1], 0), 1e-9) << name;
    EXPECT_LT(face.neutral(handles.points[0], 0), 0) << name;
    EXPECT_EQ(handles.displacements(0, 0), -1) << name;
    EXPECT_EQ(handles.displacements(1, 0), 1) << name;
  }
}

TEST(EditPoints, RefusesWordsWithAnExample) {
  const faces::FaceTemplate face = SyntheticFace();
  for (const char* word :
       {"30", "=1", "68=0,0,1", "30=0,1", "v-1=0,0,1", "v100000=0,0,1", "knee=1", "nose=1,2,3", "30=0,0,x",
        "30=0,0,nan", "30=0,0,1,", "t=0,0,1", "t-1=0,0,1", "t1000000=0,0,1", "t5:0.2=0,0,1", "t5:0.8,0.4=0,0,1",
        "t5:-0.1,0.4=0,0,1", "t5:a,0.4=0,0,1", "t5:0.2,0.3=0,1"}) {
    EXPECT_THROW(deform::ParseHandle(face, word), UsageError) << word;
    ExpectError([&] { deform::ParseHandle(face, word); }, "--handle");
  }
}

TEST(EditPoints, LabelsHaveAnAmount) {
  EXPECT_EQ(deform::ParseLabel("smile").amount, 1);
  EXPECT_EQ(deform::ParseLabel("smile").name, "smile");
  EXPECT_EQ(deform::ParseLabel("nose_width=-0.5").name, "nose_width");
  EXPECT_EQ(deform::ParseLabel("nose_width=-0.5").amount, -0.5);
  for (const char* word : {"smile=", "smile=much", "smile=1x", "smile=nan", "smile=inf"})
    EXPECT_THROW(deform::ParseLabel(word), UsageError) << word;
}

TEST(EditPoints, AVertexHasOneHandle) {
  const faces::FaceTemplate face = SyntheticFace();
  const deform::EditHandles nose = deform::PresetHandles(face, "nose", 1),
                            chin = deform::PresetHandles(face, "chin", 1);
  const deform::EditHandles both = deform::JoinHandles({nose, chin}, face.num_vertices());
  EXPECT_EQ(both.points.size(), 2u);
  EXPECT_EQ(both.displacements.rows(), 2);
  ExpectError([&] { deform::JoinHandles({nose, nose}, face.num_vertices()); }, "two handles");
}

TEST(EditPoints, ReadsPointsOfTriangles) {
  const faces::FaceTemplate face = SyntheticFace();
  const deform::EditHandles point = deform::ParseHandle(face, "t7:0.2,0.5=0,1,-2"),
                            middle = deform::ParseHandle(face, "t9=1,0,0");
  EXPECT_EQ(point.points, std::vector<int>{face.num_vertices()});
  ASSERT_EQ(point.on_surface.size(), 1u);
  EXPECT_EQ(point.on_surface[0].triangle, 7);
  EXPECT_TRUE(point.on_surface[0].weights.isApprox(Eigen::Vector3d(0.3, 0.2, 0.5)));
  EXPECT_EQ(point.displacements, (geometry::Points(1, 3) << 0, 1, -2).finished());
  EXPECT_TRUE(middle.on_surface[0].weights.isApprox(Eigen::Vector3d::Constant(1.0 / 3)));
  const deform::EditHandles all =
      deform::JoinHandles({point, deform::PresetHandles(face, "nose", 1), middle}, face.num_vertices());
  EXPECT_EQ(all.points,
            (std::vector<int>{face.num_vertices(), face.annotation.landmarks[30], face.num_vertices() + 1}));
  EXPECT_EQ(all.on_surface[1].triangle, 9);
  const auto vertices = deform::VerticesOfHandles(face, all);
  const auto corners = face.triangles.row(7);
  EXPECT_EQ(vertices[0], (std::vector<int>{corners[2], corners[0], corners[1]}));
  EXPECT_EQ(vertices[1], std::vector<int>{face.annotation.landmarks[30]});
  ExpectError([&] { deform::JoinHandles({point, middle, point}, face.num_vertices()); }, "triangle 7 has two handles");
}

TEST(EditPoints, TheOutsideOfTheNoseIsNotTheNose) {
  const faces::FaceTemplate face = SyntheticFace();
  const deform::EditHandles preset = deform::PresetHandles(face, "nose", 1);
  const std::vector<int>& nose = preset.points;
  const std::vector<int> outside = deform::OutsideOfPart(face, preset);
  EXPECT_TRUE(std::is_sorted(outside.begin(), outside.end()));
  EXPECT_FALSE(std::binary_search(outside.begin(), outside.end(), nose.front()));
  EXPECT_TRUE(std::binary_search(outside.begin(), outside.end(), face.annotation.hairline_vertex));
  EXPECT_GT(outside.size(), size_t(face.num_vertices() / 2));
}

}  // namespace
}  // namespace daumier::testing
