// Our stroke rasteriser (exact distances, no double darkening) compared with OpenCV's antialiased polylines, 20 strokes
// of 40 points.
#include "render/strokes.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace {

constexpr int kStrokes = 20, kPoints = 40, kSize = 128;

std::vector<daumier::render::Stroke> Strokes() {
  std::vector<daumier::render::Stroke> strokes(kStrokes);
  for (int s = 0; s < kStrokes; ++s) {
    for (int p = 0; p < kPoints; ++p) {
      const double angle = 0.1 * p + s;
      strokes[s].points.push_back({static_cast<float>(128 + (20 + 4 * s) * std::cos(angle)),
                                   static_cast<float>(128 + (30 + 3 * s) * std::sin(angle))});
    }
  }
  return strokes;
}

void OurRasteriser(benchmark::State& state) {
  const auto strokes = Strokes();
  for (auto _ : state) benchmark::DoNotOptimize(daumier::render::RasteriseStrokes(strokes, kSize).pixels.data());
}
BENCHMARK(OurRasteriser)->Unit(benchmark::kMicrosecond);

void OpenCvPolylines(benchmark::State& state) {
  std::vector<std::vector<cv::Point>> lines;
  constexpr int kShift = 4;  // OpenCV's fixed-point coordinates
  const float scale = static_cast<float>((1 << kShift) * kSize) / daumier::render::kSketchCanvas;
  for (const auto& stroke : Strokes()) {
    std::vector<cv::Point>& line = lines.emplace_back();
    for (const auto& point : stroke.points) line.emplace_back(cvRound(point[0] * scale), cvRound(point[1] * scale));
  }
  for (auto _ : state) {
    cv::Mat image(kSize, kSize, CV_8U, cv::Scalar(255));
    cv::polylines(image, lines, false, cv::Scalar(0), 1, cv::LINE_AA, kShift);
    benchmark::DoNotOptimize(image.data);
  }
}
BENCHMARK(OpenCvPolylines)->Unit(benchmark::kMicrosecond);

}  // namespace
