#include "systems/portrait/portrait_predictor.h"

#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"
#include "tests/support/temp_dir.h"

#include <cmath>
#include <mutex>

namespace daumier::portrait {
namespace {

/// Returns coefficients that are given, whatever it reads, and keeps the last crop.
class GivenCoefficients : public runtime::NetworkRunner {
 public:
  explicit GivenCoefficients(std::vector<float> coefficients) : coefficients_(std::move(coefficients)) {}
  NamedArrays Run(const NamedArrays& inputs) const override {
    const std::scoped_lock lock(mutex_);
    crop_ = inputs.at("crop");
    return {{"coefficients", FloatArray({1, int64_t(coefficients_.size())}, coefficients_)}};
  }
  FloatArray crop() const { return crop_; }

 private:
  std::vector<float> coefficients_;
  mutable std::mutex mutex_;
  mutable FloatArray crop_;
};

struct PredictorProblem {
  faces::MorphableModel model = testing::SyntheticMorphable();
  std::vector<float> x;
  std::shared_ptr<GivenCoefficients> network;
  render::Image picture;
  std::vector<float> landmarks;  ///< In the picture.
};

PredictorProblem MakePredictorProblem() {
  PredictorProblem problem;
  Rng rng(6);
  problem.x = testing::DrawPortrait(problem.model, rng);
  problem.network = std::make_shared<GivenCoefficients>(problem.x);
  const FacePicture face = FacePainter(problem.model).Paint(problem.x);
  problem.picture = OverlayFace(render::Image(224, 224, 3, 40), face);
  problem.landmarks = face.landmarks;
  return problem;
}

PortraitPredictor MakePredictor(const PredictorProblem& problem, const PortraitPredictOptions& options = {}) {
  PortraitRunFolder run;
  run.directory = "a run";
  run.model = problem.model;
  run.options.network = {.depth = 18, .resolution = 64, .width = 8};
  return PortraitPredictor(std::move(run), problem.network, nullptr, options);
}

TEST(PortraitPredictor, ReturnsTheFaceOfTheCoefficientsInTheSourcesFrame) {
  const PredictorProblem problem = MakePredictorProblem();
  const std::vector<systems::Input> inputs = {problem.picture};
  const systems::FaceResult face = MakePredictor(problem).Predict(inputs).at(0);
  const geometry::Points own = faces::Reconstruct(problem.model, problem.x).vertices;
  EXPECT_LT((face.vertices.rowwise() - problem.model.centre.transpose() - own).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((face.face_template->neutral - testing::SyntheticFace().neutral).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(face.identity.size(), 80);
  EXPECT_EQ(face.expression.size(), 64);
  EXPECT_EQ(face.landmarks.rows(), 68);
  EXPECT_EQ(face.record.at("coefficients").at("pose").size(), 6U);
  ASSERT_EQ(face.warnings.size(), 1U);
  EXPECT_NE(face.warnings[0].find("landmark_run"), std::string::npos);
  EXPECT_EQ(face.pictures.size(), 3U);
  EXPECT_EQ(face.pictures.back().caption, "overlay");
  // The picture is its own crop: the landmarks of the face are where it is drawn.
  for (size_t n = 0; n < 68; ++n)
    EXPECT_NEAR(face.record.at("landmarks")[n][0].get<double>(), problem.landmarks[2 * n], 0.01);
}

TEST(PortraitPredictor, CropsByGivenLandmarks) {
  const testing::TempDir folder;
  const PredictorProblem problem = MakePredictorProblem();
  std::string text;
  for (size_t n = 0; n < 68; ++n)
    text += fmt::format("{} {}\n", problem.landmarks[2 * n], problem.landmarks[2 * n + 1]);
  WriteFileAtomically(folder / "landmarks.txt", text);
  const PortraitPredictor predictor = MakePredictor(problem, {.landmarks = (folder / "landmarks.txt").string()});
  const std::vector<systems::Input> inputs = {problem.picture};
  const systems::FaceResult face = predictor.Predict(inputs).at(0);
  EXPECT_TRUE(face.warnings.empty());
  const PortraitPrediction prediction = predictor.FromLandmarks(problem.picture, problem.landmarks);
  EXPECT_NEAR(face.record.at("crop").at("shift")[0].get<double>(), prediction.map.shift.x(), 0.01);
  EXPECT_EQ(problem.network->crop().shape, (std::vector<int64_t>{1, 3, 64, 64}));
  const std::vector<systems::Input> two = {problem.picture, problem.picture};
  testing::ExpectError([&] { predictor.Predict(two); }, "landmarks and mask are given for one picture, here are 2");
}

TEST(PortraitPredictor, AlignsFacesWithLandmarks) {
  const testing::TempDir folder;
  const PredictorProblem problem = MakePredictorProblem();
  std::string text;
  for (size_t n = 0; n < 68; ++n)  // Larger eyes.
    text += fmt::format("{} {}\n", problem.landmarks[2 * n],
                        problem.landmarks[2 * n + 1] + (n == 37 || n == 38 || n == 43 || n == 44 ? -4 : 0));
  WriteFileAtomically(folder / "landmarks.txt", text);
  const std::string file = (folder / "landmarks.txt").string();
  const std::vector<systems::Input> inputs = {problem.picture};
  const systems::FaceResult fine = MakePredictor(problem, {.landmarks = file}).Predict(inputs).at(0),
                            coarse = MakePredictor(problem, {.landmarks = file, .fine = false}).Predict(inputs).at(0);
  EXPECT_EQ(coarse.record.at("stage"), "coarse");
  EXPECT_FALSE(coarse.record.contains("landmark_error"));
  EXPECT_EQ(fine.record.at("stage"), "fine");
  const Json& errors = fine.record.at("landmark_error");
  EXPECT_LT(errors.at("fine").get<double>(), errors.at("coarse").get<double>());
  EXPECT_GT((fine.vertices - coarse.vertices).rowwise().norm().maxCoeff(), 0.05);
  EXPECT_EQ(fine.pictures.size(), coarse.pictures.size() + 1);
  EXPECT_EQ(fine.pictures.back().caption, "overlay");
}

TEST(PortraitPredictor, TakesPicturesOfAnySizeAndKind) {
  const PredictorProblem problem = MakePredictorProblem();
  const PortraitPredictor predictor = MakePredictor(problem);
  const std::vector<systems::Input> inputs = {render::Image(1, 1, 3, 7), render::Image(3, 900, 1, 9),
                                              render::Image(3000, 2000, 3, 120)};
  for (const systems::FaceResult& face : predictor.Predict(inputs)) EXPECT_TRUE(face.vertices.allFinite());
}

TEST(PortraitPredictor, RefusesWhatIsNoPicture) {
  const PredictorProblem problem = MakePredictorProblem();
  const std::vector<systems::Input> inputs = {problem.picture, geometry::PolygonMesh{}};
  testing::ExpectError([&] { MakePredictor(problem).Predict(inputs); }, "input 2 of 2: this is no picture");
}

}  // namespace
}  // namespace daumier::portrait
