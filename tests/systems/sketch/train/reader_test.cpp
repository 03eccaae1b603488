#include "systems/sketch/train/reader.h"

#include "datasets/read/sketch_dataset.h"
#include "tensor/eigen.h"
#include "tests/support/expect_error.h"
#include "tests/systems/sketch/train/run_fixture.h"
#include "train/batch.h"

namespace daumier::sketch {
namespace {

using SketchReaderTest = SketchRunFixture;

TEST_F(SketchReaderTest, ShowsTheNetworkWhatIsSeen) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  datasets::SketchVariation variation;
  variation.augmentation.strength = 1;
  const SketchReader reader(data.sketches, variation, 3);
  const std::vector<int> faces{4, 2};
  const eval::FaceRows predicted = reader.Predict(data.run.network, faces);
  const datasets::SketchDataset dataset(data.sketches, faces, {.resolution = 32}, variation, 3);
  SketchNetwork network = data.run.network;
  const train::Batch batch = train::ToDevice(dataset.Get(std::vector<int>{0, 1}), torch::kCPU);
  const auto expected =
      tensor::CopyToMatrix<float>(network->Decode(network->forward({ChannelsLast(batch.at("images")), {}, {}})));
  EXPECT_EQ(predicted, expected);
  const auto seen = datasets::VariedSketch(data.sketches, 4, variation, 3, 0);
  ASSERT_EQ(reader.Seen(4).strokes.size(), seen.strokes.size());
  EXPECT_EQ(reader.Seen(4).strokes[0].points, seen.strokes[0].points);
}

TEST_F(SketchReaderTest, GivesShapeLevelNumbersToANetworkThatReadsThem) {
  WriteRun(*folder_ / "shape run", {.trunk = "shape", .hidden = 16, .branch = 16});
  const SketchRunData data = OpenSketchRunData(*folder_ / "shape run");
  const SketchReader reader(data.sketches, {}, 3);
  const std::vector<int> faces{4, 2};
  eval::FaceRows numbers = eval::FaceRows::Random(2, data.run.network->num_shape());
  const eval::FaceRows predicted = reader.Predict(data.run.network, faces, &numbers);
  numbers.row(1).setZero();
  const eval::FaceRows others = reader.Predict(data.run.network, faces, &numbers);
  EXPECT_EQ(predicted.row(0), others.row(0));
  EXPECT_NE(predicted.row(1), others.row(1));
  testing::ExpectError([&] { reader.Predict(data.run.network, faces); }, "there are none");
}

}  // namespace
}  // namespace daumier::sketch
