#include "systems/portrait/style_network.h"

#include "core/error.h"
#include "render/draw.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::portrait {
namespace {

constexpr int kMultiple = 32, kTrialSide = 128, kMeans = 16;
constexpr double kBeyond = 0.1, kEqualScore = 1e-3;

/// Values of a network from and to 0 .. 1: x = scale * colour + shift.
struct ValueRange {
  const char* name;
  float scale, shift;
};
constexpr std::array<ValueRange, 3> kRanges = {{{"signed", 2, -1}, {"zero_one", 1, 0}, {"bytes", 255, 0}}};

const ValueRange& RangeNamed(const std::string& name) {
  return *std::ranges::find_if(kRanges, [&](const ValueRange& range) { return range.name == name; });
}

int MultipleAbove(double length) {
  return std::max(1, int(std::ceil(length / kMultiple))) * kMultiple;
}

/// A picture within a larger one.
struct StyleCanvas {
  int height, width;                  ///< Of all.
  int content_height, content_width;  ///< Of the picture, from the top left corner.
};

StyleCanvas StyleCanvasFor(const render::Image& picture, const runtime::ImageInput& input, int side) {
  const double scale = input.height && input.width
                           ? std::min(double(*input.height) / picture.height, double(*input.width) / picture.width)
                           : std::min(1.0, double(side) / std::max(picture.height, picture.width));
  StyleCanvas canvas{};
  canvas.content_height = std::max(1, int(std::lround(scale * picture.height)));
  canvas.content_width = std::max(1, int(std::lround(scale * picture.width)));
  canvas.height = input.height ? int(*input.height) : MultipleAbove(canvas.content_height);
  canvas.width = input.width ? int(*input.width) : MultipleAbove(canvas.content_width);
  canvas.content_height = std::min(canvas.content_height, canvas.height);
  canvas.content_width = std::min(canvas.content_width, canvas.width);
  return canvas;
}

/// kMeans^2 means of luma.
std::array<double, kMeans * kMeans> MeansOf(const render::Image& picture) {
  const render::Image small = render::Resize(picture, kMeans, kMeans);
  std::array<double, kMeans * kMeans> means{};
  for (size_t i = 0; i < means.size(); ++i) {
    const uint8_t* rgb = &small.pixels[3 * i];
    means[i] = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  }
  return means;
}

double Correlation(const std::array<double, kMeans * kMeans>& a, const std::array<double, kMeans * kMeans>& b) {
  double mean_a = 0, mean_b = 0, ab = 0, aa = 0, bb = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / double(a.size());
    mean_b += b[i] / double(b.size());
  }
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

}  // namespace

StyleNetwork::StyleNetwork(const std::filesystem::path& file, const StyleNetworkOptions& options)
    : network_(file), options_(options) {}

render::Image StyleNetwork::Run(const render::Image& picture, const std::string& range, int side,
                                double* within) const {
  const StyleCanvas canvas = StyleCanvasFor(picture, network_.input(), side);
  const ValueRange& values = RangeNamed(range);
  const render::Image content = render::Resize(render::ToRgb(picture), canvas.content_height, canvas.content_width);
  FloatArray in({canvas.height, canvas.width, 3});
  for (int row = 0; row < canvas.height; ++row)
    for (int column = 0; column < canvas.width; ++column)
      for (int c = 0; c < 3; ++c)
        in.values[(size_t(row) * canvas.width + column) * 3 + c] =
            values.shift +
            values.scale / 255 *
                content.at(std::min(row, canvas.content_height - 1), std::min(column, canvas.content_width - 1), c);
  const FloatArray out = network_.Run(in);
  const int out_height = int(out.shape[0]), out_width = int(out.shape[1]);
  render::Image styled(std::max(1, out_height * canvas.content_height / canvas.height),
                       std::max(1, out_width * canvas.content_width / canvas.width), 3);
  size_t num_within = 0;
  for (int row = 0; row < styled.height; ++row) {
    for (int column = 0; column < styled.width; ++column) {
      for (int c = 0; c < 3; ++c) {
        const float colour = (out.values[(size_t(row) * out_width + column) * 3 + c] - values.shift) / values.scale;
        num_within += colour > -kBeyond && colour < 1 + kBeyond;
        styled.at(row, column, c) = uint8_t(std::lround(255 * std::clamp(colour, 0.0F, 1.0F)));
      }
    }
  }
  if (within != nullptr) *within = double(num_within) / double(styled.pixels.size());
  return styled;
}

std::string StyleNetwork::RangeFor(const render::Image& picture) const {
  if (options_.range != "auto") return options_.range;
  const auto shown = MeansOf(render::ToRgb(picture));
  std::string best = kRanges.front().name;
  double most = -2;
  for (const ValueRange& range : kRanges) {
    double within = 0;
    const render::Image styled = Run(picture, range.name, kTrialSide, &within);
    const double score = Correlation(shown, MeansOf(styled)) * within;
    if (score <= most + kEqualScore) continue;
    most = score;
    best = range.name;
  }
  return best;
}

render::Image StyleNetwork::Apply(const render::Image& picture) const {
  DAUMIER_CHECK(picture.height > 0 && picture.width > 0, "there is no picture for a network of style: it is empty");
  const render::Image styled = Run(picture, RangeFor(picture), options_.side, nullptr);
  return render::Resize(styled, picture.height, picture.width);
}

}  // namespace daumier::portrait
