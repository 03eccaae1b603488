#include "systems/deform/deform_weights.h"

#include "core/error.h"
#include "core/parallel.h"
#include "runtime/block_product.h"
#include "runtime/siren_math.h"

#include <algorithm>
#include <utility>

namespace daumier::deform {
namespace {

using runtime::BlockProduct;
using runtime::Factor;
using runtime::ProductTo;

/// Outputs of a hypernetwork that one thread computes at once.
constexpr int64_t kPart = 2048;

int64_t Padded(int64_t columns) {
  return (columns + runtime::kProductColumns - 1) / runtime::kProductColumns * runtime::kProductColumns;
}

/// A layer that reads latents z = mean + factor c, as one that reads standardised codes c.
HyperLayer StandardisedLayer(std::span<const float> weights, std::span<const float> bias, int64_t outputs,
                             const fitting::CodePrior& prior) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int64_t inputs = prior.mean.size();
  const Eigen::MatrixXd given = Eigen::Map<const Rows>(weights.data(), outputs, inputs).cast<double>();
  const Rows made = (given * prior.factor).cast<float>();
  Eigen::VectorXd shift = given * prior.mean;
  if (!bias.empty()) shift += Eigen::Map<const Eigen::VectorXf>(bias.data(), outputs).cast<double>();
  const Eigen::VectorXf rounded = shift.cast<float>();
  return {{made.data(), size_t(made.size())}, {rounded.data(), size_t(outputs)}, outputs, inputs};
}

std::vector<int> AllOf(int64_t count) {
  std::vector<int> all(static_cast<size_t>(count));
  for (size_t i = 0; i < all.size(); ++i) all[i] = int(i);
  return all;
}

/// The weights of a layer, outputs x padded inputs.
Floats PaddedRows(const HyperLayer& layer) {
  const int64_t padded = Padded(layer.inputs());
  Floats rows(size_t(layer.outputs() * padded), 0);
  for (int64_t i = 0; i < layer.inputs(); ++i)
    for (int64_t o = 0; o < layer.outputs(); ++o) rows[size_t(o * padded + i)] = layer.Row(i)[o];
  return rows;
}

/// The neurons of a rectified layer that are not 0.
CodedSiren::Active ActiveOf(const HyperLayer& layer, std::span<const int> active, std::span<const float> values) {
  Floats outputs(size_t(layer.outputs()));
  layer.Apply(active, values, 0, layer.outputs(), outputs.data());
  CodedSiren::Active result;
  for (size_t o = 0; o < outputs.size(); ++o) {
    if (outputs[o] <= 0) continue;
    result.neurons.push_back(int(o));
    result.values.push_back(outputs[o]);
  }
  return result;
}

}  // namespace

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

HyperLayer::HyperLayer(std::span<const float> weights, std::span<const float> bias, int64_t outputs, int64_t inputs)
    : weights_(size_t(inputs * outputs)), bias_(bias.begin(), bias.end()) {
  constexpr int64_t kTile = 16;
  for (int64_t begin = 0; begin < outputs; begin += kTile)
    for (int64_t i = 0; i < inputs; ++i)
      for (int64_t o = begin; o < std::min(begin + kTile, outputs); ++o)
        weights_[size_t(i * outputs + o)] = weights[size_t(o * inputs + i)];
}

void HyperLayer::Apply(std::span<const int> active, std::span<const float> values, int64_t begin, int64_t count,
                       float* y) const {
  std::vector<const float*> rows;
  for (const int input : active) rows.push_back(Row(input) + begin);
  std::copy_n(bias_.begin() + begin, count, y);
  runtime::AddMultiplesOfRows(rows.data(), values.data(), std::ssize(rows), count, y);
}

DeformWeights::DeformWeights(const DeformOptions& options, const SafetensorsFile& file,
                             const std::filesystem::path& path, const fitting::CodePrior& prior, int num_vertices)
    : siren_(options.siren()), num_numbers_(options.latent), num_hidden_(options.hyper_width) {
  const auto vertices = ArrayOf(file, path, "network.template_vertices", {num_vertices, 3});
  template_.assign(vertices.begin(), vertices.end());
  if (options.kind == "hypernetwork") {
    for (int layer = 0; layer < siren_.num_layers(); ++layer)
      for (const bool is_bias : {false, true}) AddBranch(options, file, path, prior, layer, is_bias);
    return;
  }
  DAUMIER_CHECK(options.kind == "conditioning",
                "{}: a model of kind '{}' cannot be edited (expected hypernetwork, conditioning or linear)",
                path.string(), options.kind);
  const auto shared = ArrayOf(file, path, "network.shared", {siren_.num_parameters()});
  shared_.assign(shared.begin(), shared.end());
  for (const bool is_first : {true, false}) {
    const std::string name = is_first ? "network.first_code" : "network.mid_code";
    HyperLayer weights =
        StandardisedLayer(ArrayOf(file, path, name, {siren_.width, options.latent}), {}, siren_.width, prior);
    Floats rows = PaddedRows(weights);
    code_layers_.push_back({std::move(weights), std::move(rows), is_first ? 0 : siren_.num_layers() / 2});
  }
}

void DeformWeights::AddBranch(const DeformOptions& options, const SafetensorsFile& file,
                              const std::filesystem::path& path, const fitting::CodePrior& prior, int layer,
                              bool is_bias) {
  const std::string name = fmt::format("network.{}_{}", is_bias ? "biases" : "weights", layer);
  const int64_t outputs = siren_.outputs(layer) * (is_bias ? 1 : siren_.inputs(layer));
  const auto weights = [&](const char* part, int64_t num_outputs, int64_t num_inputs) {
    return ArrayOf(file, path, name + part + ".weight", {num_outputs, num_inputs});
  };
  const auto bias = [&](const char* part, int64_t num_outputs) {
    return ArrayOf(file, path, name + part + ".bias", {num_outputs});
  };
  HyperLayer first = StandardisedLayer(weights(".first", num_hidden_, options.latent), bias(".first", num_hidden_),
                                       num_hidden_, prior);
  Floats first_rows = PaddedRows(first);
  for (int64_t begin = 0; begin < outputs; begin += kPart)
    parts_.push_back({branches_.size(), begin, std::min(kPart, outputs - begin)});
  branches_.push_back(
      {std::move(first),
       {weights(".second", num_hidden_, num_hidden_), bias(".second", num_hidden_), num_hidden_, num_hidden_},
       {weights(".last", outputs, num_hidden_), bias(".last", outputs), outputs, num_hidden_},
       std::move(first_rows),
       layer,
       is_bias,
       is_bias ? siren_.bias_offset(layer) : siren_.weight_offset(layer)});
}

CodedSiren DeformWeights::At(const Eigen::VectorXd& code) const {
  CodedSiren siren;
  const std::vector<int> numbers = AllOf(num_numbers_);
  const Eigen::VectorXf values = code.cast<float>();
  const std::span<const float> input(values.data(), size_t(num_numbers_));
  if (branches_.empty()) {
    siren.parameters = shared_;
    for (const auto& [weights, rows, layer] : code_layers_) {
      Floats shift(size_t(siren_.width));
      weights.Apply(numbers, input, 0, siren_.width, shift.data());
      float* const bias = siren.parameters.data() + siren_.bias_offset(layer);
      for (int64_t o = 0; o < siren_.width; ++o) bias[o] += shift[size_t(o)];
    }
    return siren;
  }
  siren.parameters.resize(size_t(siren_.num_parameters()));
  for (const HyperBranch& branch : branches_) {
    CodedSiren::Branch& state = siren.branches.emplace_back();
    state.first = ActiveOf(branch.first, numbers, input);
    state.second = ActiveOf(branch.second, state.first.neurons, state.first.values);
  }
  OnAllCores(std::ssize(parts_), [&](int64_t p) {
    const Part& part = parts_[size_t(p)];
    const HyperBranch& branch = branches_[part.branch];
    const CodedSiren::Active& active = siren.branches[part.branch].second;
    branch.last.Apply(active.neurons, active.values, part.begin, part.count,
                      siren.parameters.data() + branch.offset + part.begin);
  });
  return siren;
}

Floats DeformWeights::NeuronDerivative(const HyperBranch& branch, const CodedSiren::Branch& state) const {
  const int64_t num_first = std::ssize(state.first.neurons), num_second = std::ssize(state.second.neurons),
                padded = Padded(num_numbers_);
  Floats inner(size_t(num_first * num_second)), by_code(size_t(num_first * padded)),
      result(size_t(num_second * padded));
  for (int64_t f = 0; f < num_first; ++f) {
    const int neuron = state.first.neurons[size_t(f)];
    for (int64_t s = 0; s < num_second; ++s)
      inner[size_t(f * num_second + s)] = branch.second.Row(neuron)[state.second.neurons[size_t(s)]];
    std::copy_n(branch.first_rows.data() + neuron * padded, padded, by_code.data() + f * padded);
  }
  BlockProduct(inner.data(), Factor::kTransposed, by_code.data(), num_second, num_first, padded, ProductTo::kValue,
               result.data());
  return result;
}

Eigen::MatrixXd DeformWeights::Derivative(const CodedSiren& siren, const Floats& points) const {
  const int64_t num_points = std::ssize(points) / 3, padded = Padded(num_numbers_);
  runtime::SirenFactors factors(siren_, num_points);
  const int64_t block = factors.block(), num_blocks = factors.num_blocks();
  OnAllCores(num_blocks, [&](int64_t b) { factors.Fill(siren.parameters.data(), points.data(), b); });

  // Of each branch the derivative by its active neurons, num_blocks x active x 3 x block, and theirs by the code.
  struct Job {
    size_t branch;
    int64_t neuron;
  };
  std::vector<Job> jobs;
  std::vector<Floats> by_neurons, by_code(branches_.size());
  const auto num_active = [&](size_t i) { return std::ssize(siren.branches[i].second.neurons); };
  for (size_t i = 0; i < branches_.size(); ++i) by_neurons.emplace_back(size_t(num_blocks * num_active(i) * 3 * block));
  for (int64_t n = 0; n < num_hidden_; ++n)  // Neuron by neuron, so that cores get equal shares of each layer.
    for (size_t i = 0; i < branches_.size(); ++i)
      if (n < num_active(i)) jobs.push_back({i, n});
  OnAllCores(std::ssize(branches_), [&](int64_t i) {
    by_code[size_t(i)] = NeuronDerivative(branches_[size_t(i)], siren.branches[size_t(i)]);
  });
  OnAllCores(std::ssize(jobs), [&](int64_t j) {
    const auto [i, n] = jobs[size_t(j)];
    const HyperBranch& branch = branches_[i];
    const float* const direction = branch.last.Row(siren.branches[i].second.neurons[size_t(n)]);
    Floats product(size_t(siren_.outputs(branch.layer) * block));
    for (int64_t b = 0; b < num_blocks; ++b) {
      float* const to = by_neurons[i].data() + (b * num_active(i) + n) * 3 * block;
      if (branch.is_bias) {
        factors.AlongBiases(branch.layer, b, direction, to);
      } else {
        factors.AlongWeights(branch.layer, b, direction, product.data(), to);
      }
    }
  });

  Eigen::MatrixXd derivative(3 * num_points, num_numbers_);
  OnAllCores(num_blocks, [&](int64_t b) {
    Floats sum(size_t(3 * block * padded), 0);
    for (size_t i = 0; i < branches_.size(); ++i)
      BlockProduct(by_neurons[i].data() + b * num_active(i) * 3 * block, Factor::kTransposed, by_code[i].data(),
                   3 * block, num_active(i), padded, ProductTo::kSum, sum.data());
    for (const auto& [weights, rows, layer] : code_layers_)
      for (int64_t i = 0; i < 3; ++i)
        BlockProduct(factors.Gradients(layer, b) + i * siren_.width * block, Factor::kTransposed, rows.data(), block,
                     siren_.width, padded, ProductTo::kSum, sum.data() + i * block * padded);
    for (int64_t i = 0; i < 3; ++i)
      for (int64_t p = 0; p < factors.NumPointsOf(b); ++p)
        derivative.row(3 * (b * block + p) + i) =
            Eigen::Map<const Eigen::RowVectorXf>(sum.data() + (i * block + p) * padded, num_numbers_).cast<double>();
  });
  return derivative;
}

Floats DeformWeights::Points(std::span<const int> vertices) const {
  Floats points(3 * vertices.size());
  for (size_t p = 0; p < vertices.size(); ++p)
    std::copy_n(template_.data() + 3 * size_t(vertices[p]), 3, points.data() + 3 * p);
  return points;
}

}  // namespace daumier::deform
