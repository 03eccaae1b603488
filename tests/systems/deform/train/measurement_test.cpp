#include "systems/deform/train/measurement.h"

#include "faces/model_frame.h"
#include "geometry/self_intersections.h"
#include "tensor/eigen.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_deform.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

class DeformMeasurementTest : public ::testing::Test {
 protected:
  torch::Tensor Template() const {
    const geometry::Points points = faces::HeadFrame(face_, 2.1).FromCm(face_.neutral);
    return tensor::CopyToTensor(points).to(torch::kFloat32);
  }
  /// Faces in pairs of one person.
  MeasuredFaces FacesOf(const torch::Tensor& vertices) const {
    MeasuredFaces faces{vertices, face_.triangles, {}, {}};
    for (int i = 0; i < int(vertices.size(0)); ++i) faces.faces.push_back(10 + i), faces.groups.push_back(i / 2);
    return faces;
  }
  MeasuredFaces Moved(int64_t count) const {
    return FacesOf((Template() + torch::tensor({0.1f, 0.0f, 0.0f})).unsqueeze(0).expand({count, -1, -1}).contiguous());
  }
  DeformBaselines Baselines() const {
    torch::manual_seed(6);
    const torch::Tensor faces = Template() + 0.02 * torch::randn({6, 1, 3}) + 0.001 * torch::randn({6, 1, 1});
    return {faces + 0.001 * torch::randn_like(faces), faces.slice(0, 0, 2), 4};
  }

  const faces::FaceTemplate face_ = testing::SyntheticFace();
  const std::shared_ptr<DeformNetwork> network_ = testing::SmoothDeformNetwork("hypernetwork", Template());
  const CodeFitOptions fit_{.data_weight = 3e3, .code_weight = 1e-2};
};

TEST_F(DeformMeasurementTest, AMovedTemplateIsMeasuredAsWorkedOutByHand) {
  DeformMeasurement measurement(*network_, Moved(2), 1, {.mm = 110, .head_height = 2});
  measurement.MeasureTemplate();
  measurement.MeasureBaselines(Baselines());
  const reports::MetricTable& table = measurement.table();
  ASSERT_EQ(table.rows.size(), 4u);
  const reports::MetricRow& row = table.rows[0];
  const auto value = [&](const char* key) { return reports::ValueOf(table, row, key); };
  EXPECT_EQ(row.name, kTemplate);
  EXPECT_TRUE(row.baseline);
  EXPECT_EQ(value("num_faces"), 2);
  EXPECT_NEAR(row.error().mean, 0.1, 1e-6);
  EXPECT_NEAR(*value("p95"), 0.1, 1e-6);
  EXPECT_NEAR(*value("surface_sample_error"), 0.1, 1e-6);
  EXPECT_NEAR(*value("error_mm"), 11, 1e-4);
  EXPECT_NEAR(*value("percent_of_head_height"), 5, 1e-4);
  EXPECT_NEAR(*value("normal_error_degrees"), 0, 1e-2);
  EXPECT_EQ(value("flipped_triangles"), 0);
  EXPECT_EQ(value("self_intersections"), measurement.true_self_intersections());
  EXPECT_EQ(value("seconds"), std::nullopt);
}

TEST_F(DeformMeasurementTest, SurfacesOfTheNetworkAreFound) {
  torch::manual_seed(8);
  const torch::Tensor codes = 0.1 * torch::randn({3, 8});
  torch::Tensor vertices;
  {
    const torch::NoGradGuard no_gradient;
    vertices = network_->DeformVertices(codes);
  }
  DeformMeasurement measurement(*network_, FacesOf(vertices), 1);
  measurement.MeasureNetwork("network", fit_, 3);
  const reports::MetricRow& result = measurement.result();
  const auto value = [&](const char* key) { return *reports::ValueOf(measurement.table(), result, key); };
  EXPECT_LT(result.error().mean, 1e-3);
  EXPECT_LT(value("normal_error_degrees"), 1);
  EXPECT_GT(value("seconds"), 0);
  EXPECT_FALSE(result.baseline);
  EXPECT_LT((measurement.codes() - codes).abs().max().item<double>(), 0.02);
  ASSERT_EQ(result.face_errors.size(), 3u);
  EXPECT_NEAR(Mean(result.face_errors), result.error().mean, 1e-9);
  EXPECT_NEAR(measurement.mean_error_map().mean().item<double>(), result.error().mean, 1e-6);
  EXPECT_NEAR((measurement.Predicted(1) - vertices[1]).norm(2, {1}).mean().item<double>(), result.face_errors[1], 1e-6);
  // Points between the vertices are where the network takes them, not where the mesh has them.
  EXPECT_LT(value("surface_sample_error"), 0.05);
  EXPECT_NE(value("surface_sample_error"), result.error().mean);
}

TEST_F(DeformMeasurementTest, TheFirstRowOfAllFacesIsTheResult) {
  DeformMeasurement measurement(*network_, Moved(3), 1);
  measurement.MeasureNetwork("two", fit_, 2);
  testing::ExpectError([&] { measurement.result(); }, "was not measured on all 3");
  measurement.MeasureNetwork("all", fit_, 3);
  measurement.MeasureNetwork("again", fit_, 3);
  EXPECT_EQ(measurement.result().name, "all");
  EXPECT_EQ(measurement.table().result, 1u);
  EXPECT_EQ(reports::ValueOf(measurement.table(), measurement.table().rows[0], "num_faces"), 2);
  testing::ExpectError([&] { measurement.MeasureNetwork("more", fit_, 4); }, "4 of 3");
}

TEST_F(DeformMeasurementTest, FacesAreMeasuredAtTheSamePointsEachTime) {
  torch::manual_seed(2);
  const MeasuredFaces faces = FacesOf(Template() + 0.05 * torch::randn({1, face_.num_vertices(), 3}));
  std::vector<double> errors;
  for (const uint64_t seed : {1, 2}) {
    DeformMeasurement measurement(*network_, faces, seed);
    measurement.MeasureTemplate();
    errors.push_back(*reports::ValueOf(measurement.table(), measurement.table().rows[0], "surface_sample_error"));
  }
  EXPECT_EQ(errors[0], errors[1]);
  EXPECT_GT(errors[0], 0.01);
}

TEST_F(DeformMeasurementTest, SelfIntersectionsAreCountedOnSixteenFaces) {
  torch::Tensor vertices = Template().unsqueeze(0).repeat({17, 1, 1});
  vertices[16].add_(0.3 * torch::randn_like(vertices[16]));  // A heap of triangles.
  DeformMeasurement measurement(*network_, FacesOf(vertices), 1);
  const geometry::Points points = tensor::CopyToMatrix<double>(Template());
  const double clean = double(geometry::SelfIntersections({points, face_.triangles}).size());
  EXPECT_EQ(measurement.true_self_intersections(), clean);
  measurement.MeasureTemplate();
  EXPECT_EQ(reports::ValueOf(measurement.table(), measurement.table().rows[0], "self_intersections"), clean);
}

TEST_F(DeformMeasurementTest, ReportsFacesAndOfAdamTheStepsOfAllFaces) {
  std::vector<std::string> reports;
  const Task task({}, [&](const TaskProgress& report) {
    reports.push_back(fmt::format("{} {}/{} {}", report.stage, report.done, report.total, report.unit));
  });
  DeformMeasurement measurement(*network_, Moved(2), 1, {}, task);
  measurement.MeasureNetwork("network", fit_, 2);
  EXPECT_EQ(reports, (std::vector<std::string>{"network 0/2 faces", "network 1/2 faces", "network 2/2 faces"}));
  reports.clear();
  CodeFitOptions adam = fit_;
  adam.solve.method = "adam";
  adam.solve.adam_steps = 2;
  measurement.MeasureNetwork("adam", adam, 2);
  EXPECT_EQ(reports, (std::vector<std::string>{"adam 0/4 steps", "adam 1/4 steps", "adam 2/4 steps", "adam 3/4 steps",
                                               "adam 4/4 steps"}));
}

TEST_F(DeformMeasurementTest, StopsIfItsTaskIsCancelled) {
  std::stop_source stop;
  DeformMeasurement measurement(*network_, Moved(2), 1, {}, Task(stop.get_token()));
  stop.request_stop();
  EXPECT_THROW(measurement.MeasureNetwork("network", fit_, 2), Cancelled);
}

TEST_F(DeformMeasurementTest, RefusesFacesThatDoNotFit) {
  testing::ExpectError([&] { DeformMeasurement(*network_, FacesOf(torch::zeros({0, 5, 3})), 1); }, "0 faces");
  testing::ExpectError([&] { DeformMeasurement(*network_, FacesOf(torch::zeros({2, 5, 3})), 1); }, "(2, 5, 3)");
}

}  // namespace
}  // namespace daumier::deform
