#include "render/quickdraw.h"

#include "core/log.h"
#include "core/random.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;
using PointList = std::vector<std::array<float, 2>>;

class QuickDraw : public ::testing::Test {
 protected:
  std::vector<Drawing> Read(const std::string& text) {
    testing::WriteQuickly(path_, text);
    return ReadQuickDraw(path_);
  }

  testing::TempDir folder_;
  std::filesystem::path path_ = folder_ / "drawings.ndjson";
};

TEST_F(QuickDraw, ReadsADrawingALine) {
  const auto drawings =
      Read("{\"word\":\"cup\",\"drawing\":[[[0,10],[20,255]],[[5],[6]]]}\n\n \r\n{\"drawing\":[[[1.5,2],[3,4]]]}");
  ASSERT_EQ(drawings.size(), 2U);
  ASSERT_EQ(drawings[0].strokes.size(), 2U);
  EXPECT_EQ(drawings[0].strokes[0].points, (PointList{{0, 20}, {10, 255}}));
  EXPECT_EQ(drawings[0].strokes[1].points, (PointList{{5, 6}}));
  EXPECT_EQ(drawings[1].strokes[0].points, (PointList{{1.5F, 3}, {2, 4}}));
  EXPECT_EQ(drawings[0].width, 256.0);
  EXPECT_EQ(drawings[0].height, 256.0);
}

TEST_F(QuickDraw, IgnoresTheTimesOfRawDrawings) {
  const auto drawings = Read("{\"drawing\":[[[100,800.5],[20,1255],[0,17]]]}\n");
  EXPECT_EQ(drawings[0].strokes[0].points, (PointList{{100, 20}, {800.5F, 1255}}));
  EXPECT_EQ(drawings[0].width, 800.5);
  EXPECT_EQ(drawings[0].height, 1255.0);
}

TEST_F(QuickDraw, ALineThatIsNoDrawingIsSkippedWithAWarning) {
  testing::AllowWarnings();
  const std::string good = "{\"drawing\":[[[7],[0]]]}\n";
  for (const char* const bad : {"{\"drawing\":[[[0,1],[0]]]}", "{\"drawing\":[[[0,1],", "{\"word\":\"cup\"}", "[]"}) {
    const int before = log::NumWarnings();
    const auto drawings = Read(good + bad + "\n" + good);
    EXPECT_EQ(log::NumWarnings(), before + 1) << bad;
    ASSERT_EQ(drawings.size(), 2u) << bad;
    EXPECT_EQ(drawings[1].strokes[0].points, (PointList{{7, 0}}));
  }
}

TEST_F(QuickDraw, ErrorsNameFileAndLine) {
  ExpectError([&] { Read("\n\n{\"drawing\":[[[0,1],[0]]]}\n[]"); }, "drawings.ndjson:3: a stroke has 2 x but 1 y");
  ExpectError([&] { Read("\n\n{\"drawing\":[[[0,1],"); }, "drawings.ndjson:3: ");
  ExpectError([&] { Read("{\"word\":\"cup\"}"); }, "drawings.ndjson:1: expected an object");
  ExpectError([&] { Read("[]"); }, "drawings.ndjson:1: expected an object");
  ExpectError([&] { Read("{\"drawing\":[[[\"a\"],[0]]]}"); }, "drawings.ndjson:1: coordinates must be numbers");
  ExpectError([&] { Read("{\"drawing\":[[[0]]]}"); }, "drawings.ndjson:1: a stroke must be");
  ExpectError([&] { Read("{\"drawing\":[[0,0]]}"); }, "coordinates must be a list");
  ExpectError([&] { Read("{\"drawing\":[[[1e300],[0]]]}"); }, "not finite");
  ExpectError([&] { Read("{\"drawing\":[]}"); }, "drawings.ndjson:1: the drawing holds no strokes");
  ExpectError([&] { Read("\n"); }, "drawings.ndjson: the file holds no drawings");
  ExpectError([&] { ReadQuickDraw(folder_ / "absent.ndjson"); }, "absent.ndjson");
}

TEST_F(QuickDraw, RefusesTruncatedAndSurvivesDamagedFiles) {
  const std::string bytes = "{\"word\":\"cup\",\"drawing\":[[[0,10],[20,255]],[[5],[6]]]}";
  const auto read = [&] { ReadQuickDraw(path_); };
  EXPECT_EQ(testing::CountRefusedTruncations(path_, bytes, read), static_cast<int>(bytes.size()));
  Rng rng(7);
  EXPECT_GT(testing::CountRefusedFlips(path_, bytes, 500, rng, read), 150);
}

// Strokes and points counted by: python3 -c "import json, sys; d = [json.loads(l)['drawing'] for l in sys.stdin];
// print(sum(len(s) for s in d), sum(len(t[0]) for s in d for t in s))" < tests/render/golden/quickdraw_face.ndjson
TEST_F(QuickDraw, ReadsDrawingsOfTheDataSet) {
  const auto drawings = ReadQuickDraw(testing::SourceRoot() / "tests/render/golden/quickdraw_face.ndjson");
  EXPECT_EQ(drawings.size(), 12U);
  size_t num_strokes = 0, num_points = 0;
  for (const auto& drawing : drawings) {
    EXPECT_EQ(drawing.width, 256.0);
    num_strokes += drawing.strokes.size();
    for (const auto& stroke : drawing.strokes) num_points += stroke.points.size();
  }
  EXPECT_EQ(num_strokes, 65U);
  EXPECT_EQ(num_points, 597U);
}

}  // namespace
}  // namespace daumier::render
