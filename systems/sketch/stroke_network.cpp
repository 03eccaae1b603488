#include "systems/sketch/stroke_network.h"

#include "fitting/curve_recovery.h"
#include "render/draw.h"
#include "render/stroke_samples.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

constexpr int kShapeRounds = 2;

Eigen::VectorXf MeanShape(const faces::BilinearModel& curves) {
  const faces::CoefficientPrior prior = faces::PriorOf(curves);
  return faces::CurveCode{.u = prior.u_mean, .v = prior.v_mean, .points = {}}.numbers();
}

template <class Numbers>
void SetRow(FloatArray& array, size_t row, const Numbers& numbers) {
  std::copy(numbers.begin(), numbers.end(), array.row(int64_t(row)));
}

}  // namespace

std::vector<float> InkOf(const std::vector<render::Stroke>& strokes, int resolution) {
  const render::Image image = render::RasteriseStrokes(strokes, resolution);
  std::vector<float> ink(image.pixels.size());
  std::ranges::transform(image.pixels, ink.begin(), [](uint8_t grey) { return float(255 - grey) / 255.0f; });
  return ink;
}

StrokeNetwork::StrokeNetwork(const SketchRunFolder& run, std::shared_ptr<const runtime::NetworkRunner> network)
    : run_(run),
      network_(std::move(network)),
      curves_(fitting::SeeCurves(run.face_template, run.feature_curves, run.camera)) {}

std::vector<fitting::PredictedFace> StrokeNetwork::Predict(
    const std::vector<std::vector<render::Stroke>>& sketches) const {
  if (sketches.empty()) return {};
  const SketchNetworkOptions& options = run_.network_options;
  const auto count = int64_t(sketches.size());
  NamedArrays input;
  if (options.reads_image()) {
    FloatArray& images = input["sketch"] = FloatArray({count, 1, options.resolution, options.resolution});
    for (size_t i = 0; i < sketches.size(); ++i) SetRow(images, i, InkOf(sketches[i], options.resolution));
  }
  if (options.reads_points()) {
    FloatArray& points = input["points"] = FloatArray({count, 4, options.num_points});
    for (size_t i = 0; i < sketches.size(); ++i) SetRow(points, i, render::SampleRows(sketches[i], options.num_points));
  }
  if (!options.reads_shape()) return Forward(input);

  const faces::CurveEncoder encoder(run_.models.curves);
  const Eigen::VectorXf mean = MeanShape(run_.models.curves);
  FloatArray& shape = input["shape"] = FloatArray({count, mean.size()});
  for (size_t i = 0; i < sketches.size(); ++i) SetRow(shape, i, mean);
  std::vector<fitting::PredictedFace> faces = Forward(input);
  for (int round = 0; round < kShapeRounds; ++round) {
    for (size_t i = 0; i < sketches.size(); ++i) {
      const auto projected = fitting::Project(curves_, faces[i].vertices);
      SetRow(shape, i, fitting::RecoverCurves(encoder, curves_.offsets, projected, sketches[i]).numbers());
    }
    faces = Forward(input);
  }
  return faces;
}

std::vector<fitting::PredictedFace> StrokeNetwork::Forward(const NamedArrays& input) const {
  const NamedArrays output = network_->Run(input);
  const FloatArray &u = output.at("u"), &v = output.at("v"), &vertices = output.at("vertices");
  const auto row = [](const FloatArray& array, int64_t i) {
    return Eigen::VectorXf(Eigen::Map<const Eigen::VectorXf>(array.row(i), array.row_size()));
  };
  std::vector<fitting::PredictedFace> faces;
  for (int64_t i = 0; i < u.shape[0]; ++i)
    faces.push_back({row(u, i), row(v, i), {vertices.row(i), vertices.row(i) + vertices.row_size()}});
  return faces;
}

std::vector<render::Stroke> StrokeNetwork::CurvesOf(const fitting::PredictedFace& face) const {
  return fitting::SeenStrokes(curves_, face.vertices);
}

}  // namespace daumier::sketch
