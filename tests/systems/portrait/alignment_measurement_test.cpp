#include "systems/portrait/alignment_measurement.h"

#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"

#include <cmath>

namespace daumier::portrait {
namespace {

/// A portrait of a face that the model has, guessed wrongly.
struct MeasurementProblem {
  faces::MorphableModel model = testing::SyntheticMorphable();
  AlignmentMeasurement measurement{model, {.fine = {.contour = "fixed"}}};
  AlignmentSubject subject;

  MeasurementProblem() {
    Rng rng(8);
    std::vector<float> x = testing::DrawPortrait(model, rng);
    const FacePicture painted = measurement.painter().Paint(x);
    subject.name = "a portrait";
    subject.crop = OverlayFace(render::Image(224, 224, 3, 40), painted);
    subject.shown.assign(224 * 224, 1.0F);
    subject.landmarks = subject.truth = painted.landmarks;
    subject.vertices = faces::Reconstruct(model, x).vertices;
    for (int k = 0; k < 4; ++k) x[size_t(k)] += k % 2 == 0 ? 1.0F : -1.0F;
    subject.coefficients = x;
  }
};

double Mean68(const std::array<double, 68>& distances) {
  double sum = 0;
  for (const double distance : distances) sum += distance;
  return sum / 68;
}

TEST(AlignmentMeasurement, FineFacesAreNearerThanCoarseOnes) {
  const MeasurementProblem problem;
  const AlignmentErrors coarse = problem.measurement.Measure(AlignmentMethod::kCoarse, problem.subject);
  EXPECT_GT(Mean68(coarse.used_px), 0.5);
  EXPECT_EQ(coarse.used_px, coarse.alternate_px);
  EXPECT_EQ(coarse.flips, 0);
  EXPECT_GT(coarse.error_mm, 0.1);
  EXPECT_TRUE(std::isfinite(coarse.colours));
  for (const AlignmentMethod method :
       {AlignmentMethod::kFineAsPrinted, AlignmentMethod::kFine, AlignmentMethod::kFineCotangent}) {
    const AlignmentErrors fine = problem.measurement.Measure(method, problem.subject);
    EXPECT_LT(Mean68(fine.used_px), 0.4 * Mean68(coarse.used_px)) << NameOf(method);
    EXPECT_LT(Mean68(fine.alternate_px), Mean68(coarse.alternate_px)) << NameOf(method);
  }
  EXPECT_LT(Mean68(problem.measurement.Measure(AlignmentMethod::kAdjustIdExp, problem.subject).used_px),
            Mean68(problem.measurement.Measure(AlignmentMethod::kAdjustExp, problem.subject).used_px));
}

TEST(AlignmentMeasurement, TheTrueFaceHasNoErrors) {
  MeasurementProblem problem;
  for (int k = 0; k < 4; ++k) problem.subject.coefficients[size_t(k)] -= k % 2 == 0 ? 1.0F : -1.0F;
  const AlignmentErrors errors = problem.measurement.Measure(AlignmentMethod::kCoarse, problem.subject);
  EXPECT_LT(Mean68(errors.used_px), 1e-3);
  EXPECT_LT(errors.error_mm, 1e-3);
  EXPECT_LT(errors.colours, 0.01);
  EXPECT_NEAR(errors.interocular_px, InterocularDistance(problem.subject.truth), 1e-9);
}

TEST(AlignmentMeasurement, LandmarksThatAreLeftOutAreNotSeen) {
  MeasurementProblem problem;
  const AlignmentErrors before = problem.measurement.Measure(AlignmentMethod::kFine, problem.subject);
  problem.subject.landmarks[60] += 30;  // Number 30, of the nose; the truth stays.
  const AlignmentErrors after = problem.measurement.Measure(AlignmentMethod::kFine, problem.subject);
  EXPECT_EQ(before.alternate_px[30], after.alternate_px[30]);
  EXPECT_EQ(before.left_out_px[30], after.left_out_px[30]);
  EXPECT_GT(after.used_px[30], before.used_px[30] + 5);
  EXPECT_GT(after.alternate_px[29], before.alternate_px[29]);
}

TEST(AlignmentMeasurement, RefusesASubjectWithoutTruth) {
  MeasurementProblem problem;
  problem.subject.truth.clear();
  testing::ExpectError([&] { problem.measurement.Measure(AlignmentMethod::kCoarse, problem.subject); },
                       "a portrait: 0 numbers of true landmarks");
}

}  // namespace
}  // namespace daumier::portrait
