#include "systems/sketch/train/reader.h"

#include "core/error.h"
#include "datasets/read/sketch_dataset.h"
#include "tensor/array.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <numeric>

namespace daumier::sketch {

datasets::AugmentedSketch SketchReader::Seen(int face) const {
  return datasets::VariedSketch(sketches_, face, variation_, seed_, 0);
}

SketchAnswers SketchReader::Ask(SketchNetwork network, std::span<const int> faces,
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
    DAUMIER_CHECK(shape != nullptr, "the network reads shape-level numbers, but there are none");
    input.shape = tensor::CopyToTensor(*shape);
  }
  const FaceCoefficients answer = network->forward(input);
  return {tensor::CopyToMatrix<float>(answer.u), tensor::CopyToMatrix<float>(answer.v),
          tensor::CopyToMatrix<float>(network->Decode(answer))};
}

}  // namespace daumier::sketch
