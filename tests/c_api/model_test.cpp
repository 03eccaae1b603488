#include "c_api/daumier.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace daumier::c_api {
namespace {

const daumier_model* Model() {
  static daumier_model* const model = [] {
    daumier_model* opened = nullptr;
    EXPECT_EQ(daumier_model_open(nullptr, &opened), DAUMIER_OK) << daumier_last_error();
    return opened;
  }();
  return model;
}

std::vector<float> Decode(const std::vector<float>& code) {
  std::vector<float> xyz(3 * daumier_model_num_vertices(Model()));
  EXPECT_EQ(daumier_model_decode(Model(), code.data(), code.size(), xyz.data(), xyz.size()), DAUMIER_OK)
      << daumier_last_error();
  return xyz;
}

std::vector<float> Zero() {
  return std::vector<float>(daumier_model_num_numbers(Model()));
}

double LargestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, double(std::abs(a[i] - b[i])));
  return largest;
}

constexpr int32_t kHandle = 30;  // Any vertex.

TEST(CModel, FacesOfTheModelAreFoundAgain) {
  std::vector<float> code = Zero();
  ASSERT_GT(code.size(), 10u);
  code[0] = 1.5f;
  code[7] = -1;
  const std::vector<float> face = Decode(code);
  std::vector<float> found = Zero();
  ASSERT_EQ(daumier_model_encode(Model(), face.data(), face.size(), found.data(), found.size()), DAUMIER_OK)
      << daumier_last_error();
  EXPECT_NEAR(found[0], 1.5, 0.3);  // Small codes are preferred.
  EXPECT_NEAR(found[7], -1, 0.3);
  EXPECT_LT(LargestDifference(Decode(found), face), 0.04);
  EXPECT_GT(LargestDifference(Decode(Zero()), face), 0.2);
}

TEST(CModel, TrianglesAreOfItsVertices) {
  std::vector<int32_t> corners(3 * daumier_model_num_triangles(Model()));
  ASSERT_EQ(daumier_model_triangles(Model(), corners.data(), corners.size()), DAUMIER_OK);
  EXPECT_GE(*std::ranges::min_element(corners), 0);
  EXPECT_LT(size_t(*std::ranges::max_element(corners)), daumier_model_num_vertices(Model()));
}

TEST(CModel, TheTipOfTheNoseIsInFrontOfTheChin) {
  const std::vector<float> face = Decode(Zero());
  const int32_t nose = daumier_model_landmark(Model(), 30), chin = daumier_model_landmark(Model(), 8);
  ASSERT_GE(nose, 0);
  ASSERT_GE(chin, 0);
  EXPECT_GT(face[3 * size_t(nose) + 2], face[3 * size_t(chin) + 2]);
  EXPECT_GT(face[3 * size_t(nose) + 1], face[3 * size_t(chin) + 1]);
  EXPECT_EQ(daumier_model_landmark(Model(), 68), -1);
  EXPECT_EQ(daumier_model_landmark(Model(), -1), -1);
  EXPECT_EQ(daumier_model_landmark(nullptr, 30), -1);
}

TEST(CModel, ExaggerationMayBeInPlaceAndZeroChangesNothing) {
  std::vector<float> code = Zero();
  code[1] = 2;
  const std::vector<float> face = Decode(code);
  std::vector<float> exaggerated = face;
  ASSERT_EQ(daumier_model_exaggerate(Model(), exaggerated.data(), face.size(), 0, exaggerated.data(), face.size()),
            DAUMIER_OK);
  EXPECT_LT(LargestDifference(exaggerated, face), 1e-5);
  ASSERT_EQ(daumier_model_exaggerate(Model(), exaggerated.data(), face.size(), 1, exaggerated.data(), face.size()),
            DAUMIER_OK);
  const std::vector<float> mean = Decode(Zero());
  EXPECT_GT(LargestDifference(exaggerated, mean), 1.5 * LargestDifference(face, mean));
  EXPECT_EQ(daumier_model_exaggerate(Model(), face.data(), face.size(), 3, exaggerated.data(), face.size()),
            DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "strength is 3 (expected 0 to 2)");
}

TEST(CModel, HandlesFollowTheirMoves) {
  const std::vector<float> face = Decode(Zero());
  const std::vector<int32_t> handles = {kHandle, 2000};
  for (const int is_local : {0, 1}) {
    daumier_edit* edit = nullptr;
    ASSERT_EQ(daumier_edit_begin(Model(), face.data(), face.size(), handles.data(), 1, is_local, &edit), DAUMIER_OK)
        << daumier_last_error();
    std::vector<float> moved(face.size());
    const std::vector<float> none = {0, 0, 0}, up = {0, 0.5f, 0};
    ASSERT_EQ(daumier_edit_move(edit, none.data(), 3, moved.data(), moved.size()), DAUMIER_OK) << daumier_last_error();
    EXPECT_LT(LargestDifference(moved, face), 1e-5);
    ASSERT_EQ(daumier_edit_move(edit, up.data(), 3, moved.data(), moved.size()), DAUMIER_OK);
    EXPECT_NEAR(moved[3 * kHandle + 1] - face[3 * kHandle + 1], 0.5, 0.06);
    ASSERT_EQ(daumier_edit_move(edit, none.data(), 3, moved.data(), moved.size()),
              DAUMIER_OK);  // From where it was at first.
    EXPECT_LT(LargestDifference(moved, face), 1e-5);
    EXPECT_EQ(daumier_edit_move(edit, up.data(), 6, moved.data(), moved.size()), DAUMIER_MISUSED);
    daumier_edit_free(edit);
  }
}

TEST(CModel, OneModelServesSeveralThreads) {
  std::vector<float> code = Zero();
  code[3] = 1;
  testing::ExpectTheSameFromThreads(2, [&] { return Decode(code); });
}

TEST(CModel, WrongArgumentsAreMisuse) {
  std::vector<float> face = Decode(Zero()), code = Zero();
  daumier_edit* edit = nullptr;
  const std::vector<int32_t> twice = {kHandle, kHandle}, beyond = {1'000'000};
  EXPECT_EQ(daumier_edit_begin(Model(), face.data(), face.size(), twice.data(), 2, 0, &edit), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_edit_begin(Model(), face.data(), face.size(), beyond.data(), 1, 0, &edit), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_edit_begin(Model(), face.data(), face.size(), beyond.data(), 0, 0, &edit), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_edit_begin(Model(), face.data(), face.size() - 3, twice.data(), 1, 0, &edit), DAUMIER_MISUSED);
  std::vector<int32_t> many(DAUMIER_MOST_HANDLES + 1);
  std::iota(many.begin(), many.end(), 0);
  EXPECT_EQ(daumier_edit_begin(Model(), face.data(), face.size(), many.data(), many.size(), 0, &edit), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "num_handles is 201 (expected 1 to 200)");
  EXPECT_EQ(edit, nullptr);
  EXPECT_EQ(daumier_model_decode(Model(), code.data(), code.size() + 1, face.data(), face.size()), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_last_error(),
            "code has " + std::to_string(code.size() + 1) + " elements (expected " + std::to_string(code.size()) + ")");
  code[0] = std::nanf("");
  EXPECT_EQ(daumier_model_decode(Model(), code.data(), code.size(), face.data(), face.size()), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_model_encode(nullptr, face.data(), face.size(), code.data(), code.size()), DAUMIER_MISUSED);
  daumier_model* model = nullptr;
  EXPECT_EQ(daumier_model_open("sketch-ict", &model), DAUMIER_MISUSED);
  EXPECT_EQ(model, nullptr);
  daumier_model_free(nullptr);
  daumier_edit_free(nullptr);
  EXPECT_EQ(daumier_model_num_vertices(nullptr), 0u);
  EXPECT_EQ(daumier_model_num_triangles(nullptr), 0u);
  EXPECT_EQ(daumier_model_num_numbers(nullptr), 0u);
}

}  // namespace
}  // namespace daumier::c_api
