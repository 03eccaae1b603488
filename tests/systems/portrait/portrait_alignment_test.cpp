#include "systems/portrait/portrait_alignment.h"

#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/portrait_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/small_portraits.h"

#include <cmath>

namespace daumier::portrait {
namespace {

/// A coarse face, and the landmarks of another one of the same pose.
struct AlignerProblem {
  faces::MorphableModel model = testing::SyntheticMorphable();
  std::vector<float> coarse, truth, landmarks;

  AlignerProblem() {
    Rng rng(8);
    coarse = truth = testing::DrawPortrait(model, rng);
    for (int k = 0; k < 4; ++k) truth[size_t(k)] += k % 2 == 0 ? 1.0F : -1.0F;
    landmarks = FacePainter(model).Paint(truth).landmarks;
  }
};

TEST(PortraitAligner, MovesTheCoarseFaceToTheLandmarks) {
  const AlignerProblem problem;
  for (const std::string adjust : {"none", "pose", "all"}) {
    const PortraitAligner aligner(problem.model, {.adjust = adjust, .fine = {.contour = "fixed"}});
    const AlignedPortrait aligned = aligner.Align(problem.coarse, problem.landmarks);
    const double before = NormalisedError(aligned.coarse, problem.landmarks);
    EXPECT_GT(before, 0.01);
    EXPECT_LT(NormalisedError(aligned.landmarks, problem.landmarks), 0.3 * before);
    const bool same_face = std::equal(problem.coarse.begin(), problem.coarse.end() - 6, aligned.coefficients.begin()),
               same_pose = std::equal(problem.coarse.end() - 6, problem.coarse.end(), aligned.coefficients.end() - 6);
    EXPECT_EQ(same_face, adjust != "all");
    EXPECT_EQ(same_pose, adjust == "none");
  }
}

TEST(PortraitAligner, LandmarksInPlaceLeaveTheFace) {
  const AlignerProblem problem;
  const PortraitAligner aligner(problem.model, {.adjust = "none", .fine = {.contour = "fixed", .keep_order = false}});
  const AlignedPortrait aligned = aligner.Align(problem.truth, problem.landmarks);
  const geometry::Points own = faces::Reconstruct(problem.model, problem.truth).vertices;
  EXPECT_LT((aligned.vertices - own).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(PortraitAligner, IgnoresLandmarksWithoutConfidence) {
  AlignerProblem problem;
  const PortraitAligner aligner(problem.model);
  std::vector<float> confidences(68, 1.0F);
  confidences[33] = 0;
  const geometry::Points before = aligner.Align(problem.coarse, problem.landmarks, confidences).vertices;
  problem.landmarks[66] = std::nanf("");
  EXPECT_EQ(before, aligner.Align(problem.coarse, problem.landmarks, confidences).vertices);
}

TEST(PortraitAligner, SeveralThreadsGetTheSameFaces) {
  const AlignerProblem problem;
  const PortraitAligner aligner(problem.model);
  testing::ExpectTheSameFromThreads(1, [&] { return aligner.Align(problem.coarse, problem.landmarks).vertices; });
}

TEST(PortraitAligner, RefusesOtherNumbers) {
  const AlignerProblem problem;
  const PortraitAligner aligner(problem.model);
  const std::vector<float> few(60, 1.0F);
  testing::ExpectError([&] { aligner.Align(few, problem.landmarks); }, "60 coefficients of a portrait, expected 239");
  testing::ExpectError([&] { aligner.Align(problem.coarse, few); }, "60 numbers of landmarks, expected 136");
  testing::ExpectError([&] { aligner.Align(problem.coarse, problem.landmarks, few); }, "60 confidences");
}

}  // namespace
}  // namespace daumier::portrait
