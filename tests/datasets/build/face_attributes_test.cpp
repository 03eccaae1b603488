#include "datasets/build/face_attributes.h"

#include "datasets/build/interpolation.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

using testing::TempDir;

double Attribute(const faces::FaceTemplate& face_template, const geometry::Points& face, const std::string& name) {
  const std::vector<std::string> names = MeasuredAttributeNames();
  const auto found = std::ranges::find(names, name);
  EXPECT_NE(found, names.end()) << name;
  return MeasureAttributes(face_template, face)[found - names.begin()];
}

class MeasureAttributesTest : public ::testing::Test {
 protected:
  /// How much an attribute grows when some landmarks of the neutral face are moved by an offset in cm.
  double Growth(const std::string& name, const std::vector<int>& landmarks, const Eigen::RowVector3d& offset) const {
    geometry::Points moved = face_.neutral;
    for (const int landmark : landmarks) moved.row(face_.annotation.landmarks[landmark]) += offset;
    return Attribute(face_, moved, name) - Attribute(face_, face_.neutral, name);
  }
  double EyeDistance() const {
    const auto& landmarks = face_.annotation.landmarks;
    return (face_.neutral.row(landmarks[36]) - face_.neutral.row(landmarks[45])).norm();
  }
  double Height() const {
    return face_.neutral(face_.annotation.hairline_vertex, 1) - face_.neutral(face_.annotation.landmarks[8], 1);
  }

  const faces::FaceTemplate face_ = testing::SyntheticFace();
};

TEST_F(MeasureAttributesTest, SmileGrowsWithCornersThatGoUpAndOut) {
  EXPECT_NEAR(Growth("smile", {48, 54}, {0, 0.5, 0}), 0.5 / EyeDistance(), 1e-6);
  EXPECT_GT(Growth("smile", {54}, {0.5, 0, 0}), 0.01);
  EXPECT_GT(Growth("smile", {48}, {-0.5, 0, 0}), 0.01);
  EXPECT_NEAR(Growth("smile", {62, 66}, {0, 0.5, 0}), -0.5 / EyeDistance(), 1e-6);
}

TEST_F(MeasureAttributesTest, MouthOpenIsTheWayBetweenTheLips) {
  EXPECT_NEAR(Growth("mouth_open", {62, 66}, {0, -1, 0}), 0, 1e-6);
  EXPECT_NEAR(Growth("mouth_open", {66}, {0, -1, 0}), 1 / EyeDistance(), 1e-6);
  EXPECT_LT(Growth("mouth_open", {66}, {0, 4, 0}) + Attribute(face_, face_.neutral, "mouth_open"), 0);
}

TEST_F(MeasureAttributesTest, NoseSizeGrowsWithLengthWidthAndDepth) {
  EXPECT_GT(Growth("nose_size", {27}, {0, 1, 0}), 0.02);
  EXPECT_GT(Growth("nose_size", {35}, {1, 0, 0}), 0.02);
  EXPECT_NEAR(Growth("nose_size", {30}, {0, 0, 1}), 1 / EyeDistance() / 3, 1e-6);
}

TEST_F(MeasureAttributesTest, ForeheadAndChinAreSharesOfTheHeight) {
  const std::vector<int> brows = {17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  EXPECT_NEAR(Growth("forehead", brows, {0, -1, 0}), 1 / Height(), 1e-6);
  EXPECT_NEAR(Growth("chin", {57}, {0, 1, 0}), 1 / Height(), 1e-6);
  EXPECT_GT(Growth("face_width", {0}, {-1, 0, 0}), 0.5 / Height());
}

TEST_F(MeasureAttributesTest, SizeAndPlaceChangeNothing) {
  const geometry::Points moved = (3.7 * face_.neutral).rowwise() + Eigen::RowVector3d(5, -60, 11);
  EXPECT_LT((MeasureAttributes(face_, moved) - MeasureAttributes(face_, face_.neutral)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(MeasureAttributesTest, FacesWithoutSizeAreRefused) {
  testing::ExpectError([&] { MeasureAttributes(face_, 0 * face_.neutral); }, "0 cm apart");
}

class FaceAttributesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    FacesOptions options = testing::SyntheticFacesOptions(2);
    options.num_interpolated = 6;
    options.family_size = 2;
    BuildFaces(testing::SyntheticModel(), options, *folder_ / "faces");
    database_ = new faces::FaceDatabase(*folder_ / "faces");
    table_ = new AttributeTable(FaceAttributes(*database_));
  }
  static void TearDownTestSuite() {
    delete table_;
    delete database_;
    delete folder_;
  }
  static float At(int face, const std::string& name) {
    const auto found = std::ranges::find(table_->names, name);
    EXPECT_NE(found, table_->names.end()) << name;
    return table_->values(face, found - table_->names.begin());
  }
  static int Face(int person, int level, const std::string& expression) {
    const auto& names = database_->expression_names();
    return database_->index({person, level, int(std::ranges::find(names, expression) - names.begin())});
  }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceDatabase* database_ = nullptr;
  static inline AttributeTable* table_ = nullptr;
};

TEST_F(FaceAttributesTest, AreMeasuredOnEveryFace) {
  ASSERT_EQ(table_->values.rows(), database_->num_faces());
  EXPECT_EQ(table_->names, FaceAttributeNames(*database_));
  for (const int face : {0, 5, database_->num_faces() - 1}) {
    const Eigen::RowVectorXf expected = MeasureAttributes(database_->face_template(), database_->points(face));
    EXPECT_EQ(table_->values.row(face).head(expected.size()), expected);
  }
  for (int person = 0; person < 2; ++person) {
    EXPECT_GT(At(Face(person, 0, "smile"), "smile"), At(Face(person, 0, "neutral"), "smile"));
    EXPECT_GT(At(Face(person, 0, "jaw_open"), "mouth_open"), At(Face(person, 0, "neutral"), "mouth_open"));
  }
}

TEST_F(FaceAttributesTest, ExaggerationIsTheMeanDistanceFromTheRegularFace) {
  for (int expression = 0; expression < database_->num_expressions(); ++expression) {
    const int regular = database_->index({1, 0, expression}), caricature = database_->index({1, 1, expression});
    EXPECT_EQ(At(regular, "exaggeration"), 0);
    EXPECT_EQ(At(regular, "caricature"), 0);
    EXPECT_EQ(At(caricature, "caricature"), 1);
    const geometry::Points a = database_->points(regular), b = database_->points(caricature);
    const auto& annotation = database_->face_template().annotation;
    double sum = 0;
    for (const int v : annotation.regions.at("face")) sum += (a.row(v) - b.row(v)).norm();
    const double height = b(annotation.hairline_vertex, 1) - b(annotation.landmarks[8], 1);
    EXPECT_NEAR(At(caricature, "exaggeration"), sum / double(annotation.regions.at("face").size()) / height, 1e-6);
    EXPECT_GT(At(caricature, "exaggeration"), 1e-3);
  }
}

TEST_F(FaceAttributesTest, SlidersAreThePersons) {
  const auto weights = database_->identity_weights(1);
  ASSERT_GT(weights.size(), 1u);
  EXPECT_EQ(At(Face(1, 1, "laugh"), "shape_0"), weights[0]);
  EXPECT_EQ(At(Face(1, 0, "smile"), "shape_1"), weights[1]);
}

TEST_F(FaceAttributesTest, InterpolatedFacesAreMixedLikeTheirParents) {
  int num_caricatures = 0;
  for (int face = database_->num_grid_faces(); face < database_->num_faces(); ++face) {
    const Interpolation origin = ReadInterpolation(*database_, face);
    const float s = origin.identity_share;
    const auto a = database_->identity_weights(origin.a.person), b = database_->identity_weights(origin.b.person);
    EXPECT_NEAR(At(face, "shape_0"), (1 - s) * a[0] + s * b[0], 1e-5);
    const float exaggerated = (1 - s) * float(origin.a.level) + s * float(origin.b.level);
    EXPECT_EQ(At(face, "caricature"), exaggerated >= 0.5f ? 1 : 0);
    if (origin.a.level + origin.b.level == 0) {
      EXPECT_EQ(At(face, "exaggeration"), 0);
    } else {
      EXPECT_GT(At(face, "exaggeration"), 0);
    }
    num_caricatures += origin.a.level + origin.b.level > 0;
  }
  EXPECT_GT(num_caricatures, 0);
}

}  // namespace
}  // namespace daumier::datasets
