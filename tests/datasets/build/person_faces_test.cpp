#include "datasets/build/person_faces.h"

#include "tests/support/from_threads.h"
#include "tests/support/synthetic_database.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(PersonFaces, ThePersonAloneDecides) {
  const faces::FaceModel model = testing::SyntheticModel();
  const FacesOptions options = testing::SyntheticFacesOptions(3);
  const PersonFacesMaker maker(model, model.expressions, options);
  const PersonArrays first = maker.Make(1), again = maker.Make(1), other = maker.Make(2);
  EXPECT_EQ(first.vertices, again.vertices);
  EXPECT_NE(first.vertices, other.vertices);
  EXPECT_NE(first.expression_strengths, other.expression_strengths);
}

TEST(PersonFaces, AreMadeInSeveralThreads) {
  const faces::FaceModel model = testing::SyntheticModel();
  const FacesOptions options = testing::SyntheticFacesOptions(3);
  const PersonFacesMaker maker(model, model.expressions, options);
  testing::ExpectTheSameFromThreads(3, [&] { return maker.Make(1).vertices; });
}

TEST(PersonFaces, WithoutVariationEveryStrengthIsOne) {
  const faces::FaceModel model = testing::SyntheticModel();
  FacesOptions options = testing::SyntheticFacesOptions(1);
  options.expression_variation = 0;
  const PersonArrays arrays = PersonFacesMaker(model, model.expressions, options).Make(0);
  EXPECT_EQ(arrays.expression_strengths, std::vector<float>(model.expressions.size(), 1.0f));
}

}  // namespace
}  // namespace daumier::datasets
