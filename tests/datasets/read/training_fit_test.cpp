#include "datasets/read/training_fit.h"

#include "core/files.h"
#include "core/safetensors.h"
#include "faces/bilinear_projector.h"
#include "faces/curve_encoder.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

using testing::TempDir;

constexpr faces::BilinearOptions kRanks{.num_identity = 6, .num_expression = 3};

class TrainingFitTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 8);
    database_ = new faces::FaceDatabase(*folder_ / "faces");
  }
  static void TearDownTestSuite() {
    delete database_;
    delete folder_;
  }

  /// A copy of the database in which all but the given faces are ruined.
  static faces::FaceDatabase WithOnly(const std::vector<int>& kept) {
    const std::filesystem::path ruined = *folder_ / "ruined";
    std::filesystem::remove_all(ruined);
    std::filesystem::copy(*folder_ / "faces", ruined, std::filesystem::copy_options::recursive);
    const std::set<int> keep(kept.begin(), kept.end());
    const int per_person = database_->num_levels() * database_->num_expressions();
    for (int person = 0; person < database_->num_persons(); ++person) {
      std::vector<float> vertices;
      for (int face = person * per_person; face < (person + 1) * per_person; ++face) {
        const auto original = database_->vertices(face);
        if (keep.count(face) > 0) {
          vertices.insert(vertices.end(), original.begin(), original.end());
        } else {
          vertices.insert(vertices.end(), original.size(), 1e6f);
        }
      }
      SafetensorsWriter writer;
      writer.Add<float>(
          "vertices", {database_->num_levels(), database_->num_expressions(), database_->num_vertices(), 3}, vertices);
      writer.Write(ruined / faces::PersonShardName(person));
    }
    return faces::FaceDatabase(ruined, Checksums::kSkip);
  }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceDatabase* database_ = nullptr;
};

TEST_F(TrainingFitTest, OnlyTrainingFacesAreRead) {
  for (const std::string kind : {"person", "random"}) {
    const Split split = MakeSplit(*database_, {.kind = kind, .validation = 0.15, .test = 0.15}, 2);
    const FittedBilinear fitted = FitOnTraining(*database_, split, kRanks);
    const faces::FaceDatabase ruined = WithOnly(split.train);
    EXPECT_TRUE(FitOnTraining(ruined, split, kRanks).model.core == fitted.model.core) << kind;
  }
}

TEST_F(TrainingFitTest, ManifestsProveThatNoTestFaceWasUsed) {
  const Split split = MakeSplit(*database_, {.kind = "person", .validation = 0.15, .test = 0.15}, 2);
  const Json sides = SplitToJson(*database_, split), proof = FitOnTraining(*database_, split, kRanks).proof;
  EXPECT_EQ(proof.at("faces_checksum"), sides.at("train").at("faces_checksum"));
  EXPECT_EQ(proof.at("persons"), sides.at("train").at("persons"));
  EXPECT_EQ(proof.at("num_faces"), split.train.size());
  for (const int person : proof.at("persons").get<std::vector<int>>()) {
    for (const char* side : {"validation", "test"}) {
      const auto others = sides.at(side).at("persons").get<std::set<int>>();
      EXPECT_EQ(others.count(person), 0u);
    }
  }
}

TEST_F(TrainingFitTest, RowsAreTrainingPersonsTimesLevels) {
  const Split split = MakeSplit(*database_, {.kind = "person", .validation = 0.15, .test = 0.15}, 2);
  const FittedBilinear fitted = FitOnTraining(*database_, split, kRanks);
  ASSERT_EQ(fitted.identities.size(), size_t(fitted.model.identity_factors.rows()));
  EXPECT_EQ(fitted.identities.size(), 6u * 2);
  EXPECT_EQ(fitted.proof.at("num_identities"), 12);
  // A training face is close to what its factors reconstruct.
  const int row = 5, expression = 2, face = fitted.identities[row] * database_->num_expressions() + expression;
  const Eigen::VectorXf rebuilt = faces::Reconstruct(fitted.model, fitted.model.identity_factors.row(row),
                                                     fitted.model.expression_factors.row(expression));
  const auto truth = database_->vertices(face);
  EXPECT_LT((rebuilt - Eigen::Map<const Eigen::VectorXf>(truth.data(), rebuilt.size())).cwiseAbs().maxCoeff(), 0.5);
}

class CurveFitTest : public TrainingFitTest {
 protected:
  CurveFitTest() { testing::BuildSyntheticSketches(*folder_ / "faces", sketches_folder_ / "sketches"); }

  static double MeanPointError(const faces::CurveEncoder& encoder, const SketchDatabase& sketches,
                               const std::vector<int>& faces) {
    double sum = 0;
    int count = 0;
    for (const int face : faces) {
      const std::vector<float> points = PointsOf(sketches.strokes(face), sketches.feature_curves());
      const Eigen::VectorXf rebuilt = encoder.Encode(points, std::vector<float>(points.size() / 2, 1.0f)).points;
      for (size_t k = 0; k < points.size(); k += 2, ++count)
        sum += std::hypot(rebuilt[Eigen::Index(k)] - points[k], rebuilt[Eigen::Index(k) + 1] - points[k + 1]);
    }
    return sum / count;
  }

  TempDir sketches_folder_;
};

TEST_F(CurveFitTest, AnEncodingRebuildsThePointsOfUnseenPersons) {
  const SketchDatabase sketches(sketches_folder_ / "sketches");
  const Split split = MakeSplit(*database_, {.kind = "person", .validation = 0.15, .test = 0.15}, 2);
  const FittedBilinear fitted = FitCurvesOnTraining(*database_, sketches, split, kRanks);
  const faces::CurveEncoder encoder(fitted.model);
  EXPECT_LT(MeanPointError(encoder, sketches, split.train), 0.5) << "pixels";
  EXPECT_LT(MeanPointError(encoder, sketches, split.test), 1.5) << "pixels";
  EXPECT_EQ(fitted.proof.at("persons"), SplitToJson(*database_, split).at("train").at("persons"));
}

TEST_F(TrainingFitTest, BasisHoldsTrainingFacesBetterThanTheBilinearModelAndReadsNoOther) {
  const Split split = MakeSplit(*database_, {}, 3);
  const auto bilinear = FitOnTraining(*database_, split, kRanks).model;
  const auto basis = FitBasisOnTraining(*database_, split, bilinear, 12, 1);
  ASSERT_EQ(basis.size(), 12);
  EXPECT_GT(basis.deviation.maxCoeff(), 0);
  double bilinear_error = 0, basis_error = 0;
  const faces::BilinearProjector projector(bilinear);
  for (const int face : split.train) {
    const auto vertices = database_->vertices(face);
    const Eigen::Map<const Eigen::VectorXf> truth(vertices.data(), Eigen::Index(vertices.size()));
    bilinear_error += (projector.Project(vertices).vertices - truth).squaredNorm();
    basis_error += (basis.rows.transpose() * (basis.rows * truth) - truth).squaredNorm();
  }
  EXPECT_LT(basis_error, bilinear_error);
  const auto ruined = FitBasisOnTraining(WithOnly(split.train), split, bilinear, 12, 1);
  EXPECT_EQ(ruined.rows, basis.rows);
  EXPECT_EQ(ruined.deviation, basis.deviation);
}

TEST_F(TrainingFitTest, TheGaussianIsThatOfTrainingFacesAndReadsNoOther) {
  const Split split = MakeSplit(*database_, {}, 3);
  const faces::FaceGaussianOptions options{.num_symmetric = 12, .num_asymmetric = 4};
  const faces::FaceGaussian gaussian = FitGaussianOnTraining(*database_, split, options);
  EXPECT_EQ(gaussian.num_coordinates(), 3 * database_->num_vertices());
  EXPECT_LE(gaussian.size(), 16);
  double distance = 0, of_mean = 0;
  for (const int face : split.train) {
    const auto vertices = database_->vertices(face);
    const Eigen::Map<const Eigen::VectorXf> truth(vertices.data(), Eigen::Index(vertices.size()));
    const Eigen::VectorXf rebuilt = faces::Reconstruct(gaussian, faces::CoefficientsOf(gaussian, vertices));
    distance += (rebuilt - truth).squaredNorm();
    of_mean += (gaussian.mean - truth).squaredNorm();
  }
  EXPECT_LT(distance, 0.1 * of_mean);
  const faces::FaceGaussian ruined = FitGaussianOnTraining(WithOnly(split.train), split, options);
  EXPECT_EQ(ruined.mean, gaussian.mean);
  EXPECT_TRUE(ruined.rows == gaussian.rows);
}

TEST_F(CurveFitTest, ACancelledTaskEndsEachFit) {
  const SketchDatabase sketches(sketches_folder_ / "sketches");
  const Split split = MakeSplit(*database_, {}, 3);
  const FittedBilinear fitted = FitOnTraining(*database_, split, kRanks);
  const Task cancelled = testing::CancelledTask();
  EXPECT_THROW(FitOnTraining(*database_, split, kRanks, cancelled), Cancelled);
  EXPECT_THROW(FitCurvesOnTraining(*database_, sketches, split, kRanks, cancelled), Cancelled);
  EXPECT_THROW(FitBasisOnTraining(*database_, split, fitted.model, 3, 1, cancelled), Cancelled);
  EXPECT_THROW(FitGaussianOnTraining(*database_, split, {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace daumier::datasets
