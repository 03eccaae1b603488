#include "systems/sketch/train/reader.h"

#include "datasets/read/sketch_dataset.h"
#include "tensor/array.h"
#include "tensor/eigen.h"
#include "tests/support/expect_error.h"
#include "tests/systems/sketch/train/run_fixture.h"

namespace daumier::sketch {
namespace {

using SketchReaderTest = SketchRunFixture;

torch::Tensor Images(SampleBatch batch) {
  return tensor::TakeTensor(std::move(batch.arrays["images"]));
}

eval::FaceRows Decode(const SketchNetwork& network, const FaceCoefficients& coefficients) {
  StoredCoefficients stored(network);
  stored.Append(coefficients);
  return stored.Decode(0, stored.size()).faces;
}

TEST_F(SketchReaderTest, GivesTheNetworkTheSketch) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  datasets::SketchVariation variation;
  variation.augmentation.strength = 1;
  const SketchReader reader(data.sketches, variation, 3);
  const std::vector<int> faces{4, 2};
  const eval::FaceRows predicted = Decode(data.run.network, reader.Forward(data.run.network, faces));
  const datasets::SketchDataset dataset(data.sketches, faces, {.resolution = 32}, variation, 3);
  SketchNetwork network = data.run.network;
  const auto expected = tensor::CopyToMatrix<float>(
      network->Decode(network->forward({Images(dataset.Get(std::vector<int>{0, 1})), {}, {}})));
  EXPECT_EQ(predicted, expected);
  const auto seen = datasets::VariedSketch(data.sketches, 4, variation, 3, 0);
  ASSERT_EQ(reader.SketchOf(4).strokes.size(), seen.strokes.size());
  EXPECT_EQ(reader.SketchOf(4).strokes[0].points, seen.strokes[0].points);
}

TEST_F(SketchReaderTest, GivesCurveCoefficientsToANetworkThatReadsThem) {
  WriteRun(*folder_ / "shape run", {.trunk = "shape", .hidden = 16, .branch = 16});
  const SketchRunData data = OpenSketchRunData(*folder_ / "shape run");
  const SketchReader reader(data.sketches, {}, 3);
  const std::vector<int> faces{4, 2};
  eval::FaceRows numbers = eval::FaceRows::Random(2, data.run.network->num_shape());
  const eval::FaceRows predicted = Decode(data.run.network, reader.Forward(data.run.network, faces, &numbers));
  numbers.row(1).setZero();
  const eval::FaceRows others = Decode(data.run.network, reader.Forward(data.run.network, faces, &numbers));
  EXPECT_EQ(predicted.row(0), others.row(0));
  EXPECT_NE(predicted.row(1), others.row(1));
  testing::ExpectError([&] { reader.Forward(data.run.network, faces); }, "there are none");
}

TEST_F(SketchReaderTest, StoredCoefficientsAreDecodedAsTheyWereAppended) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const SketchReader reader(data.sketches, {}, 3);
  const std::vector<int> first{4, 2}, second{7};
  StoredCoefficients stored(data.run.network);
  EXPECT_EQ(stored.size(), 0);
  stored.Append(reader.Forward(data.run.network, first));
  stored.Append(reader.Forward(data.run.network, second));
  ASSERT_EQ(stored.size(), 3);
  const SketchPredictions all = stored.Decode(0, 3);
  EXPECT_EQ(all.u.cols(), data.run.network->num_identity());
  EXPECT_EQ(all.v.cols(), data.run.network->num_expression());
  const eval::FaceRows last = Decode(data.run.network, reader.Forward(data.run.network, second));
  EXPECT_LT((all.faces.row(2) - last.row(0)).cwiseAbs().maxCoeff(), 1e-5f);
  const std::vector<int64_t> entries{2, 0};
  const SketchPredictions some = stored.Decode(entries);
  EXPECT_LT((some.faces.row(0) - all.faces.row(2)).cwiseAbs().maxCoeff(), 1e-5f);
  EXPECT_LT((some.faces.row(1) - all.faces.row(0)).cwiseAbs().maxCoeff(), 1e-5f);
}

}  // namespace
}  // namespace daumier::sketch
