#include "faces/import/facewarehouse.h"

#include "tests/faces/import/foreign_face.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::ForeignMesh;
using testing::TempDir;
using testing::WriteForeignObj;

/// shape.bs as FaceWarehouse has it: three counts, then the shapes as floats.
std::string ShapeFile(const std::vector<geometry::Points>& shapes) {
  const int32_t header[3] = {static_cast<int32_t>(shapes.size()) - 1, static_cast<int32_t>(shapes[0].rows()), 11540};
  std::string bytes(reinterpret_cast<const char*>(header), sizeof(header));
  for (const geometry::Points& shape : shapes) {
    const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> floats = shape.cast<float>();
    bytes.append(reinterpret_cast<const char*>(floats.data()), sizeof(float) * floats.size());
  }
  return bytes;
}

/// Shape e of a person is lifted by e / 10 units.
std::vector<geometry::Points> Shapes(double k) {
  std::vector<geometry::Points> shapes;
  for (int e = 0; e < 4; ++e) {
    shapes.push_back(ForeignMesh(k, 10).vertices);
    shapes.back().col(1).array() += 0.1 * e;
  }
  return shapes;
}

class FaceWarehouseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const int person : {1, 2, 10}) {
      const auto tester = folder_ / fmt::format("Tester_{}", person);
      WriteForeignObj(tester / "TrainingPose/pose_0.obj", ForeignMesh(person, 10));
      MakeDirectory(tester / "Blendshape");
      WriteFileAtomically(tester / "Blendshape/shape.bs", ShapeFile(Shapes(person)));
    }
  }
  GivenFaces Load(FaceWarehouseSet set, const std::filesystem::path& mesh = {}) const {
    return LoadFaceWarehouse(folder_.path(), mesh, set, testing::ForeignAnnotation());
  }

  TempDir folder_;
};

TEST_F(FaceWarehouseTest, BlendshapesArePersonsTimesExpressions) {
  const GivenFaces given = Load(FaceWarehouseSet::kBlendshapes);
  EXPECT_EQ(given.names, (std::vector<std::string>{"Tester_1", "Tester_2", "Tester_10"}));
  EXPECT_EQ(given.groups, given.names);
  EXPECT_EQ(given.expressions, (std::vector<std::string>{"neutral", "shape_1", "shape_2", "shape_3"}));
  EXPECT_LT((given.face(2, 0) - ForeignMesh(10).vertices).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT(((given.face(1, 3) - given.face(1, 0)).col(1).array() - 3).abs().maxCoeff(), 1e-5);
  EXPECT_EQ(given.face_template.provenance.at("name"), "FaceWarehouse");
}

TEST_F(FaceWarehouseTest, TrainingPosesAreTwentyExpressions) {
  for (const int person : {1, 2, 10}) {
    for (int pose = 0; pose < 20; ++pose) {
      WriteForeignObj(folder_ / fmt::format("Tester_{}/TrainingPose/pose_{}.obj", person, pose),
                      ForeignMesh(person + 0.1 * pose, 10));
    }
  }
  const GivenFaces given = Load(FaceWarehouseSet::kTrainingPoses);
  EXPECT_EQ(given.expressions.size(), 20u);
  EXPECT_EQ(given.expressions.back(), "pose_19");
  EXPECT_LT((given.face(1, 19) - ForeignMesh(3.9).vertices).cwiseAbs().maxCoeff(), 1e-9);
  std::filesystem::remove(folder_ / "Tester_2/TrainingPose/pose_7.obj");
  ExpectError([&] { given.face(1, 7); }, "Tester_2/TrainingPose/pose_7.obj");
}

TEST_F(FaceWarehouseTest, PolygonsComeFromAMeshOfTheTopology) {
  for (const int person : {1, 2, 10})
    std::filesystem::remove(folder_ / fmt::format("Tester_{}/TrainingPose/pose_0.obj", person));
  EXPECT_THROW(Load(FaceWarehouseSet::kBlendshapes), UsageError);
  WriteForeignObj(folder_ / "warehouse_0.obj", ForeignMesh());
  EXPECT_EQ(Load(FaceWarehouseSet::kBlendshapes, folder_ / "warehouse_0.obj").names.size(), 3u);
}

TEST_F(FaceWarehouseTest, ForeignFoldersAreRefused) {
  ExpectError(
      [&] {
        LoadFaceWarehouse(folder_ / "Tester_1", {}, FaceWarehouseSet::kBlendshapes, testing::ForeignAnnotation());
      },
      "is it FaceWarehouse?");
  std::filesystem::remove(folder_ / "Tester_2/Blendshape/shape.bs");
  ExpectError([&] { Load(FaceWarehouseSet::kBlendshapes); }, "Tester_2/Blendshape/shape.bs");
}

TEST(ShapeFile, SizesAreCheckedAndTailsTolerated) {
  const std::string bytes = ShapeFile(Shapes(0));
  const int num_vertices = static_cast<int>(ForeignMesh().vertices.rows());
  EXPECT_EQ(CountShapes(bytes, num_vertices, "shape.bs"), 4);
  EXPECT_EQ(CountShapes(bytes + "tail", num_vertices, "shape.bs"), 4);
  ExpectError([&] { CountShapes(bytes, num_vertices + 1, "shape.bs"); }, "shape.bs: shapes of");
  ExpectError([&] { ReadShape(bytes, 4, num_vertices, "shape.bs"); }, "shape 4 of 4");
  for (size_t size = 0; size < bytes.size(); size += 97)
    ExpectError([&] { CountShapes(std::string_view(bytes).substr(0, size), num_vertices, "shape.bs"); }, "truncated");
}

TEST(ShapeFile, HostileHeadersAreRefused) {
  const auto with_header = [](int32_t shapes, int32_t vertices) {
    std::string bytes = ShapeFile(Shapes(0));
    std::memcpy(bytes.data(), &shapes, 4);
    std::memcpy(bytes.data() + 4, &vertices, 4);
    return bytes;
  };
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  for (const int32_t shapes : {-1, 0, 1001, kMost})
    ExpectError([&] { CountShapes(with_header(shapes, 5), 5, "shape.bs"); }, "not a shape.bs file");
  ExpectError([&] { CountShapes(with_header(3, -1), -1, "shape.bs"); }, "not a shape.bs file");
  ExpectError([&] { CountShapes(with_header(1000, kMost), kMost, "shape.bs"); }, "truncated");
  std::string nan = ShapeFile(Shapes(0));
  const float value = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 12, &value, 4);
  ExpectError([&] { ReadShape(nan, 0, static_cast<int>(ForeignMesh().vertices.rows()), "shape.bs"); }, "not finite");
}

}  // namespace
}  // namespace daumier::faces
