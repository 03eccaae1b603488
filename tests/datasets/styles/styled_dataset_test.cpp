#include "datasets/styles/styled_dataset.h"

#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::datasets {
namespace {

using testing::TempDir;
using ArrayShape = std::vector<int64_t>;

class StyledDatasetTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 2);
    SketchesOptions options;
    options.faces = (*folder_ / "faces").string();
    options.turned.count = 1;
    BuildSketches(options, *folder_ / "sketches");
    sketches_ = new SketchDatabase(*folder_ / "sketches");
  }
  static void TearDownTestSuite() {
    delete sketches_;
    delete folder_;
  }

  static inline TempDir* folder_ = nullptr;
  static inline SketchDatabase* sketches_ = nullptr;
};

TEST_F(StyledDatasetTest, BatchesHoldPicturesPointsLabelsAndStates) {
  const StyledDataset dataset({{*sketches_, {2, 5}}, {*sketches_, {7}}}, {}, 3);
  EXPECT_EQ(dataset.size(), 3);
  EXPECT_EQ(dataset.origin(2).source, 1);
  EXPECT_EQ(dataset.origin(1).face, 5);
  const std::vector<int> samples = {2, 0};
  const SampleBatch batch = dataset.Get(samples, 4);
  EXPECT_EQ(batch.samples, samples);
  EXPECT_EQ(batch.arrays.at("pictures").shape, (ArrayShape{2, 1, 256, 256}));
  EXPECT_EQ(batch.arrays.at("points").shape, (ArrayShape{2, 26, 2}));
  EXPECT_EQ(batch.arrays.at("weights").shape, (ArrayShape{2, 26}));
  EXPECT_EQ(batch.indices.at("labels").shape, (ArrayShape{2, 128, 128}));
  EXPECT_EQ(batch.indices.at("states").shape, (ArrayShape{2, 4}));
  for (int64_t row = 0; row < 2; ++row) {
    const StyledDrawing drawing = dataset.Drawing(samples[size_t(row)], 4);
    const render::Image image = RasteriseDrawing(drawing, 256, PenView::kTraced);
    for (const size_t pixel : {0u, 20000u, 33000u, 40001u})
      EXPECT_FLOAT_EQ(batch.arrays.at("pictures").row(row)[pixel], 1 - image.pixels[pixel] / 255.0f);
    for (size_t i = 0; i < drawing.points.size(); ++i) {
      EXPECT_EQ(batch.arrays.at("weights").row(row)[i], drawing.points[i].is_shown() ? 1 : 0);
      EXPECT_FLOAT_EQ(batch.arrays.at("points").row(row)[2 * i], drawing.points[i].value[0] / 4);
    }
    const int64_t mouth = batch.indices.at("states").row(row)[0];
    EXPECT_EQ(mouth, drawing.mouth.is_shown() ? int64_t(drawing.mouth.value) : kUnknownClass);
  }
}

TEST_F(StyledDatasetTest, EpochsDifferAndAreTheSameFromAnyThread) {
  const StyledDataset dataset({{*sketches_, {0, 1, 2, 3}}}, {}, 3);
  const std::vector<int> samples = {0, 1, 2, 3};
  EXPECT_NE(dataset.Get(samples, 0).arrays.at("pictures").values, dataset.Get(samples, 1).arrays.at("pictures").values);
  testing::ExpectTheSameFromThreads(2, [&] { return dataset.Get(samples, 0).arrays.at("pictures").values; });
  EXPECT_EQ(dataset.Drawing(1, 7), StyledDataset({{*sketches_, {9, 1}}}, {}, 3).Drawing(1, 7));
}

TEST_F(StyledDatasetTest, TurnedViewsHaveTheirShare) {
  StyledReading reading;
  reading.turned = 1;
  reading.mirrored = 0;
  reading.styles.page.prefix = 0;
  std::vector<int> faces(16);
  std::iota(faces.begin(), faces.end(), 0);
  const StyledDataset dataset({{*sketches_, faces}}, reading, 1);
  std::set<faces::DrawnView> views;
  for (int i = 0; i < dataset.size(); ++i)
    if (const auto view = dataset.Drawing(i, 0).view; view.is_shown()) views.insert(view.value);
  EXPECT_EQ(views,
            (std::set<faces::DrawnView>{faces::DrawnView::kThreeQuarterLeft, faces::DrawnView::kThreeQuarterRight}));
}

TEST_F(StyledDatasetTest, WrongFacesAndSamplesAreRefused) {
  testing::ExpectError([] { StyledDataset({{*sketches_, {99999}}}, {}, 1); }, "sketch 99999");
  const StyledDataset dataset({{*sketches_, {0}}}, {}, 1);
  testing::ExpectError([&] { dataset.Drawing(1, 0); }, "sample 1 of a dataset of 1");
}

TEST(StyledReading, StatesAreNamedAndCounted) {
  EXPECT_EQ(kDrawingStateNames.size(), kDrawingStateClasses.size());
  EXPECT_EQ(std::accumulate(kDrawingStateClasses.begin(), kDrawingStateClasses.end(), 0), 3 + 2 + 2 + 4);
  EXPECT_EQ(ToJson(ParseOptions<StyledReading>(ToJson(StyledReading()))), ToJson(StyledReading()));
}

}  // namespace
}  // namespace daumier::datasets
