#include "systems/deform/labelled_faces.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::testing {
namespace {

/// Ten persons, two levels, four expressions: 80 faces.
class LabelledFacesTest : public ::testing::Test {
 protected:
  LabelledFacesTest() { BuildSyntheticFaces(folder_ / "faces", 10); }

  Eigen::Index ColumnOf(const fitting::LabelledCodes& faces, const std::string& name) const {
    return std::find(faces.names.begin(), faces.names.end(), name) - faces.names.begin();
  }

  const TempDir folder_;
};

TEST_F(LabelledFacesTest, HaveControlsExpressionsAndTheClass) {
  const deform::OpenedModel opened = deform::OpenCodeModel(folder_ / "faces");
  const faces::FaceDatabase database(folder_ / "faces");
  const deform::LabelledDatabase labelled = deform::LabelledFaces(opened, database, 1000);
  const fitting::LabelledCodes& faces = labelled.faces;
  ASSERT_EQ(faces.codes.rows(), 80);
  EXPECT_EQ(faces.names.back(), deform::kCaricatureLabel);
  const Eigen::Index smile = ColumnOf(faces, "smile"), nose = ColumnOf(faces, "nose_width");
  ASSERT_LT(smile, faces.labels.cols());
  ASSERT_LT(nose, smile);
  for (int face = 0; face < 80; ++face) {
    const faces::FaceId id = database.id(face);
    EXPECT_EQ(faces.labels(face, faces.labels.cols() - 1), id.level > 0 ? 1 : 0);
    EXPECT_EQ(std::isfinite(faces.labels(face, nose)), id.expression == 0);
    if (id.expression == 0) EXPECT_EQ(faces.labels(face, smile), 0);
    if (id.expression == 2) EXPECT_EQ(faces.labels(face, smile), 1);
    if (id.expression == 1) EXPECT_TRUE(std::isnan(faces.labels(face, smile)));
  }
  // The codes are those of the faces, and their regular mean is near the mean of the regular faces.
  geometry::Points mean = geometry::Points::Zero(database.num_vertices(), 3);
  for (int person = 0; person < 10; ++person) mean += database.points(database.index({person, 0, 0})) / 10;
  EXPECT_LT((opened.model->Vertices(labelled.regular_mean) - mean).rowwise().norm().mean(), 0.02);
}

TEST_F(LabelledFacesTest, AControlIsZeroOnTheMeanRegularFace) {
  const faces::FaceDatabase database(folder_ / "faces");
  const deform::ControlLabels controls(database);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(std::ssize(controls.names()));
  for (int person = 0; person < 10; ++person) sum += controls.Of(database.points(database.index({person, 0, 0})));
  EXPECT_LT(sum.cwiseAbs().maxCoeff(), 1e-3);
}

TEST_F(LabelledFacesTest, AreReadFromAFile) {
  const deform::OpenedModel opened = deform::OpenCodeModel(folder_ / "faces");
  const faces::FaceDatabase database(folder_ / "faces");
  const auto file = folder_ / "labels.csv";
  WriteFileAtomically(file, "name,Smile,BigNose\r\nface-00003,1,\nperson-00002-level-1-neutral,0,-1\n\n");
  const fitting::LabelledCodes faces = deform::LabelledByFile(opened, database, file);
  EXPECT_EQ(faces.names, (std::vector<std::string>{"Smile", "BigNose"}));
  ASSERT_EQ(faces.labels.rows(), 2);
  EXPECT_EQ(faces.labels(0, 0), 1);
  EXPECT_TRUE(std::isnan(faces.labels(0, 1)));
  EXPECT_EQ(faces.labels(1, 1), -1);
  const auto expect = [&](const std::string& text, const std::string& part) {
    WriteFileAtomically(file, text);
    ExpectError([&] { deform::LabelledByFile(opened, database, file); }, part);
  };
  expect("", "labels.csv is empty");
  expect("name\n", "labels.csv:1: a header of 1 columns");
  expect("name,Smile\nface-00003\n", "labels.csv:2: 1 columns, expected 2");
  expect("name,Smile\nface-00003,yes\n", "labels.csv:2: cell 2 is 'yes', expected a number");
  expect("name,Smile\nface-99999,1\n", "labels.csv:2: ");
  expect("name,Smile\n", "has no faces below its header");
}

}  // namespace
}  // namespace daumier::testing
