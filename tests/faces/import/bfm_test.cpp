#include "faces/import/bfm.h"

#include "geometry/triangulate.h"
#include "tests/faces/import/foreign_face.h"
#include "tests/faces/import/foreign_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::BytesOf;
using testing::ExpectError;
using testing::ForeignMesh;
using testing::MatVariable;

std::vector<float> FloatsOf(const geometry::Points& points) {
  return {points.data(), points.data() + points.size()};
}

/// The small head in a Basel file: two identity modes with the standard deviations 2 and 3; mode s is 1 in entry s.
class BfmTest : public ::testing::Test {
 protected:
  const geometry::Triangles triangles_ = geometry::Triangulate(ForeignMesh());
  const int num_coordinates_ = static_cast<int>(ForeignMesh().vertices.size());
  const int num_triangles_ = static_cast<int>(triangles_.rows());

  /// 2009: column by column, triangles from 1 and clockwise, micrometres.
  std::string File2009() const {
    std::vector<float> basis(2 * num_coordinates_);
    basis[0] = basis[num_coordinates_ + 1] = 1;
    std::vector<double> corners;
    for (const int k : {0, 2, 1}) {
      for (int t = 0; t < num_triangles_; ++t) corners.push_back(triangles_(t, k) + 1);
    }
    return MatVariable("shapeMU", {num_coordinates_, 1}, 7, BytesOf(FloatsOf(ForeignMesh(0, 1e-4).vertices)), 7) +
           testing::MatCompressed(MatVariable("shapePC", {num_coordinates_, 2}, 7, BytesOf(basis), 7)) +
           MatVariable("shapeEV", {2, 1}, 9, BytesOf<double>({2e4, 3e4})) +
           MatVariable("texMU", {1, 1}, 9, BytesOf(0.0)) + MatVariable("tl", {num_triangles_, 3}, 9, BytesOf(corners));
  }

  /// 2017: row-major, triangles 3 x F from 0, millimetres, variances; one expression mode.
  void Write2017(const std::filesystem::path& path) const {
    const auto rows = static_cast<hsize_t>(num_coordinates_);
    testing::Hdf5Writer writer(path);
    writer.Add("shape/model/mean", {rows}, FloatsOf(ForeignMesh(0, 0.1).vertices));
    std::vector<float> basis(2 * rows);
    basis[0] = basis[3] = 1;
    writer.Add("shape/model/pcaBasis", {rows, 2}, basis);
    writer.Add("shape/model/pcaVariance", {2}, std::vector<float>{400, 900});
    std::vector<float> mean(rows), mode(rows);
    mean[2] = 10;
    mode[4] = 1;
    writer.Add("expression/model/mean", {rows}, mean);
    writer.Add("expression/model/pcaBasis", {rows, 1}, mode);
    writer.Add("expression/model/pcaVariance", {1}, std::vector<float>{2500});
    std::vector<int> cells;
    for (int k = 0; k < 3; ++k) {
      for (int t = 0; t < num_triangles_; ++t) cells.push_back(triangles_(t, k));
    }
    writer.Add("shape/representer/cells", {3, static_cast<hsize_t>(num_triangles_)}, cells);
  }

  void ExpectTheSmallHead(const FaceModel& model) const {
    EXPECT_LT((model.face_template.neutral - ForeignMesh().vertices).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_EQ(testing::LowestFirst(model.face_template.triangles), testing::LowestFirst(triangles_));
    ASSERT_EQ(model.identity_shapes.cols(), 2);
    EXPECT_NEAR(model.identity_shapes(0, 0), 2, 1e-5);
    EXPECT_NEAR(model.identity_shapes(1, 1), 3, 1e-5);
    EXPECT_NEAR(model.identity_shapes.norm(), std::sqrt(13.0), 1e-5);
    EXPECT_NE(model.face_template.provenance.at("licence").get<std::string>().find("Basel"), std::string::npos);
  }

  testing::TempDir folder_;
};

TEST_F(BfmTest, Of2009IsReadFromMatlab) {
  WriteFileAtomically(folder_ / "01_MorphableModel.mat", testing::MatFile(File2009()));
  const FaceModel model = LoadBfm(folder_ / "01_MorphableModel.mat", testing::ForeignAnnotation());
  ExpectTheSmallHead(model);
  ASSERT_EQ(model.expressions.size(), 1u);
  EXPECT_EQ(model.expressions[0].name, "neutral");
  EXPECT_EQ(model.face_template.provenance.at("version"), "2009");
}

TEST_F(BfmTest, Of2017IsReadFromHdf5) {
  Write2017(folder_ / "model2017-1_bfm_nomouth.h5");
  const FaceModel model = LoadBfm(folder_ / "model2017-1_bfm_nomouth.h5", testing::ForeignAnnotation());
  ExpectTheSmallHead(model);
  ASSERT_EQ(model.expressions.size(), 3u);
  EXPECT_EQ(model.expressions[1].name, "mode_00_plus");
  // The mean expression, 10 mm, and two standard deviations of the mode, 100 mm.
  const Eigen::VectorXf offset = ExpressionOffset(model, model.expressions[1].weights);
  EXPECT_NEAR(offset[2], 1, 1e-5);
  EXPECT_NEAR(offset[4], 10, 1e-5);
}

TEST_F(BfmTest, WhatDoesNotFitIsRefused) {
  const auto path = folder_ / "model.mat";
  ExpectError([&] { LoadBfm(path, testing::ForeignAnnotation()); }, "does not exist");
  const auto refused = [&](const std::string& variables, const std::string& part) {
    WriteFileAtomically(path, testing::MatFile(variables));
    ExpectError([&] { LoadBfm(path, testing::ForeignAnnotation()); }, part);
  };
  refused(File2009().substr(0, 9000), "truncated");
  refused("", "model.mat: has no variable shapeEV (found the variables none; expected shapeEV, shapeMU, shapePC, tl)");
  // Of two variables of one name the last counts.
  refused(File2009() + MatVariable("shapeEV", {3, 1}, 9, BytesOf<double>({1, 2, 3})), "shapeEV has the shape (3, 1)");
  refused(File2009() + MatVariable("shapePC", {2, 1}, 9, BytesOf<double>({1, 2})), "shapePC has the shape (2, 1)");
  refused(File2009() + MatVariable("tl", {1, 3}, 9, BytesOf<double>({0, 1, 2})), "corner 0, expected");
  refused(File2009() + MatVariable("tl", {1, 4}, 9, BytesOf<double>({1, 2, 3, 4})), "tl is not F x 3");
  const auto as_hdf5 = folder_ / "model2019.h5";
  WriteFileAtomically(as_hdf5, "");
  ExpectError([&] { LoadBfm(as_hdf5, testing::ForeignAnnotation()); }, "model2019.h5 is empty. Copy or download it");
  WriteFileAtomically(as_hdf5, "<html>");
  ExpectError([&] { LoadBfm(as_hdf5, testing::ForeignAnnotation()); }, "cannot be opened as an HDF5 file");
}

}  // namespace
}  // namespace daumier::faces
