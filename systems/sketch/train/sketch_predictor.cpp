#include "systems/sketch/train/sketch_predictor.h"

#include "fitting/curve_recovery.h"
#include "render/draw.h"
#include "render/stroke_samples.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

constexpr int kShapeRounds = 2;

/// (1, 4, P), as datasets::SketchBatch has them.
torch::Tensor PointTensor(const std::vector<render::Stroke>& strokes, int num_points) {
  return torch::tensor(render::SampleRows(strokes, num_points)).view({1, 4, num_points});
}

Eigen::VectorXf MeanShape(const faces::BilinearModel& curves) {
  const faces::CoefficientPrior prior = faces::PriorOf(curves);
  return faces::CurveCode{.u = prior.u_mean, .v = prior.v_mean, .points = {}}.numbers();
}

}  // namespace

torch::Tensor SketchTensor(const std::vector<render::Stroke>& strokes, int resolution) {
  const render::Image image = render::RasteriseStrokes(strokes, resolution);
  std::vector<float> ink(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), ink.begin(),
                 [](uint8_t grey) { return static_cast<float>(255 - grey) / 255.0f; });
  return torch::tensor(ink).view({1, 1, resolution, resolution});
}

SketchPredictor::SketchPredictor(const std::filesystem::path& run_directory)
    : run_(LoadSketchRun(run_directory)),
      curves_(fitting::SeeCurves(run_.face_template, run_.feature_curves, run_.camera)) {}

std::vector<fitting::PredictedFace> SketchPredictor::Predict(const std::vector<std::vector<render::Stroke>>& sketches) {
  if (sketches.empty()) return {};
  const SketchNetworkOptions& options = run_.network->options();
  std::vector<torch::Tensor> images, points;
  for (const auto& strokes : sketches) {
    if (options.reads_image()) images.push_back(SketchTensor(strokes, options.resolution));
    if (options.reads_points()) points.push_back(PointTensor(strokes, options.num_points));
  }
  SketchInput input;
  if (!images.empty()) input.images = torch::cat(images);
  if (!points.empty()) input.points = torch::cat(points);
  if (!options.reads_shape()) return Answer(input);

  const faces::CurveEncoder encoder(run_.models.curves);
  Eigen::MatrixXf shape = MeanShape(run_.models.curves).transpose().replicate(Eigen::Index(sketches.size()), 1);
  input.shape = tensor::CopyToTensor(shape);
  std::vector<fitting::PredictedFace> faces = Answer(input);
  for (int round = 0; round < kShapeRounds; ++round) {
    for (size_t i = 0; i < sketches.size(); ++i) {
      const auto projected = fitting::Project(curves_, faces[i].vertices);
      shape.row(Eigen::Index(i)) =
          fitting::RecoverCurves(encoder, curves_.offsets, projected, sketches[i]).numbers().transpose();
    }
    input.shape = tensor::CopyToTensor(shape);
    faces = Answer(input);
  }
  return faces;
}

std::vector<fitting::PredictedFace> SketchPredictor::Answer(const SketchInput& input) {
  const at::NoGradGuard no_grad;
  const FaceCoefficients coefficients = run_.network->forward(input);
  const Eigen::MatrixXf u = tensor::CopyToMatrix<float>(coefficients.u),
                        v = tensor::CopyToMatrix<float>(coefficients.v);
  const Eigen::MatrixXf vertices = tensor::CopyToMatrix<float>(run_.network->Decode(coefficients));
  std::vector<fitting::PredictedFace> faces;
  for (Eigen::Index row = 0; row < u.rows(); ++row) {
    fitting::PredictedFace& face = faces.emplace_back(fitting::PredictedFace{u.row(row), v.row(row), {}});
    face.vertices.resize(size_t(vertices.cols()));
    Eigen::Map<Eigen::RowVectorXf>(face.vertices.data(), vertices.cols()) = vertices.row(row);
  }
  return faces;
}

std::vector<render::Stroke> SketchPredictor::CurvesOf(const fitting::PredictedFace& face) const {
  return fitting::CurveStrokes(curves_.offsets, fitting::Project(curves_, face.vertices));
}

}  // namespace daumier::sketch
