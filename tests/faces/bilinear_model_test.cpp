#include "faces/bilinear_model.h"

#include "core/files.h"
#include "tests/faces/random_tensor.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <Eigen/SVD>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::TempDir;

/// T = C x2 U x3 V with a random core of the given ranks.
Tensor BilinearTensor(int num_identities, int num_expressions, int num_coordinates, int ku, int kv, uint64_t seed) {
  Rng rng(seed);
  const Eigen::MatrixXf core = RandomMatrix(num_coordinates, ku * kv, rng);
  const Eigen::MatrixXf u = RandomMatrix(num_identities, ku, rng), v = RandomMatrix(num_expressions, kv, rng);
  Tensor tensor{num_identities, num_expressions, num_coordinates,
                Eigen::MatrixXf::Zero(num_coordinates, num_identities * num_expressions)};
  for (int i = 0; i < num_identities; ++i) {
    for (int e = 0; e < num_expressions; ++e) {
      for (int k = 0; k < ku; ++k) {
        for (int l = 0; l < kv; ++l) {
          tensor.faces.col(i * num_expressions + e) += core.col(k * kv + l) * u(i, k) * v(e, l);
        }
      }
    }
  }
  return tensor;
}

double MaxError(const BilinearModel& model, const Tensor& tensor) {
  double worst = 0;
  for (int i = 0; i < tensor.num_identities; ++i) {
    for (int e = 0; e < tensor.num_expressions; ++e) {
      worst = std::max<double>(worst, (FittedFace(model, i, e) - tensor.face(i, e)).cwiseAbs().maxCoeff());
    }
  }
  return worst;
}

double SquaredError(const BilinearModel& model, const Tensor& tensor) {
  double sum = 0;
  for (int i = 0; i < tensor.num_identities; ++i) {
    for (int e = 0; e < tensor.num_expressions; ++e) {
      sum += (FittedFace(model, i, e) - tensor.face(i, e)).cast<double>().squaredNorm();
    }
  }
  return sum;
}

TEST(BilinearModel, ReconstructsByHand) {
  BilinearModel model;
  model.num_identity = model.num_expression = 2;
  model.core.resize(4, 3);
  model.core << 1, 0, 0,  //
      0, 2, 0,            //
      0, 0, 3,            //
      1, 1, 1;
  const Eigen::VectorXf face = Reconstruct(model, Eigen::Vector2f(2, 3), Eigen::Vector2f(5, 7));
  EXPECT_EQ(face, Eigen::Vector3f(10 + 21, 28 + 21, 45 + 21));
}

TEST(BilinearModel, FitRecoversABilinearTensorExactly) {
  const Tensor tensor = BilinearTensor(9, 7, 60, 4, 3, 1);
  EXPECT_LT(MaxError(tensor.Fit(4, 3), tensor), 1e-4 * tensor.faces.cwiseAbs().maxCoeff());
}

TEST(BilinearModel, FitAtFullRankRecoversAnyTensor) {
  const Tensor tensor = RandomTensor(6, 5, 45, 2);
  EXPECT_LT(MaxError(tensor.Fit(6, 5), tensor), 1e-4);
}

TEST(BilinearModel, FitEqualsTheSvdOfTheUnfoldings) {
  const Tensor tensor = RandomTensor(8, 5, 30, 3);
  Eigen::MatrixXd by_identity(8, 5 * 30), by_expression(5, 8 * 30);
  for (int i = 0; i < 8; ++i) {
    for (int e = 0; e < 5; ++e) {
      by_identity.row(i).segment(e * 30, 30) = tensor.face(i, e).transpose().cast<double>();
      by_expression.row(e).segment(i * 30, 30) = tensor.face(i, e).transpose().cast<double>();
    }
  }
  const Eigen::MatrixXd u = by_identity.jacobiSvd(Eigen::ComputeThinU).matrixU().leftCols(4);
  const Eigen::MatrixXd v = by_expression.jacobiSvd(Eigen::ComputeThinU).matrixU().leftCols(3);
  const BilinearModel model = tensor.Fit(4, 3);
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(std::abs(model.identity_factors.col(k).cast<double>().dot(u.col(k))), 1, 1e-5);
  for (int l = 0; l < 3; ++l)
    EXPECT_NEAR(std::abs(model.expression_factors.col(l).cast<double>().dot(v.col(l))), 1, 1e-5);
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 3; ++l) {
      Eigen::VectorXf expected = Eigen::VectorXf::Zero(30);
      for (int i = 0; i < 8; ++i) {
        for (int e = 0; e < 5; ++e) {
          expected += tensor.face(i, e) * model.identity_factors(i, k) * model.expression_factors(e, l);
        }
      }
      EXPECT_LT((model.core.row(k * 3 + l).transpose() - expected).norm(), 1e-3);
    }
  }
}

TEST(BilinearModel, ErrorDoesNotGrowWithTheRank) {
  const Tensor tensor = RandomTensor(10, 6, 60, 4);
  double last = std::numeric_limits<double>::infinity();
  for (const int rank : {1, 2, 4, 6}) {
    const double error = SquaredError(tensor.Fit(rank, rank), tensor);
    EXPECT_LE(error, last);
    EXPECT_LE(SquaredError(tensor.Fit(rank + 4, rank), tensor), error);
    last = error;
  }
}

TEST(BilinearModel, SmallComponentsSurviveALargeMeanFace) {
  // Two components of 1 and 0.001 on a mean of 10: the Gram matrix of the plain faces in float32 would lose the second.
  Rng rng(5);
  const int num_identities = 20, num_expressions = 3, size = 300;
  Tensor tensor{num_identities, num_expressions, size, Eigen::MatrixXf(size, num_identities * num_expressions)};
  const Eigen::VectorXf mean = RandomMatrix(size, 1, rng) * 10, strong = RandomMatrix(size, 1, rng);
  const Eigen::VectorXf weak = RandomMatrix(size, 1, rng) * 1e-3f;
  for (int i = 0; i < num_identities; ++i) {
    const float a = static_cast<float>(rng.Normal()), b = static_cast<float>(rng.Normal());
    for (int e = 0; e < num_expressions; ++e) tensor.faces.col(i * num_expressions + e) = mean + a * strong + b * weak;
  }
  EXPECT_LT(MaxError(tensor.Fit(3, 1), tensor), 1e-3);  // Without the second component: some 5e-3.
}

TEST(BilinearModel, LargestEntryOfAFactorColumnIsPositive) {
  const BilinearModel model = RandomTensor(7, 5, 30, 6).Fit(5, 4);
  for (const Eigen::MatrixXf& factors : {model.identity_factors, model.expression_factors}) {
    for (Eigen::Index k = 0; k < factors.cols(); ++k) {
      EXPECT_EQ(factors.col(k).maxCoeff(), factors.col(k).cwiseAbs().maxCoeff());
    }
  }
}

TEST(BilinearModel, HeldOutFacesOfAnAdditiveTensorAreImputedExactly) {
  Rng rng(7);
  Tensor tensor{6, 5, 30, Eigen::MatrixXf(30, 30)};
  const Eigen::MatrixXf a = RandomMatrix(30, 6, rng), b = RandomMatrix(30, 5, rng);
  for (int i = 0; i < 6; ++i) {
    for (int e = 0; e < 5; ++e) tensor.faces.col(i * 5 + e) = a.col(i) + b.col(e);
  }
  const BilinearModel complete = tensor.Fit(2, 2);
  tensor.held_out = {{0, 0}, {0, 1}, {0, 2}, {3, 1}, {4, 4}, {5, 0}};  // Not balanced: plain means would be wrong.
  EXPECT_LT(MaxError(tensor.Fit(6, 5), tensor), 1e-4);
  EXPECT_LT((tensor.Fit(2, 2).core - complete.core).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(BilinearModel, HeldOutFacesAreNotRead) {
  Tensor tensor = RandomTensor(6, 5, 30, 8);
  tensor.held_out = {{2, 3}, {4, 0}};
  const BilinearModel before = tensor.Fit(3, 3);
  tensor.faces.col(2 * 5 + 3).setConstant(1e6f);
  tensor.faces.col(4 * 5 + 0).setConstant(-1e6f);
  EXPECT_TRUE(tensor.Fit(3, 3).core == before.core);
}

TEST(BilinearModel, FitIsTheSameEveryTime) {
  const Tensor tensor = RandomTensor(12, 7, 9000, 9);  // Several blocks.
  const BilinearModel first = tensor.Fit(5, 4), second = tensor.Fit(5, 4);
  EXPECT_TRUE(first.core == second.core);
  EXPECT_TRUE(first.identity_factors == second.identity_factors);
}

TEST(BilinearModel, FitRefusesWhatCannotBeFitted) {
  Tensor tensor = RandomTensor(4, 3, 30, 10);
  ExpectError([&] { tensor.Fit(5, 3); }, "found 4 x 3");
  ExpectError([&] { tensor.Fit(4, 4); }, "found 4 x 3");
  const auto odd = [&](int i, int e) { return tensor.Read(i, e).first(i == 2 ? 29 : 30); };
  ExpectError([&] { FitBilinear(4, 3, 30, odd, {.num_identity = 2, .num_expression = 2}); },
              "identity 2, expression 0 has 29 coordinates, expected 30");
  tensor.held_out = {{1, 0}, {1, 1}, {1, 2}};
  ExpectError([&] { tensor.Fit(2, 2); }, "identity 1 has no face");
  tensor.held_out = {{0, 2}, {1, 2}, {2, 2}, {3, 2}};
  ExpectError([&] { tensor.Fit(2, 2); }, "expression 2 has no face");
}

TEST(BilinearModel, WrittenModelIsReadBack) {
  const TempDir directory;
  const BilinearModel model = RandomTensor(6, 5, 30, 11).Fit(4, 3);
  const std::string checksum = WriteBilinearModel(directory / "bilinear.safetensors", model);
  EXPECT_EQ(checksum, Sha256OfFile(directory / "bilinear.safetensors"));
  const BilinearModel read = ReadBilinearModel(directory / "bilinear.safetensors");
  EXPECT_EQ(read.num_identity, 4);
  EXPECT_EQ(read.num_expression, 3);
  EXPECT_TRUE(read.core == model.core);
  EXPECT_TRUE(read.identity_factors == model.identity_factors);
  EXPECT_TRUE(read.expression_factors == model.expression_factors);
}

TEST(BilinearModel, DamagedFilesAreRefused) {
  const TempDir directory;
  const auto file = directory / "bilinear.safetensors";
  WriteBilinearModel(file, RandomTensor(6, 5, 30, 12).Fit(4, 3));
  const std::string bytes = ReadFile(file);
  ExpectError([&] { ReadBilinearModel(directory / "absent.safetensors"); }, "absent.safetensors");
  WriteFileAtomically(file, bytes.substr(0, bytes.size() - 5));
  ExpectError([&] { ReadBilinearModel(file); }, "truncated");
  std::string newer = bytes;
  const std::string version = "\"format_version\":\"1\"";
  newer.replace(newer.find(version), version.size(), "\"format_version\":\"7\"");
  WriteFileAtomically(file, newer);
  ExpectError([&] { ReadBilinearModel(file); }, "format_version");
  BilinearModel odd = RandomTensor(6, 5, 30, 12).Fit(4, 3);
  odd.core.conservativeResize(11, 30);
  WriteBilinearModel(file, odd);
  ExpectError([&] { ReadBilinearModel(file); }, "11 rows");
}

TEST(BilinearModel, ACancelledTaskEndsTheFit) {
  const Tensor tensor = RandomTensor(6, 5, 30, 1);
  EXPECT_THROW(FitBilinear(
                   6, 5, 30, [&](int i, int e) { return tensor.Read(i, e); }, {.num_identity = 4, .num_expression = 3},
                   testing::CancelledTask()),
               Cancelled);
}

}  // namespace
}  // namespace daumier::faces
