#include "render/line_drawing.h"

#include "core/random.h"
#include "render/draw.h"
#include "tests/support/desk_photo.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

using testing::ExpectError;
using Point = std::array<float, 2>;

/// Distance in pixels of the 256 canvas within which drawn strokes are found again.
constexpr double kTolerancePx = 1.0;

Stroke Ellipse(double cx, double cy, double rx, double ry, double from_degree = 0, double to_degree = 360) {
  Stroke stroke;
  for (int i = 0; i <= 60; ++i) {
    const double angle = (from_degree + (to_degree - from_degree) * i / 60) * std::numbers::pi / 180.0;
    stroke.points.push_back(
        {static_cast<float>(cx + rx * std::cos(angle)), static_cast<float>(cy + ry * std::sin(angle))});
  }
  return stroke;
}

/// Closed and open curves, straight lines, a crossing and a line that ends on another.
std::vector<Stroke> Curves() {
  return {Ellipse(128, 130, 80, 100),
          Ellipse(95, 105, 20, 10),
          Ellipse(161, 105, 20, 10),
          Ellipse(128, 150, 40, 40, 30, 150),
          {0, {{128, 100}, {118, 150}, {134, 153}}},
          {0, {{70, 70}, {118, 76}}},
          {0, {{90, 60}, {110, 88}}},
          {0, {{128, 230}, {128, 252}}}};
}

/// Points at most a pixel apart.
std::vector<Point> Dense(const std::vector<Stroke>& strokes) {
  std::vector<Point> dense;
  for (const auto& stroke : strokes) {
    dense.push_back(stroke.points[0]);
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      const auto [x0, y0] = stroke.points[i - 1];
      const auto [x1, y1] = stroke.points[i];
      const int num_steps = 1 + static_cast<int>(std::hypot(x1 - x0, y1 - y0));
      for (int step = 1; step <= num_steps; ++step) {
        const float t = static_cast<float>(step) / static_cast<float>(num_steps);
        dense.push_back({x0 + t * (x1 - x0), y0 + t * (y1 - y0)});
      }
    }
  }
  return dense;
}

/// Of the points of `from` that are furthest from all of `to`: the distance that 1 % of them exceed.
double Distance(const std::vector<Point>& from, const std::vector<Point>& to) {
  std::vector<double> distances;
  for (const auto& [x, y] : from) {
    double nearest = 1e9;
    for (const auto& [u, v] : to) nearest = std::min<double>(nearest, std::hypot(x - u, y - v));
    distances.push_back(nearest);
  }
  std::sort(distances.begin(), distances.end());
  return distances[distances.size() * 99 / 100];
}

std::vector<Stroke> OnCanvas(const Drawing& drawing) {
  auto strokes = drawing.strokes;
  const auto scale = static_cast<float>(kSketchCanvas / std::max(drawing.width, drawing.height));
  for (auto& stroke : strokes) {
    for (auto& [x, y] : stroke.points) {
      x *= scale;
      y *= scale;
    }
  }
  return strokes;
}

void ExpectFoundAgain(const Image& picture, double tolerance = kTolerancePx) {
  const auto expected = Dense(Curves()), found = Dense(OnCanvas(TraceLineDrawing(picture).drawing));
  EXPECT_LE(Distance(found, expected), tolerance) << "something was made up";
  EXPECT_LE(Distance(expected, found), tolerance) << "something was lost";
}

template <class Change>
Image Changed(Image image, Change change) {
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      image.at(row, column) = static_cast<uint8_t>(std::clamp(change(image.at(row, column), row, column), 0.0, 255.0));
    }
  }
  return image;
}

TEST(TraceLineDrawing, FindsDrawnStrokesAgain) {
  ExpectFoundAgain(RasteriseStrokes(Curves(), 512));
  ExpectFoundAgain(RasteriseStrokes(Curves(), 256));
  ExpectFoundAgain(RasteriseStrokes(Curves(), 1000, {.width = 1.0}));
}

TEST(TraceLineDrawing, PenMayBeThickOrRagged) {
  ExpectFoundAgain(RasteriseStrokes(Curves(), 512, {.width = 4.0}), 1.5);
  ExpectFoundAgain(RasteriseStrokes(Curves(), 512, {.width = 1.5, .antialias = false}));
}

TEST(TraceLineDrawing, NoiseDoesNotMatter) {
  Rng rng(4);
  ExpectFoundAgain(Changed(RasteriseStrokes(Curves(), 512),
                           [&](int value, int, int) { return 20 + 0.85 * value + 12.0 * rng.Normal(); }));
}

TEST(TraceLineDrawing, LightOnDarkAndGreyPaperDoNotMatter) {
  const Image picture = RasteriseStrokes(Curves(), 512);
  ExpectFoundAgain(Changed(picture, [](int value, int, int) { return 255.0 - value; }));
  ExpectFoundAgain(Changed(picture, [](int value, int, int) { return 90.0 + 0.2 * value; }));
}

TEST(TraceLineDrawing, LightAndFrameDoNotMatter) {
  const Image picture = RasteriseStrokes(Curves(), 512);
  ExpectFoundAgain(Changed(picture, [](int value, int row, int column) {
    return value * (0.95 - 0.4 * row / 512.0 - 0.2 * column / 512.0);
  }));
  ExpectFoundAgain(Changed(picture, [](int value, int row, int) { return row < 14 ? 30.0 : 1.0 * value; }));
}

TEST(TraceLineDrawing, SizeOfTheScanDoesNotMatter) {
  const auto at_512 = Dense(OnCanvas(TraceLineDrawing(RasteriseStrokes(Curves(), 512)).drawing));
  for (const int size : {300, 900, 2000}) {
    const auto drawing = TraceLineDrawing(RasteriseStrokes(Curves(), size)).drawing;
    EXPECT_EQ(drawing.width, size);
    const auto found = Dense(OnCanvas(drawing));
    EXPECT_LE(Distance(found, at_512), 0.6) << size;
    EXPECT_LE(Distance(at_512, found), 0.6) << size;
  }
}

TEST(TraceLineDrawing, PictureMayBeOblong) {
  Image wide(512, 900, 1, 255);
  Paste(wide, RasteriseStrokes(Curves(), 512), 0, 200);
  auto drawing = TraceLineDrawing(wide).drawing;
  EXPECT_EQ(drawing.width, 900.0);
  EXPECT_EQ(drawing.height, 512.0);
  for (auto& stroke : drawing.strokes) {
    for (auto& [x, y] : stroke.points) {
      x = 0.5F * (x - 200);
      y *= 0.5F;
    }
  }
  EXPECT_LE(Distance(Dense(drawing.strokes), Dense(Curves())), kTolerancePx);
  EXPECT_LE(Distance(Dense(Curves()), Dense(drawing.strokes)), kTolerancePx);
}

TEST(TraceLineDrawing, CrossingLinesStayTwoStrokes) {
  const std::vector<Stroke> cross = {{0, {{40, 60}, {220, 190}}}, {0, {{50, 200}, {210, 40}}}};
  const auto drawing = TraceLineDrawing(RasteriseStrokes(cross, 512)).drawing;
  EXPECT_EQ(drawing.strokes.size(), 2U);
  EXPECT_LE(Distance(Dense(OnCanvas(drawing)), Dense(cross)), 0.8);
}

TEST(TraceLineDrawing, LargeAreaIsReadAsItsOutline) {
  Image picture = RasteriseStrokes({{0, {{20, 30}, {230, 40}}}, {0, {{20, 220}, {230, 240}}}}, 512);
  FillRectangle(picture, 200, 150, 160, 200, {0, 0, 0});
  const std::vector<Stroke> expected = {{0, {{75, 100}, {175, 100}, {175, 180}, {75, 180}, {75, 100}}}};
  const auto found = Dense(OnCanvas(TraceLineDrawing(picture).drawing));
  EXPECT_LE(Distance(Dense(expected), found), 2.5);
}

TEST(TraceLineDrawing, SheetOnADeskIsReadAlone) {
  // Without what is cut off along its sides, which the sheet alone loses.
  constexpr double kCut = 0.012;
  for (const testing::Desk desk : {testing::Desk::kGrey, testing::Desk::kWood}) {
    const Image photo = testing::DeskPhoto(RasteriseStrokes(Curves(), 400), {.desk = desk, .border = 0.2, .tilt = 10});
    auto strokes = OnCanvas(TraceLineDrawing(photo).drawing);
    for (Stroke& stroke : strokes) {
      for (auto& [x, y] : stroke.points) {
        x = static_cast<float>(x * (1 - 2 * kCut) + kCut * kSketchCanvas);
        y = static_cast<float>(y * (1 - 2 * kCut) + kCut * kSketchCanvas);
      }
    }
    EXPECT_LE(Distance(Dense(strokes), Dense(Curves())), 1.5);
    EXPECT_LE(Distance(Dense(Curves()), Dense(strokes)), 1.5);
  }
}

TEST(TraceLineDrawing, SmallDrawingKeepsItsResolution) {
  Image sheet(3000, 2400, 1, 255);
  Paste(sheet, RasteriseStrokes(Curves(), 512), 1900, 700);
  auto drawing = TraceLineDrawing(sheet).drawing;
  EXPECT_EQ(drawing.width, 2400.0);
  EXPECT_EQ(drawing.height, 3000.0);
  for (Stroke& stroke : drawing.strokes) {
    for (auto& [x, y] : stroke.points) {
      x = 0.5F * (x - 700);
      y = 0.5F * (y - 1900);
    }
  }
  EXPECT_LE(Distance(Dense(drawing.strokes), Dense(Curves())), kTolerancePx);
  EXPECT_LE(Distance(Dense(Curves()), Dense(drawing.strokes)), kTolerancePx);
}

TEST(TraceLineDrawing, StagesHaveOneSize) {
  const auto result = TraceLineDrawing(RasteriseStrokes(Curves(), 300));
  for (const Image* stage : {&result.flattened, &result.ink, &result.skeleton}) {
    EXPECT_EQ(stage->width, kLineDrawingSide);
    EXPECT_EQ(stage->height, kLineDrawingSide);
    EXPECT_EQ(stage->channels, 1);
  }
}

TEST(TraceLineDrawing, RefusesPicturesWithoutLines) {
  ExpectError([] { TraceLineDrawing(Image()); }, "the picture is empty");
  ExpectError([] { TraceLineDrawing(Image(300, 400, 3, 200)); }, "holds no lines");
  ExpectError([] { TraceLineDrawing(Image(1, 1, 1, 0)); }, "holds no lines");
}

TEST(TraceLineDrawing, ReadsRealDrawings) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::is_directory(*shared / "sketches")) {
    GTEST_SKIP() << "there is no shared/data/sketches";
  }
  for (const auto& entry : std::filesystem::directory_iterator(*shared / "sketches")) {
    if (entry.path().extension() != ".png" && entry.path().extension() != ".jpg") continue;
    const auto result = TraceLineDrawing(ReadImage(entry.path()));
    EXPECT_GE(result.drawing.strokes.size(), 10U) << entry.path();
    EXPECT_LE(result.drawing.strokes.size(), 400U) << entry.path();
    // All of the ink is drawn again, apart from the insides of areas.
    const Image& skeleton = result.skeleton;
    const auto found = Dense(OnCanvas(result.drawing));
    std::vector<Point> pixels;
    const float scale = static_cast<float>(kSketchCanvas) / kLineDrawingSide;
    for (int row = 0; row < skeleton.height; ++row) {
      for (int column = 0; column < skeleton.width; ++column) {
        if (skeleton.at(row, column) == 0) {
          pixels.push_back({scale * (static_cast<float>(column) + 0.5F), scale * (static_cast<float>(row) + 0.5F)});
        }
      }
    }
    EXPECT_LE(Distance(found, pixels), 1.5) << entry.path();
    EXPECT_LE(Distance(pixels, found), 4.0) << entry.path();
  }
}

}  // namespace
}  // namespace daumier::render
