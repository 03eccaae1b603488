#include "systems/deform/network_code_model.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/safetensors.h"
#include "runtime/block_product.h"
#include "runtime/siren_kernel.h"
#include "systems/deform/linear_code_model.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace daumier::deform {
namespace {

using Floats = runtime::AlignedFloats;
/// Step of the derivative, in deviations of the code: far above float32's rounding of positions.
constexpr double kDifference = 5e-3;

int64_t Padded(int64_t columns) {
  return (columns + runtime::kProductColumns - 1) / runtime::kProductColumns * runtime::kProductColumns;
}

/// An array of a run by its name, checked.
std::span<const float> ArrayOf(const SafetensorsFile& file, const std::filesystem::path& path, const std::string& name,
                               const std::vector<int64_t>& shape) {
  DAUMIER_CHECK(file.contains(name),
                "{}: there is no array '{}': these are the weights of another network. Train again", path.string(),
                name);
  const ArrayView& array = file.at(name);
  DAUMIER_CHECK(array.shape == shape && array.dtype == Dtype::kF32,
                "{}: the array '{}' has another shape or type than resolved.toml says. Train again", path.string(),
                name);
  return array.As<float>();
}

}  // namespace

/// y = W x + b of rows x; the weights are stored inputs x outputs, with columns padded for runtime::BlockProduct.
class HyperLayer {
 public:
  HyperLayer(std::span<const float> weights, std::span<const float> bias, int64_t outputs, int64_t inputs)
      : inputs_(inputs), columns_(Padded(outputs)), weights_(size_t(inputs * columns_), 0), bias_(size_t(columns_), 0) {
    for (int64_t o = 0; o < outputs; ++o)
      for (int64_t i = 0; i < inputs; ++i) weights_[size_t(i * columns_ + o)] = weights[size_t(o * inputs + i)];
    std::copy(bias.begin(), bias.end(), bias_.begin());
  }

  int64_t columns() const { return columns_; }

  /// rows x inputs -> rows x columns().
  Floats Apply(const float* x, int64_t rows, bool rectified) const {
    Floats y(size_t(rows * columns_));
    runtime::BlockProduct(x, runtime::Factor::kPlain, weights_.data(), rows, inputs_, columns_,
                          runtime::ProductTo::kValue, y.data());
    for (int64_t r = 0; r < rows; ++r) {
      float* const row = y.data() + r * columns_;
      for (int64_t c = 0; c < columns_; ++c) {
        row[c] += bias_[size_t(c)];
        if (rectified) row[c] = std::max(row[c], 0.0f);
      }
    }
    return y;
  }

 private:
  int64_t inputs_, columns_;
  Floats weights_, bias_;
};

/// latent -> hidden -> hidden -> outputs; `offset`: where the outputs go among the SIREN's parameters.
struct HyperBranch {
  HyperLayer first, second, last;
  int64_t offset, outputs;
};

class DeformWeights {
 public:
  DeformWeights(const DeformOptions& options, const SafetensorsFile& file, const std::filesystem::path& path,
                int num_vertices)
      : siren_(options.siren()), latent_(options.latent) {
    const auto vertices = ArrayOf(file, path, "network.template_vertices", {num_vertices, 3});
    template_.assign(vertices.begin(), vertices.end());
    if (options.kind == "hypernetwork") {
      for (int layer = 0; layer < siren_.num_layers(); ++layer) {
        const int64_t outputs = siren_.outputs(layer), inputs = siren_.inputs(layer);
        AddBranch(options, file, path, "network.weights_" + std::to_string(layer), outputs * inputs,
                  siren_.weight_offset(layer));
        AddBranch(options, file, path, "network.biases_" + std::to_string(layer), outputs, siren_.bias_offset(layer));
      }
      return;
    }
    DAUMIER_CHECK(options.kind == "conditioning",
                  "{}: a model of kind '{}' cannot be edited (expected hypernetwork, conditioning or linear)",
                  path.string(), options.kind);
    const auto shared = ArrayOf(file, path, "network.shared", {siren_.num_parameters()});
    shared_.assign(shared.begin(), shared.end());
    for (const char* name : {"network.first_code", "network.mid_code"}) {
      const auto weights = ArrayOf(file, path, name, {siren_.width, options.latent});
      code_layers_.emplace_back(weights, std::span<const float>(), siren_.width, options.latent);
    }
  }

  /// Parameters of SIRENs, rows x num_parameters, of latents rows x latent.
  Floats Parameters(const Floats& latents, int64_t rows) const {
    const int64_t count = siren_.num_parameters();
    Floats parameters(size_t(rows * count));
    if (branches_.empty()) {
      for (int64_t r = 0; r < rows; ++r) std::copy(shared_.begin(), shared_.end(), parameters.begin() + r * count);
      for (size_t k = 0; k < code_layers_.size(); ++k) {
        const Floats shifts = code_layers_[k].Apply(latents.data(), rows, false);
        const int64_t offset = siren_.bias_offset(k == 0 ? 0 : siren_.num_layers() / 2);
        for (int64_t r = 0; r < rows; ++r)
          for (int64_t c = 0; c < siren_.width; ++c)
            parameters[size_t(r * count + offset + c)] += shifts[size_t(r * code_layers_[k].columns() + c)];
      }
      return parameters;
    }
    const auto fill = [&](int64_t b) {
      const HyperBranch& branch = branches_[size_t(b)];
      const Floats hidden = branch.first.Apply(latents.data(), rows, true);
      const Floats again = branch.second.Apply(hidden.data(), rows, true);
      const Floats out = branch.last.Apply(again.data(), rows, false);
      for (int64_t r = 0; r < rows; ++r)
        std::copy_n(out.data() + r * branch.last.columns(), branch.outputs,
                    parameters.data() + r * count + branch.offset);
    };
    OnAllCores(std::ssize(branches_), fill);
    return parameters;
  }

  /// Template positions of vertices, 3P floats.
  Floats Points(std::span<const int> vertices) const {
    Floats points(3 * vertices.size());
    for (size_t p = 0; p < vertices.size(); ++p)
      std::copy_n(template_.data() + 3 * size_t(vertices[p]), 3, points.data() + 3 * p);
    return points;
  }
  const Floats& all_points() const { return template_; }
  int latent() const { return latent_; }

 private:
  void AddBranch(const DeformOptions& options, const SafetensorsFile& file, const std::filesystem::path& path,
                 const std::string& name, int64_t outputs, int64_t offset) {
    const int64_t hidden = options.hyper_width;
    const auto layer = [&](const char* part, int64_t num_outputs, int64_t num_inputs) {
      return HyperLayer(ArrayOf(file, path, name + part + ".weight", {num_outputs, num_inputs}),
                        ArrayOf(file, path, name + part + ".bias", {num_outputs}), num_outputs, num_inputs);
    };
    DAUMIER_CHECK(hidden % runtime::kProductColumns == 0, "{}: hyper_width is {}, expected a multiple of {}",
                  path.string(), hidden, runtime::kProductColumns);
    branches_.push_back({layer(".first", hidden, options.latent), layer(".second", hidden, hidden),
                         layer(".last", outputs, hidden), offset, outputs});
  }

  const runtime::SirenLayout siren_;
  const int latent_;
  Floats template_, shared_;
  std::vector<HyperBranch> branches_;
  std::vector<HyperLayer> code_layers_;
};

namespace {

faces::ModelFrame FrameOf(const SafetensorsFile& file, const std::filesystem::path& path) {
  DAUMIER_CHECK(file.contains("network.model_from_cm") && file.at("network.model_from_cm").size() == 4,
                "{}: there is no frame 'network.model_from_cm' of four numbers. Train again", path.string());
  const auto numbers = file.at("network.model_from_cm").As<double>();
  return {numbers[0], {numbers[1], numbers[2], numbers[3]}};
}

Eigen::MatrixXd LatentsOfRun(const SafetensorsFile& file, const std::filesystem::path& path, int latent) {
  DAUMIER_CHECK(file.contains("codes") && file.at("codes").shape.size() == 2 && file.at("codes").shape[1] == latent,
                "{}: there are no codes of training faces of {} numbers. Train again", path.string(), latent);
  const ArrayView& codes = file.at("codes");
  return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
             codes.As<float>().data(), codes.shape[0], codes.shape[1])
      .cast<double>();
}

Floats LatentRows(const fitting::CodePrior& prior, const Eigen::MatrixXd& codes) {
  const Eigen::MatrixXd latents = (prior.factor * codes).colwise() + prior.mean;  // M x rows
  Floats rows(size_t(latents.size()));
  Eigen::Map<Eigen::MatrixXf>(rows.data(), latents.rows(), latents.cols()) = latents.cast<float>();
  return rows;
}

/// Displaced points, 3P floats.
Floats Decoded(const runtime::SirenLayout& siren, const float* parameters, const Floats& points) {
  const int64_t num_points = std::ssize(points) / 3;
  Floats positions(points.size());
  runtime::SirenKernel(siren).Forward(parameters, points.data(), num_points, positions.data());
  for (size_t i = 0; i < points.size(); ++i) positions[i] += points[i];
  return positions;
}

}  // namespace

NetworkCodeModel::NetworkCodeModel(faces::FaceTemplate face_template, const DeformOptions& options,
                                   const std::filesystem::path& weights)
    : face_template_(std::move(face_template)), siren_(options.siren()) {
  const SafetensorsFile file(weights);
  frame_ = FrameOf(file, weights);
  prior_ = fitting::PriorOfCodes(LatentsOfRun(file, weights, options.latent));
  weights_ = std::make_unique<const DeformWeights>(options, file, weights, face_template_.num_vertices());
}

NetworkCodeModel::~NetworkCodeModel() = default;

geometry::Points NetworkCodeModel::Vertices(const Eigen::VectorXd& code) const {
  DAUMIER_CHECK(code.size() == prior_.mean.size(), "a code of {} numbers, expected {}", code.size(),
                prior_.mean.size());
  const Floats parameters = weights_->Parameters(LatentRows(prior_, code), 1);
  const Floats& points = weights_->all_points();
  geometry::Points vertices(std::ssize(points) / 3, 3);
  constexpr int64_t kBlock = 2400;
  const int64_t num_blocks = (vertices.rows() + kBlock - 1) / kBlock;
  OnAllCores(num_blocks, [&](int64_t block) {
    const int64_t begin = block * kBlock, count = std::min<int64_t>(kBlock, vertices.rows() - begin);
    const Floats part(points.begin() + 3 * begin, points.begin() + 3 * (begin + count));
    const Floats positions = Decoded(siren_, parameters.data(), part);
    for (int64_t i = 0; i < 3 * count; ++i) vertices.data()[3 * begin + i] = positions[size_t(i)];
  });
  return frame_.ToCm(vertices);
}

Eigen::VectorXd NetworkCodeModel::Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  DAUMIER_CHECK(code.size() == prior_.mean.size(), "a code of {} numbers, expected {}", code.size(),
                prior_.mean.size());
  const Floats parameters = weights_->Parameters(LatentRows(prior_, code), 1);
  const Floats positions = Decoded(siren_, parameters.data(), weights_->Points(vertices));
  Eigen::VectorXd numbers(std::ssize(positions));
  for (size_t i = 0; i < positions.size(); ++i)
    numbers[Eigen::Index(i)] = (double(positions[i]) - frame_.offset[Eigen::Index(i % 3)]) / frame_.scale;
  return numbers;
}

Eigen::MatrixXd NetworkCodeModel::Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  const int64_t num_numbers = prior_.mean.size(), num_rows = num_numbers + 1;
  DAUMIER_CHECK(code.size() == num_numbers, "a code of {} numbers, expected {}", code.size(), num_numbers);
  Eigen::MatrixXd codes = code.replicate(1, num_rows);
  codes.leftCols(num_numbers).diagonal().array() += kDifference;
  const Floats parameters = weights_->Parameters(LatentRows(prior_, codes), num_rows);
  const Floats points = weights_->Points(vertices);
  Eigen::MatrixXd derivative(std::ssize(points), num_numbers);
  const double factor = 1 / (kDifference * frame_.scale);
  const Floats here = Decoded(siren_, parameters.data() + num_numbers * siren_.num_parameters(), points);
  OnAllCores(num_numbers, [&](int64_t n) {
    const Floats ahead = Decoded(siren_, parameters.data() + n * siren_.num_parameters(), points);
    for (size_t i = 0; i < points.size(); ++i)
      derivative(Eigen::Index(i), n) = factor * (double(ahead[i]) - double(here[i]));
  });
  return derivative;
}

Eigen::MatrixXd TrainingCodes(const DeformOptions& options, const std::filesystem::path& weights) {
  const Eigen::MatrixXd latents = LatentsOfRun(SafetensorsFile(weights), weights, options.latent);
  return fitting::StandardisedCodes(fitting::PriorOfCodes(latents), latents);
}

LinearFaces LinearFacesOfRun(const faces::FaceTemplate& face_template, const DeformOptions& options,
                             const std::filesystem::path& weights) {
  const SafetensorsFile file(weights);
  const faces::ModelFrame frame = FrameOf(file, weights);
  const fitting::CodePrior prior = fitting::PriorOfCodes(LatentsOfRun(file, weights, options.latent));
  const int64_t num_coordinates = 3 * face_template.num_vertices();
  const auto mean = ArrayOf(file, weights, "network.mean", {num_coordinates});
  const auto rows = ArrayOf(file, weights, "network.rows", {options.latent, num_coordinates});
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> own_rows(rows.data(), options.latent, num_coordinates);
  LinearFaces result;
  result.face_template = face_template;
  result.usual_radius = prior.usual_radius;
  result.rows = (prior.factor / frame.scale).transpose().cast<float>() * own_rows;
  const Eigen::RowVectorXd middle = Eigen::Map<const Eigen::RowVectorXf>(mean.data(), num_coordinates).cast<double>() +
                                    (prior.mean.transpose().cast<float>() * own_rows).cast<double>();
  result.mean = frame.ToCm(Eigen::Map<const geometry::Points>(middle.data(), num_coordinates / 3, 3));
  return result;
}

}  // namespace daumier::deform
