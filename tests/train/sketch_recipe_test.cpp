#include "train/sketch_recipe.h"

#include "datasets/read/training_fit.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace daumier::train {
namespace {

/// Six synthetic persons with their sketches, and a recipe on them.
class SketchRecipeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  SketchRecipeTest() : faces_(*folder_ / "faces"), sketches_(*folder_ / "sketches") {
    options_.bilinear = {.num_identity = 5, .num_expression = 3};
    options_.network = {.resolution = 32, .width = 4, .hidden = 16};
    split_ = datasets::MakeSplit(faces_, options_.split, options_.seed);
    bilinear_ = datasets::FitOnTraining(faces_, split_, options_.bilinear).model;
  }

  SketchRecipe MakeRecipe(const std::string& loss) {
    options_.loss = loss;
    torch::manual_seed(3);
    return SketchRecipe(options_, faces_, sketches_, split_, bilinear_, torch::kCPU);
  }

  static std::unique_ptr<testing::TempDir> folder_;
  faces::FaceDatabase faces_;
  datasets::SketchDatabase sketches_;
  SketchTrainingOptions options_;
  datasets::Split split_;
  faces::BilinearModel bilinear_;
};

std::unique_ptr<testing::TempDir> SketchRecipeTest::folder_;

TEST_F(SketchRecipeTest, WeightsTheVerticesOfFeatureCurvesAlone) {
  const faces::FaceTemplate& face_template = faces_.face_template();
  const torch::Tensor weights = CurveVertexWeights(face_template, 5);
  std::set<int> on_curves;
  for (const auto& curve : face_template.annotation.curves)
    on_curves.insert(curve.vertices.begin(), curve.vertices.end());
  ASSERT_EQ(weights.size(0), face_template.num_vertices());
  for (int vertex = 0; vertex < face_template.num_vertices(); ++vertex)
    EXPECT_EQ(weights[vertex].item<float>(), on_curves.count(vertex) ? 5.0f : 1.0f);
}

TEST_F(SketchRecipeTest, BothFormsOfTheLossGiveTheSameNumberAndGradient) {
  const std::vector<int> samples = {0, 7, 11, 3};
  std::vector<double> losses;
  std::vector<torch::Tensor> gradients;
  for (const char* loss : {"gram", "vertices"}) {
    SketchRecipe recipe = MakeRecipe(loss);
    recipe.module().train();
    const LossTerms terms = recipe.Loss(samples, 0);
    terms.total.backward();
    losses.push_back(terms.total.item<double>());
    gradients.push_back(recipe.module().parameters().front().grad());
  }
  EXPECT_NEAR(losses[0], losses[1], 1e-4 * losses[1]);
  EXPECT_LT((gradients[0] - gradients[1]).norm().item<double>(), 1e-3 * gradients[1].norm().item<double>());
}

TEST_F(SketchRecipeTest, SamplesAreTheTrainingFaces) {
  SketchRecipe recipe = MakeRecipe("gram");
  ASSERT_EQ(recipe.num_samples(), int(split_.train.size()));
  std::vector<int> all(split_.train.size());
  std::iota(all.begin(), all.end(), 0);
  const torch::Tensor faces = recipe.BatchTensors(all, 0).at("faces");
  for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(faces[int64_t(i)].item<int64_t>(), split_.train[i]);
}

TEST_F(SketchRecipeTest, ValidatesInMillimetresOverTheFaceRegion) {
  SketchRecipe recipe = MakeRecipe("gram");
  recipe.module().eval();
  const torch::NoGradGuard no_grad;
  const double error = recipe.Validate().at("mean_vertex_error_mm");

  // By LibTorch instead of eval/metrics.h: mean over validation faces and face region of the distances.
  const datasets::SketchDataset validation(sketches_, split_.validation, 32);
  std::vector<int> all(split_.validation.size());
  std::iota(all.begin(), all.end(), 0);
  models::SketchNetwork network = recipe.network();
  torch::Tensor distances = network->Decode(network->forward(validation.Get(all).images));
  for (size_t i = 0; i < all.size(); ++i) {
    const auto truth = faces_.vertices(split_.validation[i]);
    distances[int64_t(i)] -= torch::tensor(std::vector<float>(truth.begin(), truth.end()));
  }
  const torch::Tensor region = torch::tensor(faces_.face_template().annotation.regions.at("face")).to(torch::kInt64);
  distances = distances.view({distances.size(0), -1, 3}).norm(2, 2).index_select(1, region);
  EXPECT_NEAR(error, faces::MillimetresPerCm(faces_.face_template()) * distances.mean().item<double>(), 1e-3 * error);
}

TEST_F(SketchRecipeTest, AugmentsTrainingSketchesAnewInEachEpochAndNoValidationSketch) {
  const std::vector<int> samples = {0, 7, 11, 3};
  const auto images = [&](SketchRecipe& recipe, int64_t epoch) {
    return recipe.BatchTensors(samples, epoch).at("images");
  };
  const auto loss = [&](SketchRecipe& recipe, int64_t epoch) {
    const torch::NoGradGuard no_grad;
    recipe.module().eval();
    return recipe.Loss(samples, epoch).total.item<double>();
  };
  const auto validation = [](SketchRecipe& recipe) {
    const torch::NoGradGuard no_grad;
    recipe.module().eval();
    return recipe.Validate();
  };
  SketchRecipe plain = MakeRecipe("gram");
  EXPECT_TRUE(torch::equal(images(plain, 0), images(plain, 1)));
  options_.sketch.augmentation.strength = 1;
  SketchRecipe augmented = MakeRecipe("gram");
  EXPECT_FALSE(torch::equal(images(augmented, 0), images(plain, 0)));
  EXPECT_FALSE(torch::equal(images(augmented, 0), images(augmented, 1)));
  EXPECT_TRUE(torch::equal(images(augmented, 1), images(augmented, 1)));
  EXPECT_NE(loss(augmented, 0), loss(augmented, 1));
  EXPECT_EQ(validation(plain), validation(augmented));
  ++options_.seed;
  SketchRecipe other_seed = MakeRecipe("gram");
  EXPECT_FALSE(torch::equal(images(other_seed, 1), images(augmented, 1)));
}

TEST_F(SketchRecipeTest, RefusesASplitWithoutValidation) {
  split_.validation.clear();
  testing::ExpectError([&] { MakeRecipe("gram"); }, "needs training and validation faces");
}

}  // namespace
}  // namespace daumier::train
