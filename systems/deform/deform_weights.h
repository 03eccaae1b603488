#pragma once
#include "core/safetensors.h"
#include "fitting/code_prior.h"
#include "runtime/siren_factors.h"
#include "systems/deform/network_options.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace daumier::deform {

using Floats = runtime::AlignedFloats;

/// An array of a run by its name. @throws Error naming the file if it is missing or of another shape or type.
std::span<const float> ArrayOf(const SafetensorsFile& file, const std::filesystem::path& path, const std::string& name,
                               const std::vector<int64_t>& shape);

/// y = W x + b, of which only the inputs that are not 0 cost time.
class HyperLayer {
 public:
  /// weights: outputs x inputs.
  HyperLayer(std::span<const float> weights, std::span<const float> bias, int64_t outputs, int64_t inputs);

  int64_t outputs() const { return std::ssize(bias_); }
  int64_t inputs() const { return std::ssize(weights_) / outputs(); }
  /// The weights of one input, `outputs` numbers.
  const float* Row(int64_t input) const { return weights_.data() + input * outputs(); }
  /// Outputs begin .. begin + count - 1 of x, given by its inputs that are not 0.
  void Apply(std::span<const int> active, std::span<const float> values, int64_t begin, int64_t count, float* y) const;

 private:
  Floats weights_, bias_;  ///< Weights inputs x outputs.
};

/// The SIREN of one code, and what its derivative by the code needs.
struct CodedSiren {
  /// Neurons of a hidden layer that are not 0, and their values.
  struct Active {
    std::vector<int> neurons;
    std::vector<float> values;
  };
  struct Branch {
    Active first, second;
  };
  Floats parameters;             ///< As runtime::SirenLayout orders them.
  std::vector<Branch> branches;  ///< Of the hypernetwork.
};

/// The numbers of a trained network [Jung et al. 2022, eq. 2], for standardised codes: kinds "hypernetwork" and
/// "conditioning". Model units.
class DeformWeights {
 public:
  /// @throws Error naming the file if arrays are missing or of other shapes than the options say, or if the kind has
  /// no SIREN.
  DeformWeights(const DeformOptions& options, const SafetensorsFile& file, const std::filesystem::path& path,
                const fitting::CodePrior& prior, int num_vertices);

  CodedSiren At(const Eigen::VectorXd& code) const;
  /// Derivative of S at points (3P floats) by the code, 3P x M. A hypernetwork's parameters are linear in the neurons
  /// of its last hidden layer; per point the derivative by these is computed and multiplied by that of the neurons.
  /// Exact where no neuron begins to act.
  Eigen::MatrixXd Derivative(const CodedSiren& siren, const Floats& points) const;

  /// Template positions of vertices, 3P floats, and of all.
  Floats Points(std::span<const int> vertices) const;
  const Floats& all_points() const { return template_; }

 private:
  /// code -> hidden -> hidden -> the weights or the biases of a layer.
  struct HyperBranch {
    HyperLayer first, second, last;
    Floats first_rows;  ///< Weights of `first`, hidden x padded code.
    int layer;
    bool is_bias;
    int64_t offset;  ///< Of the outputs among the SIREN's parameters.
  };
  /// A layer that a conditioned SIREN adds to its biases.
  struct CodeLayer {
    HyperLayer weights;
    Floats rows;  ///< Its weights, width x padded code.
    int layer;
  };
  struct Part {
    size_t branch;
    int64_t begin, count;
  };

  void AddBranch(const DeformOptions& options, const SafetensorsFile& file, const std::filesystem::path& path,
                 const fitting::CodePrior& prior, int layer, bool is_bias);
  /// Derivative of the active neurons of a branch by the code, active x padded code.
  Floats NeuronDerivative(const HyperBranch& branch, const CodedSiren::Branch& state) const;

  const runtime::SirenLayout siren_;
  const int64_t num_numbers_, num_hidden_;
  Floats template_, shared_;
  std::vector<HyperBranch> branches_;
  std::vector<Part> parts_;  ///< Of all outputs of the branches, in pieces that stay in a cache.
  std::vector<CodeLayer> code_layers_;
};

}  // namespace daumier::deform
