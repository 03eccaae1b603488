#include "systems/sketch/train/reader.h"

#include "core/error.h"
#include "datasets/read/sketch_dataset.h"
#include "tensor/array.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <numeric>

namespace daumier::sketch {
namespace {

/// The same function of u, v and the residual, which may be undefined.
template <class Function>
FaceCoefficients Each(const FaceCoefficients& coefficients, const Function& function) {
  const auto& [u, v, residual] = coefficients;
  return {function(u), function(v), residual.defined() ? function(residual) : residual};
}

}  // namespace

datasets::AugmentedSketch SketchReader::SketchOf(int face) const {
  return datasets::VariedSketch(sketches_, face, variation_, seed_, 0);
}

FaceCoefficients SketchReader::Forward(SketchNetwork network, std::span<const int> faces,
                                       const eval::FaceRows* shape) const {
  const at::NoGradGuard no_grad;
  const SketchNetworkOptions& options = network->options();
  const datasets::SketchDataset dataset(sketches_, {faces.begin(), faces.end()},
                                        {.resolution = options.reads_image() ? options.resolution : 0,
                                         .num_points = options.reads_points() ? options.num_points : 0,
                                         .fixed = true},
                                        variation_, seed_);
  std::vector<int> all(faces.size());
  std::iota(all.begin(), all.end(), 0);
  SampleBatch batch = dataset.Get(all);
  SketchInput input{ChannelsLast(tensor::TakeTensor(std::move(batch.arrays["images"]))),
                    tensor::TakeTensor(std::move(batch.arrays["points"])),
                    {}};
  if (options.reads_shape()) {
    DAUMIER_CHECK(shape != nullptr, "the network reads curve coefficients, but there are none");
    input.shape = tensor::CopyToTensor(*shape);
  }
  return network->forward(input);
}

void StoredCoefficients::Append(const FaceCoefficients& block) {
  if (size() == 0) {
    coefficients_ = block;
    return;
  }
  coefficients_.u = torch::cat({coefficients_.u, block.u});
  coefficients_.v = torch::cat({coefficients_.v, block.v});
  if (block.residual.defined()) coefficients_.residual = torch::cat({coefficients_.residual, block.residual});
}

SketchPredictions StoredCoefficients::Decode(int64_t begin, int64_t count) const {
  return Decode(Each(coefficients_, [&](const torch::Tensor& all) { return all.narrow(0, begin, count); }));
}

SketchPredictions StoredCoefficients::Decode(std::span<const int64_t> entries) const {
  const torch::Tensor index = torch::tensor(std::vector<int64_t>(entries.begin(), entries.end()));
  return Decode(Each(coefficients_, [&](const torch::Tensor& all) { return all.index_select(0, index); }));
}

SketchPredictions StoredCoefficients::Decode(const FaceCoefficients& coefficients) const {
  const at::NoGradGuard no_grad;
  return {tensor::CopyToMatrix<float>(coefficients.u), tensor::CopyToMatrix<float>(coefficients.v),
          tensor::CopyToMatrix<float>(network_->Decode(coefficients))};
}

}  // namespace daumier::sketch
