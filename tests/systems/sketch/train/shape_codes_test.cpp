#include "systems/sketch/train/shape_codes.h"

#include "tests/support/expect_error.h"
#include "tests/systems/sketch/train/run_fixture.h"

namespace daumier::sketch {
namespace {

class ShapeCodesTest : public SketchRunFixture {
 protected:
  ShapeCodesTest() : data_(OpenSketchRunData(*folder_ / "run")), test_(data_, {}, {}) {}

  StoredCoefficients Start() const {
    StoredCoefficients stored(data_.run.network);
    stored.Append(test_.reader().Forward(data_.run.network, test_.faces()));
    return stored;
  }

  const SketchRunData data_;
  const SketchTestSet test_;
};

TEST_F(ShapeCodesTest, GivenOnesAreThoseOfTheLabelledStrokes) {
  const ShapeCodes codes(test_, std::nullopt, true);
  const ShapeInput input(data_.run.models.curves, data_.sketches, data_.faces.face_template());
  for (const int face : {test_.faces()[0], data_.split.train[0], data_.split.validation[0]})
    EXPECT_EQ(codes.given(face).numbers(), input.Given(data_.sketches.strokes(face)).numbers()) << face;
  EXPECT_FALSE(codes.can_recover());
  testing::ExpectError([&] { codes.recovered(0); }, "were not recovered");
  testing::ExpectError([&] { codes.without_shape(); }, "no network");
}

TEST_F(ShapeCodesTest, RecoveredOnesStartFromThePredictedFace) {
  const ShapeCodes codes(test_, Start(), true);
  const ShapeInput input(data_.run.models.curves, data_.sketches, data_.faces.face_template());
  const SketchPredictions start = codes.without_shape().Decode(0, int64_t(test_.faces().size()));
  const int face = test_.faces()[1];
  const auto expected = input.Recovered(eval::RowSpan(start.faces, 1), data_.sketches.strokes(face));
  EXPECT_LT((codes.recovered(1).numbers() - expected.numbers()).cwiseAbs().maxCoeff(), 1e-5f);
  const std::vector<faces::CurveCode> predicted = codes.Predicted({0, std::span(test_.faces()).first(2)});
  ASSERT_EQ(predicted.size(), 2u);
  EXPECT_NE(predicted[1].numbers(), codes.recovered(1).numbers()) << "without a snap";
  EXPECT_LT(codes.ErrorPx(codes.given(face), face), codes.ErrorPx(predicted[1], face))
      << "an untrained network predicts badly";
}

TEST_F(ShapeCodesTest, NothingIsComputedIfNothingReadsThem) {
  const ShapeCodes codes(test_, Start(), false);
  EXPECT_TRUE(codes.can_recover());
  testing::ExpectError([&] { codes.given(test_.faces()[0]); }, "were not computed");
}

}  // namespace
}  // namespace daumier::sketch
