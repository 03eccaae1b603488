#include "systems/sketch/train/recipe.h"

#include "datasets/read/training_fit.h"
#include "tensor/autocast.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_networks.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>
#include <string>
#include <thread>

namespace daumier::sketch {
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
    options_.network = {.resolution = 32, .width = 8, .hidden = 16};
    split_ = datasets::MakeSplit(faces_, options_.split, options_.seed);
    models_ = {datasets::FitOnTraining(faces_, split_, options_.bilinear).model,
               datasets::FitCurvesOnTraining(faces_, sketches_, split_, options_.bilinear).model,
               {}};
  }

  SketchRecipe MakeRecipe(const std::string& loss) {
    options_.loss = loss;
    torch::manual_seed(3);
    return SketchRecipe(options_, faces_, sketches_, split_, models_, torch::kCPU);
  }

  static train::Batch ReadBatch(const SketchRecipe& recipe, const std::vector<int>& samples, int64_t epoch) {
    return train::ToDevice(recipe.Read(samples, epoch), torch::kCPU);
  }
  static train::LossTerms Loss(SketchRecipe& recipe, const std::vector<int>& samples, int64_t epoch) {
    return recipe.Loss(ReadBatch(recipe, samples, epoch));
  }

  void SetNetwork(const SketchNetworkOptions& network) {
    options_.network = network;
    models_.basis = network.residual == 0
                        ? faces::FaceBasis()
                        : datasets::FitBasisOnTraining(faces_, split_, models_.bilinear, network.residual, 1);
  }

  static std::unique_ptr<testing::TempDir> folder_;
  faces::FaceDatabase faces_;
  datasets::SketchDatabase sketches_;
  SketchTrainingOptions options_;
  datasets::Split split_;
  FittedModels models_;
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
    const train::LossTerms terms = Loss(recipe, samples, 0);
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
  const torch::Tensor faces = ReadBatch(recipe, all, 0).at("faces");
  for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(faces[int64_t(i)].item<int64_t>(), split_.train[i]);
}

TEST_F(SketchRecipeTest, ReadsTheSameBatchesFromSeveralThreadsWhileLossRuns) {
  options_.sketch.augmentation.strength = 1;
  SketchRecipe recipe = MakeRecipe("vertices");
  const std::vector<int> samples = {0, 7, 11, 3};
  std::vector<SampleBatch> batches(6);
  {
    std::vector<std::jthread> threads;
    for (size_t t = 0; t < 2; ++t)
      threads.emplace_back([&, t] {
        for (size_t i = t; i < batches.size(); i += 2) batches[i] = recipe.Read(samples, int64_t(i / 2));
      });
    Loss(recipe, samples, 0).total.backward();
  }
  for (size_t i = 0; i < batches.size(); ++i) {
    const SampleBatch alone = recipe.Read(samples, int64_t(i / 2));
    for (const auto& [name, array] : alone.arrays) EXPECT_EQ(batches[i].arrays.at(name).values, array.values) << name;
    EXPECT_EQ(batches[i].indices.at("faces").values, alone.indices.at("faces").values);
  }
}

TEST_F(SketchRecipeTest, ValidatesInMillimetresOverTheFaceRegion) {
  SketchRecipe recipe = MakeRecipe("gram");
  recipe.module().eval();
  const torch::NoGradGuard no_grad;
  const double error = recipe.Validate().at("mean_vertex_error_mm");

  // By LibTorch instead of eval/metrics.h: mean over validation faces and face region of the distances.
  const datasets::SketchDataset validation(sketches_, split_.validation, {.resolution = 32});
  std::vector<int> all(split_.validation.size());
  std::iota(all.begin(), all.end(), 0);
  SketchNetwork network = recipe.network();
  torch::Tensor distances =
      network->Decode(network->forward({train::ToDevice(validation.Get(all), torch::kCPU).at("images"), {}, {}}));
  for (size_t i = 0; i < all.size(); ++i) {
    const auto truth = faces_.vertices(split_.validation[i]);
    distances[int64_t(i)] -= torch::tensor(std::vector<float>(truth.begin(), truth.end()));
  }
  const torch::Tensor region = torch::tensor(faces_.face_template().annotation.regions.at("face")).to(torch::kInt64);
  distances = distances.view({distances.size(0), -1, 3}).norm(2, 2).index_select(1, region);
  EXPECT_NEAR(error, faces::MillimetresPerCm(faces_.face_template()) * distances.mean().item<double>(), 1e-3 * error);
}

TEST_F(SketchRecipeTest, AugmentsTrainingSketchesInEachEpochAndThoseOfValidationOnce) {
  const std::vector<int> samples = {0, 7, 11, 3};
  const auto images = [&](SketchRecipe& recipe, int64_t epoch) {
    return ReadBatch(recipe, samples, epoch).at("images");
  };
  const auto loss = [&](SketchRecipe& recipe, int64_t epoch) {
    const torch::NoGradGuard no_grad;
    recipe.module().eval();
    return Loss(recipe, samples, epoch).total.item<double>();
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
  EXPECT_NE(validation(plain), validation(augmented));
  EXPECT_EQ(validation(augmented), validation(augmented));
  ++options_.seed;
  SketchRecipe other_seed = MakeRecipe("gram");
  EXPECT_FALSE(torch::equal(images(other_seed, 1), images(augmented, 1)));
}

TEST_F(SketchRecipeTest, StagesAreThoseOfThePaper) {
  EXPECT_EQ(MakeRecipe("gram").stages().back().share, 1);
  options_.stages = {.classification = 0.25, .regression = 0.5, .regression_rate = 0.01};
  SketchRecipe recipe = MakeRecipe("gram");
  const auto stages = recipe.stages();
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_EQ(stages[0].share, 0.25);
  EXPECT_EQ(stages[1].rate, 0.01);
  EXPECT_EQ(stages[2].share, 0.25);
  EXPECT_EQ(&recipe.product(), recipe.network().get());
  EXPECT_NE(&recipe.module(), &recipe.product());
  options_.stages.regression = 0.9;
  testing::ExpectError([&] { MakeRecipe("gram"); }, "add up to 1.15");
}

TEST_F(SketchRecipeTest, ClassificationOfAnUntrainedNetworkIsAtChance) {
  options_.stages.classification = 0.5;
  SketchRecipe recipe = MakeRecipe("gram");
  recipe.EnterStage(0);
  // Scores of zero: each entropy is the logarithm of the number of classes.
  const torch::NoGradGuard no_grad;
  for (auto& item : recipe.module().named_parameters()) {
    if (item.key().rfind("identity.", 0) == 0 || item.key().rfind("expression.", 0) == 0) item.value().zero_();
  }
  const train::LossTerms terms = Loss(recipe, {0, 7, 11}, 0);
  const auto identities = datasets::TrainingIdentities(faces_, split_);
  EXPECT_NEAR(terms.parts.at("identity_entropy").item<double>(), std::log(double(identities.size())), 1e-5);
  EXPECT_NEAR(terms.parts.at("expression_entropy").item<double>(), std::log(double(faces_.num_expressions())), 1e-5);
}

TEST_F(SketchRecipeTest, RegressionIsTheDistanceFromTheFactorsOfTheFace) {
  options_.stages.regression = 0.5;
  SketchRecipe recipe = MakeRecipe("gram");
  recipe.EnterStage(1);
  recipe.module().eval();
  const torch::NoGradGuard no_grad;
  const int sample = 11, face = split_.train[11];
  const train::LossTerms terms = Loss(recipe, {sample}, 0);
  const auto predicted =
      SketchNetwork(recipe.network())->forward({ReadBatch(recipe, {sample}, 0).at("images"), {}, {}});
  const auto identities = datasets::TrainingIdentities(faces_, split_);
  const auto row =
      std::find(identities.begin(), identities.end(), face / faces_.num_expressions()) - identities.begin();
  const auto& factors = models_.bilinear.identity_factors;
  double expected = 0;
  for (int k = 0; k < factors.cols(); ++k) {
    const auto column = factors.col(k);
    const double deviation = std::sqrt((column.array() - column.mean()).square().mean());
    expected += std::pow((predicted.u[0][k].item<double>() - factors(row, k)) / deviation, 2);
  }
  EXPECT_NEAR(terms.parts.at("u_error").item<double>(), expected, 1e-3 * expected);
  EXPECT_GT(terms.parts.at("v_error").item<double>(), 0);
}

TEST_F(SketchRecipeTest, EveryKindOfNetworkTakesAStepInEachStage) {
  options_.stages = {.classification = 0.3, .regression = 0.3};
  options_.sketch.augmentation.strength = 1;
  for (const auto& [name, network] : testing::SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    SetNetwork(network);
    SketchRecipe recipe = MakeRecipe("gram");
    for (int stage = 0; stage < 3; ++stage) {
      recipe.EnterStage(stage);
      recipe.module().train();
      const train::LossTerms terms = Loss(recipe, {0, 7, 11, 3}, 0);
      EXPECT_TRUE(std::isfinite(terms.total.item<double>()));
      EXPECT_NO_THROW(terms.total.backward());
    }
  }
}

TEST_F(SketchRecipeTest, Bfloat16RoundsTheStepAndNothingElse) {
  // LibTorch requires oneDNN's bfloat16 wherever the processor has AVX-512, whatever this variable allows oneDNN.
  if (std::getenv("ONEDNN_MAX_CPU_ISA")) GTEST_SKIP() << "oneDNN may be without bfloat16";
  options_.stages = {.classification = 0.3, .regression = 0.3};
  for (const auto& [name, network] : testing::SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    SetNetwork(network);
    std::vector<double> losses, validations;
    for (const char* precision : {"float32", "bfloat16"}) {
      SketchRecipe recipe = MakeRecipe("gram");
      recipe.EnterStage(2);
      recipe.module().eval();
      validations.push_back(recipe.Validate().at("mean_vertex_error_mm"));
      const train::LossTerms terms = [&] {
        const tensor::Autocast reduced(torch::kCPU, precision == std::string("bfloat16"));
        return Loss(recipe, {0, 7, 11, 3}, 0);
      }();
      EXPECT_EQ(terms.total.scalar_type(), torch::kFloat32);
      terms.total.backward();
      losses.push_back(terms.total.item<double>());
      for (const auto& parameter : recipe.product().parameters()) {
        EXPECT_EQ(parameter.scalar_type(), torch::kFloat32);
        ASSERT_TRUE(parameter.grad().defined());
        EXPECT_EQ(parameter.grad().scalar_type(), torch::kFloat32);
      }
    }
    EXPECT_EQ(validations[0], validations[1]);
    EXPECT_NE(losses[0], losses[1]);
    EXPECT_NEAR(losses[0], losses[1], 0.02 * losses[0]);
  }
}

TEST_F(SketchRecipeTest, RefusesASplitWithoutValidation) {
  split_.validation.clear();
  testing::ExpectError([&] { MakeRecipe("gram"); }, "needs training and validation faces");
}

}  // namespace
}  // namespace daumier::sketch
