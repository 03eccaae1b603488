#include "render/heat_map.h"

#include "core/error.h"
#include "render/draw.h"
#include "render/opencv_bridge.h"
#include "render/ticks.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::render {
namespace {

constexpr Rgb kNoValue = {190, 190, 192};
constexpr Rgb kTextColour = {45, 45, 48};
constexpr double kHeatMapFlatness = 0.7;

using Table = std::array<Rgb, 256>;

Table MakeTable(cv::ColormapTypes type) {
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) ramp.at<uint8_t>(0, i) = static_cast<uint8_t>(i);
  cv::Mat bgr;
  cv::applyColorMap(ramp, bgr, type);
  Table table;
  for (int i = 0; i < 256; ++i) {
    const auto& colour = bgr.at<cv::Vec3b>(0, i);
    table[i] = {colour[2], colour[1], colour[0]};
  }
  return table;
}

const Table& TableOf(ColourMap map) {
  static const Table viridis = MakeTable(cv::COLORMAP_VIRIDIS);
  static const Table turbo = MakeTable(cv::COLORMAP_TURBO);
  return map == ColourMap::kViridis ? viridis : turbo;
}

}  // namespace

Rgb ColourOf(double value, const ValueRange& range, ColourMap map) {
  DAUMIER_CHECK(range.low < range.high, "a colour map over [{}, {}], expected low < high", range.low, range.high);
  if (std::isnan(value)) return kNoValue;
  const double position = 255.0 * std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
  const Table& table = TableOf(map);
  const int below = std::min(254, static_cast<int>(position));
  const double fraction = position - below;
  Rgb colour;
  for (int channel = 0; channel < 3; ++channel) {
    colour[channel] = static_cast<uint8_t>(
        std::lround((1.0 - fraction) * table[below][channel] + fraction * table[below + 1][channel]));
  }
  return colour;
}

std::vector<Rgb> ColoursOf(const Eigen::VectorXd& values, const ValueRange& range, ColourMap map) {
  std::vector<Rgb> colours;
  colours.reserve(values.size());
  for (const double value : values) colours.push_back(ColourOf(value, range, map));
  return colours;
}

Image RenderHeatMap(const RenderInput& input, const Eigen::VectorXd& values, const ValueRange& range,
                    const Camera& camera, ColourMap map) {
  RenderInput coloured = input;
  coloured.vertex_colours = ColoursOf(values, range, map);
  coloured.closing_colours.assign(coloured.closing_triangles.rows(), kNoValue);
  coloured.closing_gloss.clear();
  return RenderMesh(coloured, camera, {.flatness = kHeatMapFlatness});
}

void DrawColourBar(Image& image, const ValueRange& range, std::string_view unit, ColourMap map) {
  DAUMIER_CHECK(image.channels == 3 && image.width >= kColourBarWidth && image.height >= 60,
                "a colour bar needs an RGB image of at least 60 x {}, this one is {} x {} x {}", kColourBarWidth,
                image.height, image.width, image.channels);
  const int left = image.width - kColourBarWidth;
  FillRectangle(image, 0, left, image.height, kColourBarWidth, {255, 255, 255});
  const TextStyle text{.height = 14.0, .colour = kTextColour};
  const int bar_left = left + 10, bar_width = 14, bar_top = 26, bar_bottom = image.height - 10;
  const int bar_height = bar_bottom - bar_top;
  for (int row = 0; row < bar_height; ++row) {
    const double value = range.high - (row + 0.5) / bar_height * (range.high - range.low);
    FillRectangle(image, bar_top + row, bar_left, 1, bar_width, ColourOf(value, range, map));
  }
  DrawText(image, unit, bar_left, 4, text);
  for (const Tick& tick : NiceTicks(range.low, range.high, std::max(1, bar_height / 28))) {
    const double y = bar_bottom - (tick.value - range.low) / (range.high - range.low) * bar_height;
    FillRectangle(image, static_cast<int>(std::lround(y - 0.5)), bar_left + bar_width, 1, 4, kTextColour);
    DrawText(image, tick.label, bar_left + bar_width + 7, y - 0.5 * text.height, text);
  }
}

}  // namespace daumier::render
