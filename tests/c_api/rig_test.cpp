#include "c_api/daumier.h"
#include "c_api/places.h"
#include "core/json.h"
#include "faces/face_model_file.h"
#include "gltf/head_reader.h"
#include "rig/arkit_names.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace daumier::c_api {
namespace {

std::vector<float> MeanFace() {
  daumier_model* model = nullptr;
  EXPECT_EQ(daumier_model_open(nullptr, &model), DAUMIER_OK) << daumier_last_error();
  std::vector<float> code(daumier_model_num_numbers(model)), xyz(3 * daumier_model_num_vertices(model));
  EXPECT_EQ(daumier_model_decode(model, code.data(), code.size(), xyz.data(), xyz.size()), DAUMIER_OK);
  daumier_model_free(model);
  return xyz;
}

/// Of the mean face; its rig is gone.
const daumier_head* Head() {
  static daumier_head* const head = [] {
    daumier_rig* rig = nullptr;
    EXPECT_EQ(daumier_rig_open(nullptr, &rig), DAUMIER_OK) << daumier_last_error();
    const std::vector<float> face = MeanFace();
    daumier_head* made = nullptr;
    EXPECT_EQ(daumier_rig_head(rig, face.data(), face.size() - 3, &made), DAUMIER_MISUSED);
    EXPECT_EQ(made, nullptr);
    EXPECT_EQ(daumier_rig_head(rig, face.data(), face.size(), &made), DAUMIER_OK) << daumier_last_error();
    daumier_rig_free(rig);
    return made;
  }();
  return head;
}

TEST(CRig, HeadsHaveTheTargetsOfArkit) {
  ASSERT_EQ(daumier_head_num_targets(Head()), size_t(rig::kNumArkitNames));
  for (size_t t = 0; t < size_t(rig::kNumArkitNames); ++t)
    EXPECT_EQ(daumier_head_target_name(Head(), t), rig::ArkitNames()[t]);
  EXPECT_EQ(daumier_head_target_name(Head(), 52), nullptr);
  const auto jaw_open = size_t(std::ranges::find(rig::ArkitNames(), "jawOpen") - rig::ArkitNames().begin());
  std::vector<float> offsets(3 * daumier_head_num_vertices(Head()));
  ASSERT_EQ(daumier_head_target(Head(), jaw_open, offsets.data(), offsets.size()), DAUMIER_OK) << daumier_last_error();
  EXPECT_LT(*std::ranges::min_element(offsets), -1);  // The chin falls by more than 1 cm.
  EXPECT_EQ(daumier_head_target(Head(), 52, offsets.data(), offsets.size()), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_head_target(Head(), jaw_open, offsets.data(), offsets.size() - 1), DAUMIER_MISUSED);
}

TEST(CRig, WrittenHeadsAreRead) {
  const testing::TempDir directory;
  const std::filesystem::path file = directory.path() / "head.glb";
  ASSERT_EQ(daumier_head_write(Head(), file.c_str()), DAUMIER_OK) << daumier_last_error();
  const gltf::HeadInFile read = gltf::ReadHead(file);
  EXPECT_EQ(size_t(read.head.mesh.triangles.rows()), daumier_head_num_triangles(Head()));
  EXPECT_EQ(read.head.targets.names.size(), daumier_head_num_targets(Head()));
  std::vector<float> xyz(3 * daumier_head_num_vertices(Head()));
  std::vector<int32_t> corners(3 * daumier_head_num_triangles(Head()));
  ASSERT_EQ(daumier_head_vertices(Head(), xyz.data(), xyz.size()), DAUMIER_OK);
  ASSERT_EQ(daumier_head_triangles(Head(), corners.data(), corners.size()), DAUMIER_OK);
  const auto [lowest, highest] = std::ranges::minmax_element(xyz);
  EXPECT_NEAR(read.head.mesh.vertices.col(1).maxCoeff() - read.head.mesh.vertices.col(1).minCoeff(), *highest - *lowest,
              5);
  EXPECT_LT(size_t(*std::ranges::max_element(corners)), daumier_head_num_vertices(Head()));
}

TEST(CRig, PortraitsLoseTheirExpressionAndDrawingsHaveNone) {
  daumier_rig* rig = nullptr;
  ASSERT_EQ(daumier_rig_open("face-ict", &rig), DAUMIER_OK) << daumier_last_error();
  for (const auto& [weights, file, shows_expression] :
       {std::tuple{"portrait", "docs/examples/portraits/woman.jpg", true},
        std::tuple{"sketch-ict", "docs/examples/drawings/girl.svg", false}}) {
    daumier_predictor* predictor = nullptr;
    daumier_face* face = nullptr;
    ASSERT_EQ(daumier_predictor_open(weights, &predictor), DAUMIER_OK) << daumier_last_error();
    ASSERT_EQ(daumier_predict_file(predictor, file, &face), DAUMIER_OK) << daumier_last_error();
    const size_t size = 3 * daumier_face_num_vertices(face);
    std::vector<float> shown(size), neutral(size), offset(size);
    ASSERT_EQ(daumier_face_vertices(face, shown.data(), size), DAUMIER_OK);
    ASSERT_EQ(daumier_rig_neutral(rig, face, neutral.data(), size), DAUMIER_OK) << daumier_last_error();
    EXPECT_EQ(shown != neutral, shows_expression) << weights;
    if (shows_expression) {  // What is removed is what the record states, on the model's own shapes.
      const Json record = Json::parse(daumier_face_record(face));
      const auto stated = record.at("coefficients").at("expression").get<std::vector<float>>();
      const faces::FaceModel model = faces::ReadFaceModelWeights(FolderNamed("face-ict"));
      const auto num = std::min<Eigen::Index>(std::ssize(stated), model.expression_shapes.cols());
      const Eigen::VectorXf removed =
          model.expression_shapes.leftCols(num) * Eigen::Map<const Eigen::VectorXf>(stated.data(), num);
      for (size_t i = 0; i < size; ++i) ASSERT_NEAR(shown[i] - neutral[i], removed[Eigen::Index(i)], 1e-4) << i;
    }
    daumier_face_free(face);
    daumier_predictor_free(predictor);
  }
  EXPECT_EQ(daumier_rig_neutral(rig, nullptr, nullptr, 0), DAUMIER_MISUSED);
  daumier_rig_free(rig);
}

TEST(CRig, FilesOfOtherKindsAndPlacesAreErrors) {
  const testing::TempDir directory;
  EXPECT_EQ(daumier_head_write(Head(), (directory.path() / "head.obj").c_str()), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_head_write(Head(), (directory.path() / "missing/head.glb").c_str()), DAUMIER_FAILED);
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  EXPECT_EQ(daumier_head_write(Head(), nullptr), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_head_write(nullptr, "head.glb"), DAUMIER_MISUSED);
  daumier_rig* rig = nullptr;
  EXPECT_EQ(daumier_rig_open("sketch-ict", &rig), DAUMIER_MISUSED);
  EXPECT_EQ(rig, nullptr);
  daumier_head_free(nullptr);
  daumier_rig_free(nullptr);
  EXPECT_EQ(daumier_head_num_vertices(nullptr), 0u);
}

}  // namespace
}  // namespace daumier::c_api
